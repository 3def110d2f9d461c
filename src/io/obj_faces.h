/// \file
/// Faces of a text that may be ordinary OBJ or the dialect: of the dialect, all are flat.
#pragma once

#include <string_view>
#include <vector>

#include "math/vec3.h"

namespace portalens {

/// Takes a text line by line and tells whether a face of it cannot be a quad of the dialect. Only
/// texts with one statement a line are judged, as all ordinary ones are.
class PlainFaces {
 public:
  /// @param words  of the next line, at least one
  void take(const std::vector<std::string_view>& words);

  /// Whether some face of four corners is not flat, by the measure of `Quad` (geometry/quad.h).
  [[nodiscard]] bool bent() const { return bent_ && plain_; }

 private:
  void take_face(const std::vector<std::string_view>& words);

  std::vector<Vec3d> points_;
  bool plain_ = true;
  bool bent_ = false;
};

}  // namespace portalens
