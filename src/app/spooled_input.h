/// \file
/// Standard input as a file, for whoever reads one more than once.
#pragma once

#include <filesystem>

namespace portalens {

/// A file that holds what standard input gave, gone when this is. Of any other file it is just the
/// name.
class SpooledInput {
 public:
  /// @throws SceneError if there is too much of it, WorkError if there is no room
  explicit SpooledInput(const std::filesystem::path& file);
  ~SpooledInput();
  SpooledInput(const SpooledInput&) = delete;
  SpooledInput& operator=(const SpooledInput&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_, folder_;
};

}  // namespace portalens
