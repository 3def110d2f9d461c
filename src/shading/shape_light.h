/// \file
/// A shape that emits all over, one colour or a texture. Its points are drawn as they are seen, if
/// the shape knows how, or uniformly by area.
#pragma once

#include "geometry/shape.h"
#include "shading/light_sample.h"
#include "shading/shines.h"
#include "shading/texture.h"

namespace portalens {

class ShapeLight {
 public:
  static constexpr bool is_delta = false;
  /// @param emitted  radiance
  ShapeLight(Shape shape, Texture emitted, Shines shines = Shines::on_both_sides);

  [[nodiscard]] const Shape& shape() const { return shape_; }
  [[nodiscard]] const Texture& emitted() const { return emitted_; }
  [[nodiscard]] LightSample sample(Vec3d x, double u1, double u2) const;
  [[nodiscard]] double area() const { return area_; }
  /// Of what photons find of it, too.
  [[nodiscard]] double found_area() const { return area_; }
  [[nodiscard]] Rgb power() const;

 private:
  Shape shape_;
  Texture emitted_;
  Shines shines_;
  double area_;
};

}  // namespace portalens
