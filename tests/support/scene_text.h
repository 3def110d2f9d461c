/// \file
/// Scenes written in tests as the text of their file.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/read_scene.h"
#include "world/compile.h"

namespace portalens::test {

/// A folder of its own, gone when the test is.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "portalens-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline World compiled(const Folder& folder, const std::string& toml) {
  return compile(read_scene(folder.write("scene.toml", toml)));
}

inline World compiled(const std::string& toml) {
  const Folder folder;
  return compiled(folder, toml);
}

/// The faults of a scene, by line; none if it is sound.
inline std::vector<Fault> faults_of(const Folder& folder, const std::string& toml) {
  try {
    (void)compiled(folder, toml);
  } catch (const SceneError& error) {
    return error.faults();
  }
  return {};
}

inline std::vector<Fault> faults_of(const std::string& toml) {
  const Folder folder;
  return faults_of(folder, toml);
}

}  // namespace portalens::test
