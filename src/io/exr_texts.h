/// \file
/// What an EXR file says of itself.
#pragma once

#include <filesystem>

#include "io/image.h"

namespace portalens {

/// The attributes of type `string` that say nothing of its structure, in the header of its first
/// part, in the file's order, and `worldToCamera` (exr_matrix.h). No pixel is read, and no library
/// asked.
/// @throws SceneError if it can't be read, is no EXR, or its header is broken or longer than 16 MiB
[[nodiscard]] Metadata read_exr_texts(const std::filesystem::path& file);

}  // namespace portalens
