/// \file
/// The program as a child process that can be sent signals.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace portalens::test {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Runs portalens in a folder, beside the test. What it says goes to the folder's file `said`.
class Child {
 public:
  Child(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
    std::vector<char*> words{const_cast<char*>(PORTALENS_PROGRAM)};
    for (const std::string& argument : arguments)
      words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    const std::string said = (folder / "said").string();
    id_ = ::fork();
    if (id_ != 0) return;
    const int file = ::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (::chdir(folder.c_str()) != 0 || ::dup2(file, 1) < 0 || ::dup2(file, 2) < 0) ::_exit(99);
    ::execv(PORTALENS_PROGRAM, words.data());
    ::_exit(99);
  }
  ~Child() {
    if (running()) send(SIGKILL), wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void send(int signal) const { ::kill(id_, signal); }

  /// Whether it still runs.
  bool running() {
    int status = 0;
    if (!ended_ && ::waitpid(id_, &status, WNOHANG) == id_) end(status);
    return !ended_;
  }

  /// Its exit code, or 128 + the signal that ended it.
  int wait() {
    int status = 0;
    if (!ended_ && ::waitpid(id_, &status, 0) == id_) end(status);
    return code_;
  }

  /// Until it would take an interrupt for a request: the kernel tells which signals it catches.
  /// @return whether it still runs then
  bool wait_until_it_listens() {
    while (running()) {
      std::ifstream status("/proc/" + std::to_string(id_) + "/status");
      for (std::string line; std::getline(status, line);)
        if (line.rfind("SigCgt:", 0) == 0 && (std::stoull(line.substr(8), nullptr, 16) & 2) != 0)
          return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

 private:
  void end(int status) {
    ended_ = true;
    code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  pid_t id_ = -1;
  bool ended_ = false;
  int code_ = -1;
};

}  // namespace portalens::test
