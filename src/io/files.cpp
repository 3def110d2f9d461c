#include "io/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <new>
#include <system_error>

namespace portalens {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t piece = std::size_t{1} << 20;  // bytes moved at once

std::string cause(int code) { return std::generic_category().message(code); }

[[noreturn]] void give_up(const fs::path& file, const std::string& why) {
  throw WorkError("can't write " + file.string() + ": " + why);
}

/// An open file that is closed again.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] bool open() const { return number_ >= 0; }
  /// 0, or the error: a network disk may report only now that it is full.
  int close() {
    if (number_ < 0) return 0;
    const int result = ::close(number_);
    number_ = -1;
    return result == 0 ? 0 : errno;
  }

 private:
  int number_;
};

/// @param file  how messages call it
void write_all(int number, std::string_view bytes, const fs::path& file) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(number, bytes.data(), std::min(bytes.size(), piece));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) give_up(file, written < 0 ? cause(errno) : "nothing was written");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

constexpr std::string_view temporary_prefix = ".portalens-", temporary_suffix = ".tmp";

/// Whether a name is one that `Temporary` gives: `.portalens-PROCESS-NUMBER.tmp`.
bool is_temporary(std::string_view name) {
  constexpr std::size_t around = temporary_prefix.size() + temporary_suffix.size();
  if (name.size() <= around || name.substr(0, temporary_prefix.size()) != temporary_prefix ||
      name.substr(name.size() - temporary_suffix.size()) != temporary_suffix)
    return false;
  const std::string_view numbers = name.substr(temporary_prefix.size(), name.size() - around);
  return numbers.find_first_not_of("0123456789-") == std::string_view::npos;
}

/// Removes the temporary files of programs that were killed. Nobody writes for an hour without a
/// byte: it is age that tells, since a folder may be shared by machines that know nothing of each
/// other's programs. What can't be removed stays.
void remove_forgotten(const fs::path& folder) {
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code one;
    if (!is_temporary(entry->path().filename().string()) ||
        !fs::is_regular_file(entry->symlink_status(one)))
      continue;
    const auto written = fs::last_write_time(entry->path(), one);
    if (!one && now - written > std::chrono::hours(1)) fs::remove(entry->path(), one);
  }
}

/// A new file of its own name in a folder, removed again unless it was renamed away.
class Temporary {
 public:
  explicit Temporary(const fs::path& target) : target_(target) {
    const fs::path folder = folder_of(target);
    for (int attempt = 0; attempt < 1000; ++attempt) {
      path_ = folder / (std::string(temporary_prefix) + std::to_string(::getpid()) + "-" +
                        std::to_string(attempt) + std::string(temporary_suffix));
      number_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
      if (number_ >= 0) return;
      if (errno == ENOENT || errno == ENOTDIR)
        give_up(target, "there is no folder " + folder.string());
      if (errno != EEXIST) give_up(target, cause(errno));
    }
    give_up(target, "no free name for a temporary file");
  }
  ~Temporary() {
    if (number_ >= 0) ::close(number_);
    if (!renamed_) ::unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void write(std::string_view bytes) {
    write_all(number_, bytes, target_);
    if (::fsync(number_) != 0) give_up(target_, cause(errno));
    const int result = ::close(number_);
    number_ = -1;
    if (result != 0) give_up(target_, cause(errno));
  }

  void rename() {
    if (::rename(path_.c_str(), target_.c_str()) != 0) give_up(target_, cause(errno));
    renamed_ = true;
  }

 private:
  fs::path target_, path_;
  int number_ = -1;
  bool renamed_ = false;
};

/// The file behind a link, so that the link stays one.
fs::path behind_links(const fs::path& file) {
  std::error_code error;
  if (!fs::is_symlink(file, error)) return file;
  fs::path target = fs::weakly_canonical(file, error);
  if (error) give_up(file, error.message());
  return target;
}

void refuse_what_is_no_file(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    if (errno != ENOENT) give_up(file, cause(errno));
  } else if (S_ISDIR(status.st_mode)) {
    give_up(file, "it is a folder");
  } else if (!S_ISREG(status.st_mode)) {
    give_up(file, "it is not a regular file");
  }
}

