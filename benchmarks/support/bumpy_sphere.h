/// \file
/// A mesh of any size for scenes that want one.
#pragma once

#include <string>

namespace portalens::benchmarks {

/// A sphere with hills and pits, as the text of an OBJ file: about the origin, of mean radius 1,
/// closed, with at least `triangles` triangles, all of them of about the same size but at the
/// poles.
/// @pre triangles >= 8
[[nodiscard]] std::string bumpy_sphere(int triangles);

}  // namespace portalens::benchmarks
