/// \file
/// Whole files in, whole files out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "io/digest.h"

namespace portalens {

/// The name that means standard input where a file is read, standard output where one is written.
inline constexpr const char* standard_stream = "-";

/// The bytes of a regular file, or of standard input; a FIFO or a device is never waited for. A
/// fault is added, and nothing returned, if there is no such file, it can't be read, or is longer
/// than `limit` bytes.
/// @param digests  if given, gets the digest of what was read
[[nodiscard]] std::optional<std::string> read_file(const std::filesystem::path& file,
                                                   std::uint64_t limit, const Location& asked_at,
                                                   Faults& faults, Digests* digests = nullptr);

/// A regular file, open to be read in pieces, so that its first bytes can be judged before the rest
/// is taken into memory.
class RegularFile {
 public:
  /// @throws SceneError where `read_file` adds a fault, but for the length
  explicit RegularFile(const std::filesystem::path& file);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Fewer bytes where the file ends, or can't be read on.
  [[nodiscard]] std::string read(std::uint64_t offset, std::size_t count) const;

 private:
  int number_;
  std::uint64_t size_ = 0;
};

/// Puts the bytes into a temporary file beside the target, flushes it, renames it, and reads the
/// result back: whoever looks sees the old file or the new one, both whole. A link is followed.
/// Standard output simply gets them.
/// @throws WorkError with the path and the cause; the old file then still stands
void replace_file(const std::filesystem::path& file, std::string_view bytes);

/// Tries what `replace_file` will do, short of replacing anything; and removes the temporary files
/// beside it that programs left there when they were killed, an hour ago or longer.
/// @throws WorkError with the path and the cause; SceneError if standard output is a terminal
void check_replaceable(const std::filesystem::path& file);

}  // namespace portalens
