#include "shading/light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/extent.h"

namespace portalens {
namespace {

double area_of(const TriangleLight::Triangle& t) {
  return 0.5 * length(cross(t.b - t.a, t.c - t.a));
}

}  // namespace

PointLight PointLight::from(Parameters& parameters) {
  PointLight light;
  light.position = to_vec3(parameters.triple("position", coordinate));
  light.intensity = to_vec3(parameters.triple("intensity", non_negative));
  return light;
}

ShapeLight::ShapeLight(std::string its_name, Shape its_shape, Rgb its_emitted)
    : name(std::move(its_name)),
      shape(std::move(its_shape)),
      emitted(its_emitted),
      area(std::visit([](const auto& s) { return s.area(); }, shape)) {}

LightSample ShapeLight::sample(double u1, double u2) const {
  const SurfacePoint point = std::visit([&](const auto& s) { return s.sample(u1, u2); }, shape);
  return {point.position, point.geometric_normal, emitted * area, Shining::both_sides};
}

TriangleLight::TriangleLight(std::string name, std::vector<Triangle> triangles, Shining shining)
    : name_(std::move(name)), triangles_(std::move(triangles)), shining_(shining) {
  cumulative_.reserve(triangles_.size());
  double power = 0.0;
  for (const Triangle& triangle : triangles_) {
    area_ += area_of(triangle);
    power += area_of(triangle) * max_component(triangle.emitted);
    cumulative_.push_back(power);
  }
}

LightSample TriangleLight::sample(double u1, double u2) const {
  const double wanted = u1 * cumulative_.back();
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, wanted);
  const double before = found == cumulative_.begin() ? 0.0 : *(found - 1);
  const Triangle& t = triangles_[static_cast<std::size_t>(found - cumulative_.begin())];
  // What is left of u1 within its triangle is uniform again; then the square folds to a triangle.
  const double within = std::clamp((wanted - before) / (*found - before), 0.0, 1.0);
  const double root = std::sqrt(within);
  const Vec3d position = t.a + (t.b - t.a) * (root * (1.0 - u2)) + (t.c - t.a) * (root * u2);
  const Vec3d normal = normalize(cross(t.b - t.a, t.c - t.a));
  const Rgb power = t.emitted * (cumulative_.back() / max_component(t.emitted));
  return {position, normal, power, shining_};
}

const std::string& name_of(const Light& light) {
  struct Name {
    const std::string& operator()(const PointLight& l) const { return l.name; }
    const std::string& operator()(const ShapeLight& l) const { return l.name; }
    const std::string& operator()(const TriangleLight& l) const { return l.name(); }
  };
  return std::visit(Name{}, light);
}

LightSample sample_light(const Light& light, double u1, double u2) {
  return std::visit([&](const auto& kind) { return kind.sample(u1, u2); }, light);
}

std::uint32_t sample_count(const Light& light, std::uint32_t shadow_samples) {
  return std::holds_alternative<PointLight>(light) ? 1 : shadow_samples;
}

}  // namespace portalens
