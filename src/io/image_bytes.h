/// \file
/// The bytes of a picture file, told and cleaned before a decoder sees them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace portalens {

enum class ImageFormat { exr, png, hdr, jpeg };

/// What the first bytes say; nothing for any other kind of file.
[[nodiscard]] std::optional<ImageFormat> image_format(std::string_view bytes);

/// What kind of picture it is that is not read, for messages: BMP, GIF, TIFF, WebP, ...; empty if
/// that can't be told.
[[nodiscard]] std::string_view unread_format(std::string_view bytes);

/// The same picture without what only describes it: camera data, comments, colour profiles.
/// Decoders have been crashed through those. EXR and HDR come back as they are. Nothing for a PNG
/// whose chunks are cut off or differ from their checksums.
[[nodiscard]] std::optional<std::string> without_descriptions(std::string bytes,
                                                              ImageFormat format);

}  // namespace portalens
