#include "shading/shading_point.h"

#include "shading/portal_back.h"

namespace portalens {

ShadedSurface ShadingPoints::at(const Arrival& arrival) const {
  if (arrival.met == Met::portal_back) return on_back(arrival);
  if (const Quad* quad = plain_quad(arrival)) return on(*quad, arrival);
  ShadedSurface place = on_surface(
      arrival, space_.surfaces.surface_at(arrival.object, arrival.face, arrival.position));
  if (const auto* mesh = std::get_if<Mesh>(&shapes_[arrival.object]))
    place.point.bulge = mesh->bulge_at(arrival.position, arrival.face, place.point.front);
  return place;
}

ShadedSurface ShadingPoints::on_back(const Arrival& arrival) const {
  const Portal& portal = space_.portals.portals()[arrival.object];
  ShadingPoint point;
  point.material = *portal.back_material;
  point.normal = point.outward = -portal.frame.normal;
  const double height = dot(arrival.position - portal.frame.origin, portal.frame.normal);
  point.position = arrival.position - portal.frame.normal * height;
  point.shape = static_cast<std::uint32_t>(shapes_.size()) + arrival.object;
  point.front = -1.0;
  point.size = length(point.position) + portal.longest_edge;
  return {point, point_on_back(portal, arrival.position)};
}

Rgb albedo_of(const Appearance& appearance, const ShadedSurface& place, Vec3d out) {
  return std::visit(
      [&](const auto& bsdf) {
        const auto here = bsdf.at(place.surface);
        Rgb albedo = here.albedo(place.point.normal, out);
        if constexpr (HasGlossy<decltype(here)>)
          albedo += here.glossy_albedo(place.point.normal, out);
        return albedo;
      },
      appearance.materials[place.point.material].bsdf());
}

}  // namespace portalens
