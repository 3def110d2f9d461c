/// \file
/// Whole files in, whole files out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"

namespace portalens {

/// The bytes of a regular file; a FIFO or a device is never waited for. A fault is added, and
/// nothing returned, if there is no such file, it can't be read, or is longer than `limit` bytes.
[[nodiscard]] std::optional<std::string> read_file(const std::filesystem::path& file,
                                                   std::uint64_t limit, const Location& asked_at,
                                                   Faults& faults);

/// Puts the bytes into a temporary file beside the target, flushes it, renames it, and reads the
/// result back: whoever looks sees the old file or the new one, both whole. A link is followed.
/// @throws WorkError with the path and the cause; the old file then still stands
void replace_file(const std::filesystem::path& file, std::string_view bytes);

/// Tries what `replace_file` will do, short of replacing anything.
/// @throws WorkError with the path and the cause
void check_replaceable(const std::filesystem::path& file);

}  // namespace portalens
