#include "app/picture_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "core/error.h"

namespace portalens {
namespace {

/// Whether the open file is still the one of that name.
bool stands(int number, const std::filesystem::path& file) {
  struct stat open {};
  struct stat named {};
  return ::fstat(number, &open) == 0 && ::stat(file.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

}  // namespace

PictureLock::PictureLock(const std::filesystem::path& picture)
    : file_(picture.parent_path() / ("." + picture.filename().string() + ".lock")) {
  // Whoever held it may take its file away between our opening and locking it: then once more.
  for (int attempt = 0; attempt < 100; ++attempt) {
    number_ = ::open(file_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (number_ < 0) return;
    const bool locked = ::flock(number_, LOCK_EX | LOCK_NB) == 0;
    const bool taken = !locked && errno == EWOULDBLOCK;
    if (locked && stands(number_, file_)) return;
    ::close(number_);
    number_ = -1;
    if (taken)
      refuse(picture.string() + " is being rendered by another process",
             "wait until that is done, or name another picture with -o");
    if (!locked) return;
  }
}

PictureLock::~PictureLock() {
  if (number_ < 0) return;
  ::unlink(file_.c_str());
  ::close(number_);
}

}  // namespace portalens
