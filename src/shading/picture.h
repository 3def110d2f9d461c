/// \file
/// A picture on a surface.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "core/image.h"
#include "geometry/ray.h"
#include "math/vec3.h"

namespace portalens {

/// How a picture goes on beyond its edges.
enum class Wrap { repeat, clamp, mirror };

/// Where a picture lies on a surface: on flat faces in lengths, along the first edge and across it
/// from the first vertex, if it has a `size`; else in u and v.
struct Placement {
  std::optional<std::array<double, 2>> size;  ///< width and height; of none 1 x 1, in u and v
  std::array<double, 2> offset{0.0, 0.0};     ///< of its lower left corner
  double cosine = 1.0, sine = 0.0;            ///< of the angle by which it is turned to the left
  Wrap wrap = Wrap::repeat;

  friend bool operator==(const Placement&, const Placement&) = default;
};

/// Bilinear; v = 0 is the bottom row. Repeated in both directions, if its placement says nothing
/// else.
struct Picture {
  std::shared_ptr<const Image> image;
  double scale = 1.0;  ///< by which its colours are multiplied
  std::optional<Placement> placement{};

  [[nodiscard]] Rgb at(const SurfacePoint& point) const {
    return placement ? placed_at(point) : at(point.u, point.v);
  }
  /// Whether u and v tell where it lies on a flat face, too.
  [[nodiscard]] bool uses_coordinates() const { return !placement || !placement->size; }

 private:
  [[nodiscard]] Rgb at(double u, double v) const;
  [[nodiscard]] Rgb placed_at(const SurfacePoint& point) const;
};

/// The first three channels of one pixel.
[[nodiscard]] inline Rgb pixel(const Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return {p[0], p[1], p[2]};
}

/// The image at column `x` and row `y`, both continuous: pixel centres lie at halves. Columns
/// repeat; rows repeat too, or stop at the edge.
enum class Rows { repeat, clamp };
[[nodiscard]] Rgb bilinear(const Image& image, double x, double y, Rows rows);

}  // namespace portalens
