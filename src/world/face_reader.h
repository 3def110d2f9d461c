/// \file
/// Reading where a portal's face is and what shape it has. docs/scene-format.md, `[[portal]]`.
#pragma once

#include <optional>
#include <string>

#include "core/parameters.h"
#include "portal/face_input.h"

namespace portalens {

/// The face that a portal's table gives: by `vertices`, or about a `center`, `facing` one way, by
/// `size` (a rectangle) or `radius` (an ellipse). Nothing where a fault was added.
[[nodiscard]] std::optional<FaceInput> read_face(Parameters& parameters, const std::string& name);

/// Which of these keys says the shape: where faults of it belong.
[[nodiscard]] std::string_view shape_key(Parameters& parameters);

}  // namespace portalens
