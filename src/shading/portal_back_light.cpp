#include "shading/portal_back_light.h"

#include <numbers>
#include <utility>

#include "shading/portal_back.h"

namespace portalens {

PortalBackLight::PortalBackLight(Portal portal, Texture emitted)
    : portal_(std::move(portal)), emitted_(std::move(emitted)) {
  for (std::size_t i = 0; i + 2 < portal_.vertices.size(); ++i)
    choice_.add(triangle(i), brightness_of(emitted_, triangle(i),
                                           [&](Vec3d x) { return point_on_back(portal_, x); }));
}

/// A convex polygon is a fan of triangles.
TriangleCorners PortalBackLight::triangle(std::size_t index) const {
  return {portal_.vertices[0], portal_.vertices[index + 1], portal_.vertices[index + 2]};
}

LightSample PortalBackLight::sample(Vec3d /*x*/, double u1, double u2) const {
  const TriangleChoice::Point point = choice_.choose(u1, u2);
  const TriangleCorners t = triangle(point.triangle);
  const Vec3d position = point.on(t);
  const Rgb radiance = color_at(emitted_, point_on_back(portal_, position));
  return {position, normalize(cross(t[1] - t[0], t[2] - t[0])), radiance * point.by_density,
          Shining::back_only};
}

Rgb PortalBackLight::power() const {
  constexpr int parts = 256;
  Rgb sum;
  for (std::size_t i = 0; i < choice_.size(); ++i)
    sum += mean_over(triangle(i), parts,
                     [&](Vec3d x) { return color_at(emitted_, point_on_back(portal_, x)); }) *
           area_of(triangle(i));
  return sum * std::numbers::pi;
}

}  // namespace portalens
