/// \file
/// Straight things: rays, segments, boxes, and what a ray learns when it meets a surface.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "math/vec3.h"

namespace portalens {

/// `direction` is a unit vector; distances along the ray are lengths.
struct Ray {
  Vec3d origin, direction;
  [[nodiscard]] Vec3d at(double distance) const { return origin + direction * distance; }
};

struct Segment {
  Vec3d a, b;
};

/// An axis-aligned box; empty until something is added.
struct Box {
  Vec3d low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  Vec3d high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};

  void add(Vec3d p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void add(const Box& b) {
    low = {std::min(low.x, b.low.x), std::min(low.y, b.low.y), std::min(low.z, b.low.z)};
    high = {std::max(high.x, b.high.x), std::max(high.y, b.high.y), std::max(high.z, b.high.z)};
  }
  [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
  [[nodiscard]] Vec3d middle() const { return (low + high) * 0.5; }
  [[nodiscard]] double diagonal() const { return empty() ? 0.0 : length(high - low); }
  /// The same box, larger by `margin` on each side.
  [[nodiscard]] Box grown(double margin) const {
    const Vec3d m{margin, margin, margin};
    return {low - m, high + m};
  }
  /// Distance from `p`; 0 inside.
  [[nodiscard]] double distance(Vec3d p) const {
    return length(Vec3d{std::max({low.x - p.x, 0.0, p.x - high.x}),
                        std::max({low.y - p.y, 0.0, p.y - high.y}),
                        std::max({low.z - p.z, 0.0, p.z - high.z})});
  }
};

/// Where a ray meets one shape. `face` tells which of its smooth pieces (a side, a cap, a
/// triangle).
struct Contact {
  double distance = 0.0;
  std::uint32_t face = 0;
};

/// A point of a surface, with what shading needs to know of it.
struct SurfacePoint {
  Vec3d position;
  Vec3d normal;            ///< unit, outward for closed shapes, towards the front for flat ones
  Vec3d geometric_normal;  ///< tells sides; `normal` differs where a mesh interpolates it
  double u = 0, v = 0;     ///< texture coordinates
  bool flat = false;       ///< checkers go by lengths along the face, not by u and v
  double along = 0, across = 0;  ///< those lengths, from the first vertex; only if `flat`
};

/// A point of a surface, drawn as some place sees it. The mean of f `solid_angle` over such points
/// is the integral of f over the directions in which the surface is seen.
struct SeenSurface {
  SurfacePoint point;
  double solid_angle = 0.0;  ///< 1 over the probability per solid angle
};

}  // namespace portalens
