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
    for (std::size_t i = 2; i < v.size(); ++i)
      triangles_.push_back({place(v[0]), place(v[i - 1]), place(v[i])});
  for (const TriangleCorners& triangle : triangles_)
    choice_.add(triangle, brightness_of(emitted_, triangle,
                                        [&](Vec3d x) { return point_on_back(portal_, x); }));
}

LightSample PortalBackLight::sample(Vec3d /*x*/, double u1, double u2) const {
  const TriangleChoice::Point point = choice_.choose(u1, u2);
  const TriangleCorners t = triangles_[point.triangle];
  const Vec3d position = point.on(t);
  const Rgb radiance = color_at(emitted_, point_on_back(portal_, position));
  return {position, normalize(cross(t[1] - t[0], t[2] - t[0])), radiance * point.by_density,
          Shining::back_only};
}

Rgb PortalBackLight::power() const {
  constexpr int parts = 256;
  Rgb sum;
  for (const TriangleCorners& triangle : triangles_)
    sum += mean_over(triangle, parts,
                     [&](Vec3d x) { return color_at(emitted_, point_on_back(portal_, x)); }) *
           area_of(triangle);
  return sum * std::numbers::pi;
}

}  // namespace portalens
