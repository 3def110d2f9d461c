/// \file
/// Letters beyond ASCII, kept from the TOML library: toml++ 3.3 runs into undefined behaviour where
/// some of them (U+00A1 to U+0499) stand outside of strings.
#pragma once

#include <string>
#include <string_view>

namespace portalens {

/// The line of the first byte that is not UTF-8; 0 if all of it is.
[[nodiscard]] int line_not_utf8(std::string_view text);

/// The text with each byte beyond ASCII replaced by a letter of Unicode's last private plane, which
/// the library passes through wherever any letter may stand.
[[nodiscard]] std::string disguised(std::string_view text);

/// What `disguised` was given.
[[nodiscard]] std::string undisguised(std::string_view text);

}  // namespace portalens
