#include "shading/mesh_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace portalens {

MeshLight::MeshLight(Mesh mesh, std::vector<Texture> emitted,
                     const std::function<std::optional<std::uint32_t>(std::uint32_t)>& emitted_by)
    : mesh_(std::move(mesh)), emitted_(std::move(emitted)) {
  for (std::uint32_t triangle = 0; triangle < mesh_.triangle_count(); ++triangle) {
    const auto index = emitted_by(triangle);
    if (!index) continue;
    faces_.push_back({triangle, *index});
    const auto corners = mesh_.triangle(triangle);
    choice_.add(corners, brightness_of(emitted_[*index], corners,
                                       [&](Vec3d x) { return mesh_.surface_at(x, triangle); }));
  }
}

LightSample MeshLight::sample(Vec3d x, double u1, double u2) const {
  const SeenPoint seen = choice_.choose(x, u1, u2);
  const Face& face = faces_[seen.triangle];
  const Texture& emitted = emitted_[face.emitted];
  const auto* constant = std::get_if<Constant>(&emitted);  // which spares looking for coordinates
  const Rgb radiance = constant ? constant->color
                                : color_at(emitted, mesh_.surface_at(seen.position, face.triangle));
  return {seen.position, radiance * seen.solid_angle};
}

Rgb MeshLight::power() const {
  // Few triangles are looked at closely.
  constexpr double max_points = 1e6;
  const double each = std::sqrt(max_points / static_cast<double>(faces_.size()));
  const int fine = static_cast<int>(std::clamp(each, 1.0, 256.0));
  Rgb sum;
  for (const Face& face : faces_) {
    const auto corners = mesh_.triangle(face.triangle);
    const Texture& emitted = emitted_[face.emitted];
    const int parts = std::holds_alternative<Constant>(emitted) ? 1 : fine;
    sum +=
        mean_over(corners, parts,
                  [&](Vec3d x) { return color_at(emitted, mesh_.surface_at(x, face.triangle)); }) *
        area_of(corners);
  }
  return sum * (2.0 * std::numbers::pi);
}

}  // namespace portalens
