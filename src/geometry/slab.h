/// \file
/// Rays against axis-aligned boxes.
#pragma once

#include <algorithm>
#include <utility>

#include "geometry/ray.h"

namespace portalens {

/// A ray prepared for being clipped to boxes.
class Slab {
 public:
  explicit Slab(const Ray& ray)
      : origin_(ray.origin),
        inverse_{1.0 / ray.direction.x, 1.0 / ray.direction.y, 1.0 / ray.direction.z} {}

  /// The part of [low, high] in the box; empty (first > second) if there is none. An axis on which
  /// the answer is not a number (the ray runs within a face) doesn't clip.
  [[nodiscard]] std::pair<double, double> clip(const Box& box, double low, double high) const {
    cut(box.low.x - origin_.x, box.high.x - origin_.x, inverse_.x, low, high);
    cut(box.low.y - origin_.y, box.high.y - origin_.y, inverse_.y, low, high);
    cut(box.low.z - origin_.z, box.high.z - origin_.z, inverse_.z, low, high);
    return {low, high};
  }

 private:
  static void cut(double first, double second, double inverse, double& low, double& high) {
    const double a = first * inverse, b = second * inverse;
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }

  Vec3d origin_, inverse_;
};

}  // namespace portalens
