/// \file
/// The one entry of a picture's header that is no text in its file: where the camera stood, as
/// compositing programs read it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace portalens {

/// OpenEXR's standard attribute: a matrix that takes a row vector (x, y, z, 1) of the world to the
/// camera's coordinates, x to the right, y up, z into the depth. Among texts it is 16 numbers, row
/// by row.
inline constexpr std::string_view matrix_entry = "worldToCamera";

using ExrMatrix = std::array<float, 16>;

/// Nothing if the text is not 16 numbers with blanks between them.
[[nodiscard]] std::optional<ExrMatrix> matrix_in(std::string_view text);

[[nodiscard]] std::string matrix_text(const ExrMatrix& matrix);

}  // namespace portalens
