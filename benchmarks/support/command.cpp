#include "support/command.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "core/error.h"

namespace portalens::benchmarks {

Command::Command(const std::string& about) : app_(about) {}

int Command::run(int count, char** words, const std::function<int(const Request&)>& run) {
  Request request;
  std::string folder = PORTALENS_BENCHMARK_FOLDER;
  bool json = false, markdown = false;
  auto* as_json = app_.add_flag("--json", json, "JSON lines, one a row");
  app_.add_flag("--markdown", markdown, "tables in Markdown")->excludes(as_json);
  app_.add_option("--cache", folder, "where converged arrivals are kept")->capture_default_str();
  try {
    app_.parse(count, words);
  } catch (const CLI::ParseError& error) {
    return app_.exit(error) == 0 ? 0 : 2;
  }
  request.style = json ? Style::json : markdown ? Style::markdown : Style::text;
  request.folder = folder;
  try {
    std::filesystem::create_directories(request.folder);
    return run(request);
  } catch (const SceneError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

}  // namespace portalens::benchmarks
