#include "gravity/shortest_path_coupling.h"

#include <algorithm>
#include <limits>

#include "gravity/clear_passage.h"
#include "gravity/decision_hash.h"
#include "gravity/way_formulas.h"

namespace portalens {

namespace {

/// The way round an ellipse takes as long to find as over that many edges.
constexpr std::size_t round_as = 16;

/// Carries what lies behind the last portal of a chain back to where it seems to be.
Vec3d unfold(std::span<const Portal> portals, std::span<const std::uint32_t> chain, Vec3d point) {
  for (std::size_t i = chain.size(); i-- > 0;) point = portals[chain[i]].motion()->move_back(point);
  return point;
}

PortalFace unfold_face(std::span<const Portal> portals, std::span<const std::uint32_t> chain,
                       const Portal& portal) {
  std::vector<Vec3d> vertices;
  for (const Vec3d& v : portal.vertices) vertices.push_back(unfold(portals, chain, v));
  Frame frame = portal.frame;
  frame.origin = unfold(portals, chain, frame.origin);
  for (Vec3d* axis : {&frame.right, &frame.up, &frame.normal})
    for (std::size_t i = chain.size(); i-- > 0;)
      *axis = portals[chain[i]].motion()->rotate_back(*axis);
  return PortalFace(aperture_at(portal, vertices, frame), frame, portal.height_tolerance());
}

}  // namespace

ShortestPathCoupling::ShortestPathCoupling(const CouplingInput& input) {
  for (const Portal& portal : input.portals) {
    faces_.emplace_back(portal);
    double radius = 0.0;
    for (const Vec3d& v : portal.vertices)
      radius = std::max(radius, length(v - portal.frame.origin));
    entrances_.push_back({portal.frame.origin, radius, 0.0});
  }
  std::vector<std::uint32_t> chain;
  add_chains(input, chain, none);
  for (const Image& image : images_) {
    Entrance& entrance = entrances_[links_[image.link].first];
    entrance.reach = std::max(entrance.reach, image.influence - image.beyond);
  }
}

CouplingCost ShortestPathCoupling::cost(const CouplingInput& input) {
  std::size_t edges = 0;
  for (const Portal& portal : input.portals)
    edges = std::max(edges, is_curved(portal.aperture) ? round_as : portal.vertices.size());
  // Measured: about six masses an edge, and three times the edges for each further face.
  const auto sides = static_cast<double>(edges);
  double ways = 0.0;
  for (int size = 1; size <= input.depth; ++size)
    ways += chain_count(input, size) * 6.0 * sides * std::pow(3.0 * sides, size - 1);
  return {ways * static_cast<double>(input.masses.size()), 0.0};
}

void ShortestPathCoupling::add_chains(const CouplingInput& input, std::vector<std::uint32_t>& chain,
                                      std::uint32_t parent) {
  if (chain.size() >= static_cast<std::size_t>(input.depth)) return;
  for (std::uint32_t a = 0; a < input.portals.size(); ++a) {
    if (!chain.empty() && a == input.portals[chain.back()].pair) continue;
    const auto link = static_cast<std::uint32_t>(links_.size());
    PortalFace face = unfold_face(input.portals, chain, input.portals[a]);
    chain.push_back(a);
    links_.push_back(
        {std::move(face), a, parent, chain.front(), static_cast<std::uint32_t>(chain.size())});
    add_images(input, chain, link);
    add_chains(input, chain, link);
    chain.pop_back();
  }
}

void ShortestPathCoupling::add_images(const CouplingInput& input,
                                      const std::vector<std::uint32_t>& chain, std::uint32_t link) {
  for (std::uint32_t i = 0; i < input.masses.size(); ++i) {
    const Mass& mass = input.masses[i];
    const Vec3d center = unfold(input.portals, chain, mass.center);
    double beyond = 0.0;
    for (std::uint32_t at = link; at != none; at = links_[at].parent)
      beyond = std::max(beyond, links_[at].face.distance(center));
    if (mass.gm > 0.0 && beyond < mass.influence)
      images_.push_back({center, mass.gm, mass.core * mass.core, mass.influence, beyond, link, i});
  }
}

std::vector<std::uint32_t> ShortestPathCoupling::chain(const Image& image) const {
  std::vector<std::uint32_t> portals;
  for (std::uint32_t at = image.link; at != none; at = links_[at].parent)
    portals.insert(portals.begin(), links_[at].portal);
  return portals;
}

FaceRow ShortestPathCoupling::faces_of(const Image& image, Row& row) const {
  std::uint32_t at = image.link;
  const std::size_t size = links_[at].size;
  for (std::size_t i = size; i-- > 0; at = links_[at].parent) row[i] = &links_[at].face;
  return {row.data(), size};
}

bool ShortestPathCoupling::decide(const Image& image, Vec3d x, FaceRow faces, Turns& out) const {
  const Vec3d to = image.center - x;
  if (!(dot(to, to) < image.influence * image.influence)) return false;
  const Entrance& entrance = entrances_[links_[image.link].first];
  const Vec3d apart = x - entrance.center;
  const double limit = image.influence - image.beyond + entrance.radius;
  if (dot(apart, apart) > limit * limit) return false;
  return shortest_passages(x, image.center, faces, image.influence, out);
}

Way ShortestPathCoupling::way(const Image& image, Vec3d x) const {
  Row row;
  Turns turns;
  const FaceRow faces = faces_of(image, row);
  if (!decide(image, x, faces, turns))
    return {std::numeric_limits<double>::infinity(), image.center, false};
  return follow(x, image.center, faces, turns);
}

Vec3d ShortestPathCoupling::attraction(const Image& image, Vec3d x, const Way& way) {
  const Vec3d ahead = way.towards - x;
  const double near2 = dot(ahead, ahead), square = way.length * way.length + image.core2;
  // Exactly at a mass or on a rim there is no direction.
  if (!(near2 > 0.0) || !(square > 0.0)) return {};
  return ahead * way_pull(image.gm, way.length, square, near2);
}

std::vector<PullPart> ShortestPathCoupling::parts(Vec3d x) const {
  std::vector<PullPart> found;
  Row row;
  Turns turns;
  for (const Image& image : images_) {
    const FaceRow faces = faces_of(image, row);
    if (!decide(image, x, faces, turns)) continue;
    const Polyline way = bends(x, image.center, faces, turns);
    PullPart part;
    part.portals = chain(image);
    part.mass = image.mass;
    for (std::size_t i = 0; i < way.count; ++i) part.places.push_back(way.point(i));
    part.beyond = image.center;
    part.distance = way.total();
    const Vec3d towards = part.places.empty() ? image.center : part.places.front();
    part.acceleration = attraction(image, x, {part.distance, towards, part.places.empty()});
    part.entrance = towards;
    if (turns[0].kind == Turn::Kind::straight) {
      const Frame& frame = faces[0]->frame();
      const double from = frame.to_local(x).z, to = frame.to_local(towards).z;
      part.entrance = x + (towards - x) * (from > to ? from / (from - to) : 0.0);
    }
    found.push_back(part);
  }
  return found;
}

Pull ShortestPathCoupling::pull(Vec3d x, Vec3d anchor) const {
  Pull total;
  Row row;
  Turns turns;
  for (const Image& image : images_) {
    const FaceRow faces = faces_of(image, row);
    if (!decide(image, anchor, faces, turns)) continue;
    const Way way = follow(x, image.center, faces, turns);
    const Vec3d acceleration = attraction(image, x, way);
    if (acceleration == Vec3d{}) continue;
    total.acceleration += acceleration;
    const double square = way.length * way.length + image.core2, inverse2 = 1.0 / square;
    total.potential += image.gm * std::sqrt(inverse2);
    const Vec3d ahead = way.towards - x;
    const double scale_inverse2 = 1.0 / way_scale2(way.straight, square, dot(ahead, ahead));
    total.stiffness += image.gm * inverse2 * scale_inverse2 * std::sqrt(scale_inverse2);
    total.nearness += scale_inverse2 * scale_inverse2;
    total.gradient += 2.0 * image.gm * inverse2 * std::sqrt(scale_inverse2);
  }
  return total;
}

std::uint64_t ShortestPathCoupling::signature(Vec3d x) const {
  std::uint64_t total = 0;
  Row row;
  Turns turns;
  for (std::size_t i = 0; i < images_.size(); ++i) {
    const FaceRow faces = faces_of(images_[i], row);
    if (!decide(images_[i], x, faces, turns)) continue;
    std::uint64_t way = mix_decision(0, i);
    for (std::size_t k = 0; k < faces.size(); ++k) way = mix_decision(way, turns[k].code());
    total += way;
  }
  return total;
}

/// A path's length changes by no more than x does: so its distance from the influence bounds how
/// far off the place is where the image begins or ceases to act. Through one portal, as far as the
/// path runs over the same feature, too; through several that is looked for at shares of a step
/// alone.
double ShortestPathCoupling::distance_to_discontinuity(const Image& image, Vec3d x) const {
  const Entrance& entrance = entrances_[links_[image.link].first];
  const double aside = length(x - entrance.center) - entrance.radius + image.beyond;
  const double least = std::max(aside, length(image.center - x)) - image.influence;
  if (least > 0.25 * image.influence) return least;
  Row row;
  Turns turns;
  const FaceRow faces = faces_of(image, row);
  const double limit = 1.25 * image.influence;
  if (!shortest_passages(x, image.center, faces, limit, turns)) return 0.25 * image.influence;
  const double beyond = follow(x, image.center, faces, turns).length - image.influence;
  if (beyond >= 0.0 || faces.size() > 1) return std::fabs(beyond);
  return std::min(-beyond, clear_passage(x, image.center, *faces[0]));
}

double ShortestPathCoupling::distance_to_discontinuity(Vec3d x) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Image& image : images_) least = std::min(least, distance_to_discontinuity(image, x));
  return least;
}

double ShortestPathCoupling::distance_to_support(Vec3d x) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < faces_.size(); ++a)
    if (entrances_[a].reach > 0.0)
      least = std::min(least, std::max(0.0, faces_[a].distance(x) - entrances_[a].reach));
  return least;
}

}  // namespace portalens
