#include "portal/concave_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/triangulate.h"

namespace portalens {

ConcavePolygon::ConcavePolygon(std::vector<Vec3d> corners)
    : corners_(std::move(corners)), edges_(edges_between(corners_)), box_(box_of(corners_)) {
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const PlaneEdge &next = edges_[i], &last = edges_[(i + edges_.size() - 1) % edges_.size()];
    reentrant_.push_back(last.direction_x * next.direction_y - last.direction_y * next.direction_x <
                         0.0);
  }
}

std::optional<ConcavePolygon> ConcavePolygon::from(const FaceInput& input) {
  std::vector<Vec3d> corners = input.local_vertices();
  if (reentrant_corner(corners) == corners.size() || edges_that_meet(corners)) return std::nullopt;
  return ConcavePolygon(std::move(corners));
}

double ConcavePolygon::square_from(const PlaneEdge& edge, double x, double y) const {
  const double held = std::clamp(edge.along(x, y), 0.0, edge.length);
  const double dx = x - edge.start_x - edge.direction_x * held;
  const double dy = y - edge.start_y - edge.direction_y * held;
  return dx * dx + dy * dy;
}

bool ConcavePolygon::covers(double x, double y) const {
  if (x < box_.low_x || x > box_.high_x || y < box_.low_y || y > box_.high_y) return false;
  // How many edges lie to the right of it, those that go up and those that go down.
  int winding = 0;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Vec3d &from = corners_[i], &to = corners_[(i + 1) % corners_.size()];
    if ((from.y <= y) == (to.y <= y)) continue;
    const bool upwards = from.y <= y;
    const double outside = edges_[i].outside(x, y);
    if (upwards ? outside < 0.0 : outside > 0.0) winding += upwards ? 1 : -1;
  }
  return winding != 0;
}

bool ConcavePolygon::within(double x, double y, double slack) const {
  if (covers(x, y)) return true;
  return std::any_of(edges_.begin(), edges_.end(), [&](const PlaneEdge& edge) {
    return square_from(edge, x, y) <= slack * slack;
  });
}

Feature ConcavePolygon::nearest(Vec3d local, double tolerance) const {
  if (local.z >= -tolerance && covers(local.x, local.y)) return {Feature::Kind::face, 0};
  Feature best;
  double least = std::numeric_limits<double>::infinity();
  const auto count = static_cast<std::uint32_t>(edges_.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const PlaneEdge& edge = edges_[i];
    const double square = square_from(edge, local.x, local.y);
    if (square >= least) continue;
    const double s = edge.along(local.x, local.y);
    Feature found{Feature::Kind::edge, i};
    if (s <= 0.0) found = {Feature::Kind::vertex, i};
    if (s >= edge.length) found = {Feature::Kind::vertex, (i + 1) % count};
    // Between insides of edges as near the lower index wins.
    const bool insides = best.kind == Feature::Kind::edge && found.kind == Feature::Kind::edge;
    if (insides && std::sqrt(square) >= std::sqrt(least) - tolerance) continue;
    least = square;
    best = found;
  }
  return best;
}

double ConcavePolygon::distance_to_discontinuity(Vec3d local, double tolerance) const {
  const std::size_t count = edges_.size();
  std::size_t nearest_edge = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const double square = square_from(edges_[i], local.x, local.y);
    if (square < least) least = square, nearest_edge = i;
  }
  const double rim = std::sqrt(least);
  const bool inside = covers(local.x, local.y), before = local.z >= -tolerance;
  // What is nearest to a place of the inside jumps at the plane.
  double bound = std::max(std::fabs(local.z), inside ? 0.0 : rim);
  for (std::size_t k = 0; k < count; ++k) {
    if (k == nearest_edge) continue;
    double lead = 0.5 * (std::sqrt(square_from(edges_[k], local.x, local.y)) - rim);
    // From in front it jumps outside alone.
    if (inside && before) lead = std::max(lead, rim);
    // Two edges that follow each other are as near on one side of their corner alone: on the other
    // side the corner lies between.
    const bool follows = k == (nearest_edge + 1) % count;
    if (!follows && nearest_edge != (k + 1) % count) {
      bound = std::min(bound, lead);
      continue;
    }
    const bool opens_outwards = reentrant_[follows ? k : nearest_edge];
    if (opens_outwards != (inside && !before))
      bound = std::min(bound, lead);
    else if (!before)
      bound = std::min(bound, std::max(lead, rim));
  }
  return bound;
}

namespace {

double twice_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::vector<std::vector<Vec3d>> triangles_of(const std::vector<Vec3d>& corners) {
  std::vector<std::vector<Vec3d>> triangles;
  for (const auto& [a, b, c] : triangulate(corners))
    triangles.push_back({corners[a], corners[b], corners[c]});
  return triangles;
}

}  // namespace

std::vector<std::vector<Vec3d>> ConcavePolygon::pieces() const { return triangles_of(corners_); }

std::vector<std::vector<Vec3d>> ConcavePolygon::gaps() const {
  const auto lowest = std::min_element(corners_.begin(), corners_.end(), [](auto& a, auto& b) {
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  });
  std::vector<Vec3d> round(lowest, corners_.end());
  round.insert(round.end(), corners_.begin(), lowest + 1);
  const double least = 1e-9 * size() * size();
  std::vector<std::vector<Vec3d>> gaps;
  // From a corner of the hull to the next: the one that no other lies to the right of. Corners of
  // the hull follow each other as those of the polygon do.
  for (std::size_t from = 0; from + 1 < round.size();) {
    std::size_t to = from + 1;
    for (std::size_t i = to + 1; i < round.size(); ++i)
      if (twice_area(round[from], round[to], round[i]) < 0.0) to = i;
    if (to > from + 1)
      for (auto& triangle : triangles_of({round.begin() + static_cast<std::ptrdiff_t>(from),
                                          round.begin() + static_cast<std::ptrdiff_t>(to) + 1}))
        if (std::fabs(twice_area(triangle[0], triangle[1], triangle[2])) > least)
          gaps.push_back(std::move(triangle));
    from = to;
  }
  return gaps;
}

namespace {

double square_to(const PlaneEdge& edge, const Vec3d& corner) {
  const double held = std::clamp(edge.along(corner.x, corner.y), 0.0, edge.length);
  const double dx = corner.x - edge.start_x - edge.direction_x * held;
  const double dy = corner.y - edge.start_y - edge.direction_y * held;
  return dx * dx + dy * dy;
}

bool crosses(const PlaneEdge& edge, const Vec3d& a, const Vec3d& b) {
  return (edge.outside(a.x, a.y) > 0.0) != (edge.outside(b.x, b.y) > 0.0);
}

}  // namespace

std::optional<MetEdges> edges_that_meet(std::span<const Vec3d> corners) {
  const std::vector<PlaneEdge> edges = edges_between(corners);
  const std::size_t count = corners.size();
  const double touch = 1e-9 * longest_of(edges), touch2 = touch * touch;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      const Vec3d &a = corners[i], &b = corners[(i + 1) % count];
      const Vec3d &c = corners[j], &d = corners[(j + 1) % count];
      const bool follows = j == i + 1, leads = (j + 1) % count == i;
      const bool met = (!follows && square_to(edges[i], c) <= touch2) ||
                       (!leads && square_to(edges[i], d) <= touch2) ||
                       (!leads && square_to(edges[j], a) <= touch2) ||
                       (!follows && square_to(edges[j], b) <= touch2);
      if (met || (!follows && !leads && crosses(edges[i], c, d) && crosses(edges[j], a, b)))
        return MetEdges{i, j};
    }
  return std::nullopt;
}

}  // namespace portalens
