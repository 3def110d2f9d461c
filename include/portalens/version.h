/// \file
/// The version of portalens; docs/library.md says what it promises.
#pragma once

#include <string_view>

/// 10000 · major + 100 · minor + patch: a macro, so that the preprocessor can choose by it.
#define PORTALENS_VERSION 200

namespace portalens::api {

/// `MAJOR.MINOR.PATCH` of these headers.
inline constexpr std::string_view version = "0.2.0";

/// The same of the library that is linked: another one than `version` means that the headers are
/// not those it was built with.
[[nodiscard]] std::string_view linked_version() noexcept;

}  // namespace portalens::api
