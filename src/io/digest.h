/// \file
/// Telling whether bytes are the same without keeping them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace portalens {

/// 128 bits in 32 hexadecimal digits: FarmHash's Fingerprint128, or FNV-1a in builds without
/// OpenImageIO; the same on every machine. Guards against accidents, not against forgers.
[[nodiscard]] std::string digest(std::string_view bytes);

/// The digests of files, as their bytes were when they were read.
using Digests = std::map<std::filesystem::path, std::string>;

}  // namespace portalens
