#include "shading/shape_light.h"

#include <numbers>
#include <utility>
#include <variant>

namespace portalens {

ShapeLight::ShapeLight(Shape shape, Texture emitted)
    : shape_(std::move(shape)),
      emitted_(std::move(emitted)),
      area_(std::visit([](const auto& s) { return s.area(); }, shape_)) {}

LightSample ShapeLight::sample(Vec3d /*x*/, double u1, double u2) const {
  const SurfacePoint point = std::visit([&](const auto& s) { return s.sample(u1, u2); }, shape_);
  return {point.position, point.geometric_normal, color_at(emitted_, point) * area_,
          Shining::both_sides};
}

Rgb ShapeLight::power() const {
  // One colour is told by one point.
  const int parts = std::holds_alternative<Constant>(emitted_) ? 1 : 256;
  Rgb sum;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j) sum += sample({}, (i + 0.5) / parts, (j + 0.5) / parts).power;
  return sum * (2.0 * std::numbers::pi / (double{1} * parts * parts));
}

}  // namespace portalens
