/// \file
/// Broken scene files, and what the readers say of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "io/read_scene.h"
#include "support/temporary_folder.h"
#include "world/compile.h"

namespace portalens::test {

/// A scene file with a fault, and what must be told of it.
struct Broken {
  const char* title;
  const char* text;
  int line;  ///< 0: the file as a whole
  const char* phrase;
};

/// Reads and compiles, as the program does.
inline std::vector<Fault> faults_of(const std::filesystem::path& file) {
  try {
    static_cast<void>(compile(read_scene(file)));
  } catch (const SceneError& error) {
    return error.faults();
  }
  return {};
}

inline std::string all_of(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) text += to_string(fault) + "\n";
  return text;
}

inline void expect_fault(const char* suffix, const Broken& broken) {
  const TemporaryFolder folder;
  folder.write("outside.txt", "x");
  const auto file = folder.write(std::string("scenes/broken") + suffix, broken.text);
  folder.write("scenes/words.png", "these are words, not a picture");
  const std::vector<Fault> faults = faults_of(file);
  const bool told = std::any_of(faults.begin(), faults.end(), [&](const Fault& fault) {
    return fault.where.line == broken.line &&
           to_string(fault).find(broken.phrase) != std::string::npos;
  });
  EXPECT_TRUE(told) << broken.title << ": expected line " << broken.line << ", '" << broken.phrase
                    << "', was told\n"
                    << all_of(faults);
  for (const Fault& fault : faults) EXPECT_FALSE(fault.remedy.empty()) << to_string(fault);
}

}  // namespace portalens::test
