#include "shading/portal_back_light.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "shading/portal_back.h"

namespace portalens {

PortalBackLight::PortalBackLight(Portal portal, Texture emitted)
    : portal_(std::move(portal)), emitted_(std::move(emitted)) {
  double scale = 1.0;
  if (is_curved(portal_.aperture))
    scale = std::sqrt(area_of(portal_.aperture) / area_of(outline_of(portal_.aperture)));
  const auto place = [&](Vec3d corner) {
    return scale == 1.0 ? corner : portal_.frame.origin + (corner - portal_.frame.origin) * scale;
  };
  for (const std::vector<Vec3d>& v : pieces_of(portal_))
    for (std::size_t i = 2; i < v.size(); ++i) add({place(v[0]), place(v[i - 1]), place(v[i])});
}

void PortalBackLight::add(const TriangleCorners& triangle) {
  choice_.add(triangle, brightness_of(emitted_, triangle,
                                      [&](Vec3d x) { return point_on_back(portal_, x); }));
}

LightSample PortalBackLight::sample(Vec3d x, double u1, double u2) const {
  const SeenPoint seen = choice_.choose(x, u1, u2);
  if (!(portal_.frame.to_local(x).z < 0.0)) return {seen.position};
  const Rgb radiance = color_at(emitted_, point_on_back(portal_, seen.position));
  return {seen.position, radiance * seen.solid_angle};
}

Rgb PortalBackLight::power() const {
  constexpr int parts = 256;
  Rgb sum;
  for (std::size_t i = 0; i < choice_.size(); ++i)
    sum += mean_over(choice_[i], parts,
                     [&](Vec3d x) { return color_at(emitted_, point_on_back(portal_, x)); }) *
           area_of(choice_[i]);
  return sum * std::numbers::pi;
}

}  // namespace portalens
