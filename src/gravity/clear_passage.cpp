#include "gravity/clear_passage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "gravity/rim_ways.h"

namespace portalens {
namespace {

/// How far a place is from the part of a plane that a corner at the origin, with those sides,
/// opens.
double from_corner(Vec3d first, Vec3d second, Vec3d place) {
  const Vec3d normal = cross(first, second);
  const double size = length(normal);
  if (size > 0.0 && dot(cross(normal, first), place) >= 0.0 &&
      dot(cross(second, normal), place) >= 0.0)
    return std::fabs(dot(normal, place)) / size;
  const auto from_ray = [&](Vec3d ray) {
    const double along = std::max(0.0, dot(place, ray) / dot(ray, ray));
    return length(place - ray * along);
  };
  return std::min(from_ray(first), from_ray(second));
}

/// How far `a` may move, at the least, before a straight way through the face begins or ceases;
/// ends are given in the face's coordinates. It is straight from in front of the face, within the
/// pyramid over it whose top is `b`.
double clear_line(const PortalFace& face, Vec3d a, Vec3d b) {
  const double tolerance = face.height_tolerance(), height = a.z + tolerance;
  if (b.z > tolerance) return std::numeric_limits<double>::infinity();
  if (b.z >= 0.0) return 0.0;
  if (!face.is_convex_polygon()) {
    if (height < 0.0) return -height;
    const std::vector<Vec3d> outline = outline_of(face.aperture());
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3d &from = outline[i], &to = outline[(i + 1) % outline.size()];
      least = std::min(
          least, from_corner(Vec3d{from.x, from.y, 0.0} - b, Vec3d{to.x, to.y, 0.0} - b, a - b));
    }
    // The outline of an ellipse lies about it.
    if (face.ellipse()) {
      const double wider = 1e-3 * size_of(face.aperture()) * std::max(1.0, length(a - b) / -b.z);
      least = std::max(0.0, least - wider);
    }
    return straight_through(face, a, b) >= 0.0 ? std::min(least, height) : least;
  }
  double outside = -std::numeric_limits<double>::infinity();
  for (const FaceEdge& edge : face.edges()) {
    const Vec3d start{edge.start_x, edge.start_y, 0.0};
    const Vec3d normal = cross({edge.direction_x, edge.direction_y, 0.0}, start - b);
    outside = std::max(outside, dot(normal, a - start) / length(normal));
  }
  if (height < 0.0) return std::max(-height, outside);
  return outside <= 0.0 ? std::min(-outside, height) : outside;
}

/// How much longer than the shortest way round an ellipse that over a place far from it is.
double lead_round(const Ellipse& ellipse, Vec3d a, Vec3d b) {
  constexpr double far = std::numbers::pi / 3.0;
  const Slide rim = local_slide(ellipse);
  const std::vector<CurvePlace> places = least_places(rim, a, b);
  double second = std::numeric_limits<double>::infinity();
  if (places.size() > 1) second = places[1].length;
  for (double angle = far; angle < 2.0 * std::numbers::pi - far; angle += 0.1) {
    const Vec3d y = rim.at(places[0].angle + angle);
    second = std::min(second, length(y - a) + length(b - y));
  }
  return second - places[0].length;
}

/// How much longer than the shortest path over the rim that over another feature is.
double lead_over_rim(const PortalFace& face, Vec3d a, Vec3d b) {
  if (const Ellipse* ellipse = face.ellipse()) return lead_round(*ellipse, a, b);
  double least = std::numeric_limits<double>::infinity(), second = least;
  Turn best = straight_on;
  for (std::uint32_t i = 0; i < face.edges().size(); ++i) {
    const RimWay<double> way = over_piece(face, i, a, b);
    const Turn turn = rim_turn(face, i, way.place);
    const bool better = way.length < least;
    // A vertex is met along two edges.
    if (turn.code() != best.code()) second = std::min(second, better ? least : way.length);
    if (better) best = turn, least = way.length;
  }
  return second - least;
}

}  // namespace

double clear_passage(Vec3d from, Vec3d to, const PortalFace& face) {
  const Vec3d a = face.frame().to_local(from), b = face.frame().to_local(to);
  const double sight = clear_line(face, a, b);
  if (straight_through(face, a, b) >= 0.0) return sight;
  // Both lengths change by no more than the place does.
  return std::min(sight, 0.5 * lead_over_rim(face, a, b));
}

}  // namespace portalens
