#include "geometry/rays.h"

#include <cmath>
#include <numbers>

namespace portalens {

std::optional<Ray> ray_of(const std::array<double, 6>& numbers) {
  const Vec3d origin{numbers[0], numbers[1], numbers[2]};
  const Vec3d direction{numbers[3], numbers[4], numbers[5]};
  const double largest =
      max_component({std::fabs(direction.x), std::fabs(direction.y), std::fabs(direction.z)});
  if (!is_finite(origin) || !is_finite(direction) || largest == 0.0) return std::nullopt;
  // Divided first, so that squares neither vanish nor overflow.
  return Ray{origin, normalize(direction / largest)};
}

std::vector<Ray> fan_of(const Ray& middle, Vec3d across, double spread, int count) {
  const Vec3d d = middle.direction, off = across - d * dot(across, d);
  const Vec3d axis = length(off) > 1e-6 ? normalize(off) : any_perpendicular(d);
  const Vec3d side = cross(axis, d);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const double share = count > 1 ? i / (count - 1.0) - 0.5 : 0.0;
    const double angle = share * spread * std::numbers::pi / 180.0;
    rays.push_back({middle.origin, normalize(d * std::cos(angle) + side * std::sin(angle))});
  }
  return rays;
}

}  // namespace portalens
