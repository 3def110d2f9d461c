/// \file
/// One render of a picture at a time.
#pragma once

#include <filesystem>

namespace portalens {

/// Holds a picture as long as it lives: by a lock on a file beside it, which ends with the process,
/// however that ends. Where the disk knows no locks, nothing is held.
class PictureLock {
 public:
  /// @throws SceneError if another process holds it
  explicit PictureLock(const std::filesystem::path& picture);
  ~PictureLock();
  PictureLock(const PictureLock&) = delete;
  PictureLock& operator=(const PictureLock&) = delete;

 private:
  std::filesystem::path file_;
  int number_ = -1;
};

}  // namespace portalens
