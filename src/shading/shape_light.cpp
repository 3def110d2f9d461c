#include "shading/shape_light.h"

#include <numbers>
#include <utility>
#include <variant>

#include "math/triangle_sample.h"

namespace portalens {

ShapeLight::ShapeLight(Shape shape, Texture emitted, Shines shines)
    : shape_(std::move(shape)),
      emitted_(std::move(emitted)),
      shines_(shines),
      area_(std::visit([](const auto& s) { return s.area(); }, shape_)) {}

LightSample ShapeLight::sample(Vec3d x, double u1, double u2) const {
  const SeenSurface seen = std::visit(
      [&](const auto& shape) -> SeenSurface {
        if constexpr (requires { shape.sample_seen(x, u1, u2); }) {
          return shape.sample_seen(x, u1, u2);
        } else {
          const SurfacePoint point = shape.sample(u1, u2);
          const Vec3d normal = point.geometric_normal;
          return {point, seen_by_area(point.position, normal, area_, x).solid_angle};
        }
      },
      shape_);
  if (shines_ == Shines::in_front &&
      !(dot(x - seen.point.position, seen.point.geometric_normal) > 0.0))
    return {seen.point.position};
  return {seen.point.position, color_at(emitted_, seen.point) * seen.solid_angle};
}

Rgb ShapeLight::power() const {
  // One colour is told by one point.
  const int parts = std::holds_alternative<Constant>(emitted_) ? 1 : 256;
  Rgb sum;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j) {
      const double u1 = (i + 0.5) / parts, u2 = (j + 0.5) / parts;
      sum +=
          color_at(emitted_, std::visit([&](const auto& s) { return s.sample(u1, u2); }, shape_));
    }
  const double sides = shines_ == Shines::in_front ? 1.0 : 2.0;
  return sum * (sides * std::numbers::pi * area_ / (double{1} * parts * parts));
}

}  // namespace portalens