void flush_folder(const fs::path& file) {
  const Descriptor opened(::open(folder_of(file).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // Some file systems can't flush a folder and say EINVAL: the file itself is safe by then.
  if (opened.open() && ::fsync(opened.number()) != 0 && errno != EINVAL && errno != ENOTSUP) {
    give_up(file, cause(errno));
  }
}

/// Reads up to `size` bytes and whether the file ends there.
/// @param expected  how many there probably are
std::optional<std::string> contents(int number, std::uint64_t size, std::uint64_t expected) {
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(expected) + 1);
  while (bytes.size() <= size) {
    const std::size_t before = bytes.size();
    bytes.resize(before + std::min<std::uint64_t>(piece, size + 1 - before));
    const ssize_t got = ::read(number, bytes.data() + before, bytes.size() - before);
    bytes.resize(before + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) break;
  }
  return bytes;
}

std::string in_megabytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

/// A regular file of that length, or nothing and a fault.
struct Opened {
  int number = -1;
  std::uint64_t size = 0;
};

std::optional<Opened> open_regular(const fs::path& file, const Location& asked_at, Faults& faults) {
  const auto refuse = [&](const std::string& problem, const std::string& remedy) {
    faults.add(asked_at, problem, remedy);
    return std::nullopt;
  };
  const std::string name = file.string();
  const int number = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (number < 0) {
    const int code = errno;
    if (code == ENOENT) return refuse("there is no file " + name, "check its name and its folder");
    return refuse("can't read " + name + ": " + cause(code), "make it readable");
  }
  struct stat status {};
  if (::fstat(number, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(number);
    return refuse(name + " is not a regular file", "name a file, not a folder or a device");
  }
  return Opened{number, static_cast<std::uint64_t>(status.st_size)};
}

}  // namespace

RegularFile::RegularFile(const fs::path& file) {
  Faults faults;
  const auto opened = open_regular(file, {}, faults);
  faults.raise();
  number_ = opened->number;
  size_ = opened->size;
}

RegularFile::~RegularFile() { ::close(number_); }

std::string RegularFile::read(std::uint64_t offset, std::size_t count) const {
  std::string bytes(
      static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - std::min(offset, size_))),
      '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::pread(number_, bytes.data() + done, std::min(bytes.size() - done, piece),
                                static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

std::optional<std::string> read_file(const fs::path& file, std::uint64_t limit,
                                     const Location& asked_at, Faults& faults, Digests* digests) {
  const auto refuse = [&](const std::string& problem, const std::string& remedy) {
    faults.add(asked_at, problem, remedy);
    return std::nullopt;
  };
  const bool standard = file == standard_stream;
  const std::string name = standard ? "standard input" : file.string();
  const auto found =
      standard ? Opened{::dup(STDIN_FILENO), limit} : open_regular(file, asked_at, faults);
  if (!found) return std::nullopt;
  const Descriptor opened(found->number);
  const std::uint64_t size = found->size;
  const std::string too_long = "at most " + in_megabytes(limit) + " are read";
  if (size > limit) return refuse(name + " has " + in_megabytes(size), too_long);
  try {
    auto bytes = contents(opened.number(), size, standard ? 0 : size);
    if (!bytes) return refuse("can't read " + name + ": " + cause(errno), "check the disk");
    if (bytes->size() > size && standard) return refuse(name + " is longer", too_long);
    if (bytes->size() > size) return refuse(name + " grew while it was read", "try again");
    if (digests) (*digests)[file] = digest(*bytes);
    return bytes;
  } catch (const std::bad_alloc&) {
    return refuse("no memory for the " + in_megabytes(size) + " of " + name, "use a smaller file");
  }
}

namespace {

/// Whether the file's bytes are these; a piece at a time, for they may take much of the memory.
bool holds(const fs::path& file, std::string_view bytes) {
  try {
    const RegularFile opened(file);
    if (opened.size() != bytes.size()) return false;
    for (std::size_t at = 0; at < bytes.size(); at += piece)
      if (opened.read(at, piece) != bytes.substr(at, piece)) return false;
    return true;
  } catch (const SceneError&) {
    return false;
  }
}

}  // namespace

void replace_file(const fs::path& file, std::string_view bytes) {
  if (file == standard_stream) return write_all(STDOUT_FILENO, bytes, "standard output");
  const fs::path target = behind_links(file);
  refuse_what_is_no_file(target);
  Temporary temporary(target);
  temporary.write(bytes);
  temporary.rename();
  flush_folder(target);
  if (!holds(target, bytes)) give_up(file, "what was written did not come back");
}

void check_replaceable(const fs::path& file) {
  if (file == standard_stream) {
    if (::isatty(STDOUT_FILENO) == 0) return;
    refuse("standard output is a terminal, which shows no files",
           "send it on with | or >, or name a file");
  }
  const fs::path target = behind_links(file);
  refuse_what_is_no_file(target);
  remove_forgotten(folder_of(target));
  const Temporary trial(target);
}

}  // namespace portalens
