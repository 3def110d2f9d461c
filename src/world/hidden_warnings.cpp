#include "world/hidden_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <variant>

#include "core/words.h"
#include "world/world.h"

namespace portalens {
namespace {

constexpr std::size_t max_told = 20;
constexpr std::size_t max_asked = 5000;
/// What lies nearer than that share of the size was meant to lie behind.
constexpr double close = 0.02;

/// The middle, and places near the corners.
std::vector<Vec3d> places_on(std::span<const Vec3d> vertices, Vec3d middle) {
  constexpr std::size_t most = 16;
  constexpr double towards_corner = 0.9;
  std::vector<Vec3d> places = {middle};
  for (const Vec3d& vertex : vertices.first(std::min(most, vertices.size())))
    places.push_back(middle + (vertex - middle) * towards_corner);
  return places;
}

/// What lies no farther from such a face is in its plane (geometry/flush.h).
double flush_within(Vec3d middle, double size) {
  const double largest = std::max({std::fabs(middle.x), std::fabs(middle.y), std::fabs(middle.z)});
  return 1.01e-9 * (largest + 2.0 * size);
}

/// What all the rays from the places meet within that distance, and how far away the first meets
/// it.
std::optional<SurfaceHit> met_from_all(const Accelerator& surfaces, std::span<const Vec3d> places,
                                       Vec3d direction, double low, double high) {
  std::optional<SurfaceHit> first;
  for (const Vec3d& place : places) {
    const auto hit = surfaces.nearest({place, direction}, low, high);
    if (!hit || (first && hit->shape != first->shape)) return std::nullopt;
    if (!first) first = hit;
  }
  return first;
}

double size_of(const Quad& quad) {
  const Box box = quad.bounds();
  return length(box.high - box.low);
}

/// Whether `cover` is the wall on which the quad was meant to hang.
/// @param cover  what was met where
bool carries(const Accelerator& surfaces, const SurfaceHit& cover, Vec3d where, const Quad& quad) {
  constexpr double parallel = 0.9999, clearly = 0.999;
  const Vec3d normal = surfaces.surface_at(cover.shape, cover.face, where).geometric_normal;
  const Box box =
      std::visit([](const auto& one) { return one.bounds(); }, surfaces.shapes()[cover.shape]);
  return std::fabs(dot(normal, quad.normal())) > parallel &&
         size_of(quad) < clearly * length(box.high - box.low);
}

}  // namespace

void warn_of_walled_up_portals(const World& world, std::vector<std::string>& warnings) {
  const auto portals = world.space.portals.portals();
  std::size_t found = 0;
  for (const Portal& portal : portals.first(std::min(max_asked, portals.size()))) {
    const auto places = places_on(portal.vertices, portal.frame.origin);
    const auto hit = met_from_all(world.space.surfaces, places, portal.frame.normal,
                                  flush_within(portal.frame.origin, portal.longest_edge),
                                  close * portal.longest_edge);
    if (!hit || found++ >= max_told) continue;
    warnings.push_back(fmt::format(
        "{} lies {:.3g} before the front of portal {}: nothing gets through; put the portal into "
        "that plane, or before it",
        in_quotes(world.appearance.bodies[hit->shape].name), hit->distance,
        in_quotes(portal.name)));
  }
}

void remark_on_hidden_quads(const World& world, std::vector<std::string>& remarks) {
  const Accelerator& surfaces = world.space.surfaces;
  const auto& shapes = surfaces.shapes();
  std::size_t found = 0;
  for (std::size_t i = 0; i < std::min(max_asked, shapes.size()); ++i) {
    const auto* quad = std::get_if<Quad>(&shapes[i]);
    if (!quad) continue;
    const double size = size_of(*quad);
    const Vec3d middle = quad->center_of_mass();
    const bool before = dot(world.camera.position - middle, quad->normal()) > 0.0;
    const Vec3d towards = before ? quad->normal() : -quad->normal();
    const auto hit = met_from_all(surfaces, places_on(quad->vertices(), middle), towards,
                                  flush_within(middle, size), close * size);
    if (!hit || !carries(surfaces, *hit, middle + towards * hit->distance, *quad) ||
        found++ >= max_told)
      continue;
    remarks.push_back(fmt::format("{} lies {:.3g} before {} as the camera sees it, and hides it",
                                  in_quotes(world.appearance.bodies[hit->shape].name),
                                  hit->distance, in_quotes(world.appearance.bodies[i].name)));
  }
}

}  // namespace portalens
