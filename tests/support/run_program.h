/// \file
/// Running the program itself, as a user's shell does.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "support/scene_folder.h"

namespace portalens {

struct Outcome {
  int code = -1;  ///< exit code; 128 + signal if it was killed
  std::string output, errors;
};

/// `words` joined as one shell command's arguments, each quoted.
inline std::string quoted(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    line += " '";
    for (const char c : word) line += c == '\'' ? "'\\''" : std::string(1, c);
    line += "'";
  }
  return line;
}

/// Runs a shell command in a folder.
inline Outcome run_shell(const std::filesystem::path& folder, const std::string& command,
                         const std::string& input = "") {
  const SceneFolder streams;
  streams.write("in", input);
  const std::string at = streams.path().string();
  const std::string line = "cd" + quoted({folder.string()}) + " && { " + command + "; } <" + at +
                           "/in >" + at + "/out 2>" + at + "/err";
  const int status = std::system(line.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, streams.read("out"), streams.read("err")};
}

/// Runs portalens in a folder.
inline Outcome run_portalens(const std::filesystem::path& folder,
                             const std::vector<std::string>& arguments,
                             const std::string& input = "") {
  return run_shell(folder, quoted({PORTALENS_PROGRAM}) + quoted(arguments), input);
}

/// Runs it, and expects that all goes well.
inline void expect_done(const SceneFolder& folder, const std::vector<std::string>& words) {
  const Outcome outcome = run_portalens(folder.path(), words);
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
}

}  // namespace portalens
