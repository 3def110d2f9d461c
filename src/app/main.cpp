/// \file
/// The command line of portalens: finds the subcommand, runs it, and tells what went wrong.
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "app/command.h"
#include "app/command_line.h"
#include "core/error.h"

namespace {

int report(const char* kind, const std::string& problem, portalens::ExitCode code) {
  std::cerr << "portalens: " << kind << problem << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace portalens;
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may grow no more is a failed write, and told
  try {
    const int code = run_command_line(std::vector<std::string>(argv + 1, argv + argc));
    std::cout.flush();
    if (!std::cout) return report("", "can't write to standard output", exit_work_failed);
    return code;
  } catch (const SceneError& error) {
    for (const Fault& fault : error.faults()) std::cerr << to_string(fault) << '\n';
    return exit_users_fault;
  } catch (const std::bad_alloc&) {
    return report("", "out of memory; a smaller picture, mesh or texture would need less",
                  exit_work_failed);
  } catch (const WorkError& error) {
    return report("", error.what(), exit_work_failed);
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::resource_unavailable_try_again)
      return report("unexpected failure: ", error.what(), exit_work_failed);
    return report("",
                  "no thread can be started: too little memory, or too many threads run already; "
                  "--threads 1 needs fewer",
                  exit_work_failed);
  } catch (const std::exception& error) {
    return report("unexpected failure: ", error.what(), exit_work_failed);
  }
}
