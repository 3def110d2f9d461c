#include "portal/portal.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace portalens {

Frame polygon_frame(const std::vector<Vec3d>& vertices) {
  const std::size_t count = vertices.size();
  Vec3d sum, newell;
  for (const Vec3d& v : vertices) sum += v - vertices[0];
  const Vec3d origin = vertices[0] + sum / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i)
    newell += cross(vertices[i] - origin, vertices[(i + 1) % count] - origin);
  const Vec3d normal = normalize(newell);
  const Vec3d edge = vertices[1] - vertices[0];
  const Vec3d right = normalize(edge - normal * dot(edge, normal));
  return {origin, right, cross(normal, right), normal};
}

FaceInput polygon_input(std::vector<Vec3d> vertices) {
  FaceInput input;
  input.frame = polygon_frame(vertices);
  input.vertices = std::move(vertices);
  return input;
}

void give_face(Portal& portal, const FaceInput& input) {
  std::optional<Aperture> aperture = aperture_from(input);
  assert(aperture);
  portal.frame = input.frame;
  portal.aperture = *std::move(aperture);
  portal.longest_edge = size_of(portal.aperture);
  portal.vertices = input.vertices;
  if (!portal.vertices.empty()) return;
  for (const Vec3d& corner : outline_of(portal.aperture))
    portal.vertices.push_back(portal.frame.to_world(corner));
}

namespace {

std::vector<std::vector<Vec3d>> in_space(const Frame& frame,
                                         std::vector<std::vector<Vec3d>> polygons) {
  for (std::vector<Vec3d>& polygon : polygons)
    for (Vec3d& corner : polygon) corner = frame.to_world(corner);
  return polygons;
}

}  // namespace

std::vector<std::vector<Vec3d>> pieces_of(const Portal& portal) {
  if (std::holds_alternative<ConvexPolygon>(portal.aperture)) return {portal.vertices};
  return in_space(portal.frame,
                  std::visit([](const auto& a) { return a.pieces(); }, portal.aperture));
}

std::vector<std::vector<Vec3d>> gaps_of(const Portal& portal) {
  return in_space(portal.frame,
                  std::visit([](const auto& a) { return a.gaps(); }, portal.aperture));
}

Aperture aperture_at(const Portal& portal, const std::vector<Vec3d>& vertices, const Frame& frame) {
  std::vector<Vec3d> local;
  for (const Vec3d& vertex : vertices) local.push_back(frame.to_local(vertex));
  return std::visit([&](const auto& a) { return Aperture(a.carried(std::move(local))); },
                    portal.aperture);
}

std::vector<Portal> one_sided(std::span<const Portal> portals) {
  std::vector<Portal> all(portals.begin(), portals.end());
  std::vector<std::uint32_t> reverse_of(portals.size());
  auto count = static_cast<std::uint32_t>(portals.size());
  for (std::size_t i = 0; i < portals.size(); ++i)
    if (portals[i].two_sided) reverse_of[i] = count++;
  for (const Portal& portal : portals) {
    if (!portal.two_sided) continue;
    Portal& reverse = all.emplace_back(portal);
    // The first edge stays the first, the other way: so the pairs of vertices stay pairs.
    std::reverse(reverse.vertices.begin() + 2, reverse.vertices.end());
    std::swap(reverse.vertices[0], reverse.vertices[1]);
    reverse.frame.right = -portal.frame.right;
    reverse.frame.normal = -portal.frame.normal;
    reverse.aperture = aperture_at(portal, reverse.vertices, reverse.frame);
    reverse.pair = reverse_of[portal.pair];
  }
  return all;
}

double congruence_error(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  const std::size_t count = a.size();
  if (count != b.size()) return std::numeric_limits<double>::infinity();
  const Rigid through = motion_through(polygon_frame(a), polygon_frame(b));
  double worst = 0.0, longest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d& partner = b[(count + 1 - i) % count];
    worst = std::max(worst, length(through.move(a[i]) - partner));
    longest = std::max(longest, length(a[(i + 1) % count] - a[i]));
  }
  return worst / longest;
}

}  // namespace portalens
