/// \file
/// Telling whether bytes are the same without keeping them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace portalens {

/// 128 bits in 32 hexadecimal digits: XXH3 of xxHash, the same in every build and on every machine.
/// Guards against accidents, not against forgers.
[[nodiscard]] std::string digest(std::string_view bytes);

/// The digests of files, as their bytes were when they were read.
using Digests = std::map<std::filesystem::path, std::string>;

}  // namespace portalens
