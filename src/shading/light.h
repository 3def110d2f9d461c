/// \file
/// What gives light: points, and surfaces that emit. equations.md, sec. 7.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/parameters.h"
#include "geometry/shape.h"
#include "math/vec3.h"

namespace portalens {

/// Which sides of a light shine; `everywhere` is a point's.
enum class Shining { everywhere, both_sides, back_only };

/// One point of a light, as a surface that it shines on sees it.
/// Irradiance of a surface at distance d under the angle θ, before anything is in the way:
/// `power · cos θ / d²`, for a light with a surface times |cos| of the angle at the light.
struct LightSample {
  Vec3d position;
  Vec3d normal;  ///< unit; of no meaning for a point light
  Rgb power;     ///< W/sr: intensity of a point; radiance over probability per area of a surface
  Shining shining = Shining::everywhere;
};

/// A `[[light]]`.
struct PointLight {
  std::string name;
  Vec3d position;
  Rgb intensity;  ///< W/sr

  static PointLight from(Parameters& parameters);
  [[nodiscard]] LightSample sample(double /*u1*/, double /*u2*/) const {
    return {position, {}, intensity, Shining::everywhere};
  }
};

/// A shape all of which emits the same.
struct ShapeLight {
  std::string name;
  Shape shape;
  Rgb emitted;        ///< radiance
  double area = 0.0;  ///< of the shape

  ShapeLight(std::string name, Shape shape, Rgb emitted);
  [[nodiscard]] LightSample sample(double u1, double u2) const;
};

/// Triangles that emit, each its own radiance: of a mesh, or the back of a portal. A triangle is
/// chosen with a probability in proportion to its power.
class TriangleLight {
 public:
  struct Triangle {
    Vec3d a, b, c;
    Rgb emitted;  ///< radiance, not 0
  };
  TriangleLight(std::string name, std::vector<Triangle> triangles, Shining shining);
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] double area() const { return area_; }
  [[nodiscard]] Shining shining() const { return shining_; }
  [[nodiscard]] LightSample sample(double u1, double u2) const;

 private:
  std::string name_;
  std::vector<Triangle> triangles_;
  std::vector<double> cumulative_;  ///< power up to and with each triangle
  double area_ = 0.0;
  Shining shining_ = Shining::both_sides;
};

using Light = std::variant<PointLight, ShapeLight, TriangleLight>;

[[nodiscard]] const std::string& name_of(const Light& light);
[[nodiscard]] LightSample sample_light(const Light& light, double u1, double u2);
/// How many samples of it a surface takes: a point needs only one.
[[nodiscard]] std::uint32_t sample_count(const Light& light, std::uint32_t shadow_samples);
/// Irradiance of a surface at `x` with unit normal `n`, from this sample, nothing being in the way.
[[nodiscard]] inline Rgb irradiance(const LightSample& sample, Vec3d x, Vec3d n) {
  const Vec3d way = sample.position - x;
  const double distance = length(way);
  if (!(distance > 0.0)) return {};
  const double here = dot(n, way) / distance;
  if (!(here > 0.0)) return {};
  double there = 1.0;
  if (sample.shining != Shining::everywhere) there = dot(sample.normal, way) / distance;
  if (sample.shining == Shining::both_sides) there = std::fabs(there);
  if (!(there > 0.0)) return {};
  return sample.power * (here * there / (distance * distance));
}

}  // namespace portalens
