#include "shading/occlusion_pretest.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace portalens {
namespace {

/// More than so many surfaces, portals and horizons are left to `visible`.
constexpr std::size_t max_obstacles = 32;

/// What is computed here or by `visible` is off by less than this share of the coordinates.
constexpr double rounding_share = 1e-12;

/// `visible` doesn't look at a millionth of the path before the light; here it is half of that.
constexpr double before_light = 0.5e-6;

/// Stands for a shape, where an obstacle is neither one nor a portal.
constexpr std::uint32_t no_surface = no_object - 1;

double size(Vec3d x) { return std::fabs(x.x) + std::fabs(x.y) + std::fabs(x.z); }

Vec3d absolute(Vec3d x) { return {std::fabs(x.x), std::fabs(x.y), std::fabs(x.z)}; }

}  // namespace

/// A straight path, prepared; or many that stay about it.
struct OcclusionPretest::Way {
  Vec3d from, to, whole;
  double slack;  ///< how far beside it things must lie
  SelfIntersectionGuard guard{};
  LeftPlane left;

  Way(const ShadowQuery& query, const FlushFaces* flush)
      : from(query.from),
        to(query.to - (query.to - query.from) * before_light),
        whole(to - from),
        slack(rounding_share * (size(from) + size(to))),
        guard(query.guard),
        left(flush ? flush->left_by(guard) : LeftPlane{}) {}

  /// From the middle of the box that all come from to that of the one where they go.
  Way(const Box& begin, const Box& end)
      : from(begin.middle()), to(end.middle()), whole(to - from), slack(0.0) {
    const Vec3d aside = begin.high - begin.low, there = end.high - end.low;
    const double spread = 0.5 * std::max(length(aside), length(there));
    slack = spread + 2.0 * rounding_share * (size(from) + size(aside) + size(to) + size(there));
  }
};

OcclusionPretest::OcclusionPretest(const Space& space) {
  const std::vector<Shape>& shapes = space.surfaces.shapes();
  if (shapes.size() + space.portals.portals().size() + space.masses.size() > max_obstacles) return;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    if (const auto* quad = std::get_if<Quad>(&shapes[i])) {
      add_plane(quad->vertices(), quad->normal(), i);
    } else if (const auto* sphere = std::get_if<Sphere>(&shapes[i])) {
      add_ball(sphere->center(), sphere->radius(), i);
    } else {
      const Box box = std::visit([](const auto& shape) { return shape.bounds(); }, shapes[i]);
      if (box.empty()) continue;
      const Vec3d half = (box.high - box.low) * 0.5;
      blocks_.push_back(
          {box.middle(), half, rounding_share * (size(box.middle()) + size(half)), i});
    }
  }
  for (std::uint32_t i = 0; i < space.portals.portals().size(); ++i) {
    const Portal& portal = space.portals.portals()[i];
    add_plane(portal.vertices, portal.frame.normal, static_cast<std::uint32_t>(shapes.size()) + i);
  }
  const FlushFaces& flush = space.surfaces.flush();
  if (flush.any_shapes()) {
    flush_ = &flush;
    for (Plane& plane : planes_)
      if (const auto* place = flush.find(plane.block.shape, 0)) {
        plane.plane = place->plane;
        plane.side = place->side;
        plane.thickness = flush.plane(place->plane).thickness;
      }
  }
  for (const Mass& mass : space.masses)
    if (mass.horizon) add_ball(mass.center, mass.horizon_radius, no_surface);
  complete_ = true;
}

template <class Vertices>
void OcclusionPretest::add_plane(const Vertices& vertices, Vec3d normal, std::uint32_t shape) {
  Plane plane;
  plane.normal = normal;
  plane.offset = dot(normal, vertices[0]);
  Box box;
  double uneven = 0.0;
  for (const Vec3d& vertex : vertices) {
    box.add(vertex);
    uneven = std::max(uneven, std::fabs(dot(normal, vertex) - plane.offset));
  }
  const Vec3d half = (box.high - box.low) * 0.5;
  const double extent = size(box.middle()) + size(half);
  plane.block = {box.middle(), half, rounding_share * extent + 2.0 * uneven, shape};
  // Half of what the accelerator lets count as left behind.
  plane.rounding = 0.5 * (1e-15 * size(box.middle()) + 1e-14 * box.diagonal());
  planes_.push_back(plane);
}

void OcclusionPretest::add_ball(Vec3d center, double radius, std::uint32_t shape) {
  balls_.push_back({center, radius, rounding_share * (size(center) + radius), shape});
}

/// Both ends lie on one side, or the path begins on the polygon and leaves it, or passes its box.
bool OcclusionPretest::misses(const Way& way, const Plane& plane) {
  const double begin = dot(plane.normal, way.from) - plane.offset;
  const double end = dot(plane.normal, way.to) - plane.offset;
  const double margin = plane.block.slack + way.slack;
  if (std::min(begin, end) > margin || std::max(begin, end) < -margin) return true;
  if (std::fabs(end) > margin && has_left(plane, begin, end, way.guard, way.left)) return true;
  return misses(way, plane.block);
}

bool OcclusionPretest::has_left(const Plane& plane, double begin, double end,
                                const SelfIntersectionGuard& guard, const LeftPlane& left) {
  if (plane.block.shape == guard.shape)
    return guard.side * end > 0.0 && std::fabs(begin) <= plane.rounding;
  return left.plane != LeftPlane::none && left.plane == plane.plane &&
         left.side * plane.side * end > 0.0 && std::fabs(begin) <= plane.thickness;
}

/// The path's point nearest to the centre lies outside; or it begins on the ball and leaves it,
/// less than grazing.
bool OcclusionPretest::misses(const Way& way, const Ball& ball) {
  const Vec3d to_center = ball.center - way.from;
  const double onwards = dot(to_center, way.whole);
  const double whole_square = dot(way.whole, way.whole);
  const double along = std::clamp(onwards / whole_square, 0.0, 1.0);
  const Vec3d nearest = to_center - way.whole * along;
  const double reach = ball.radius + ball.slack + way.slack;
  if (dot(nearest, nearest) > reach * reach) return true;
  if (ball.shape != way.guard.shape || !(way.guard.side > 0.0)) return false;
  constexpr double steep = 1e-3, on = 1e-9;
  const double square = ball.radius * ball.radius, away = dot(to_center, to_center);
  return onwards < 0.0 && onwards * onwards > steep * steep * away * whole_square &&
         std::fabs(away - square) <= on * square && way.guard.reach >= 1e-6 * ball.radius;
}

/// An axis at right angles to a face or to an edge and the path tells them apart (Gottschalk, Lin &
/// Manocha, "OBBTree", 1996).
bool OcclusionPretest::misses(const Way& way, const Block& block) {
  const double slack = block.slack + way.slack;
  const Vec3d b = block.half + Vec3d{slack, slack, slack};
  const Vec3d m = (way.from + way.to) * 0.5 - block.middle;
  const Vec3d h = (way.to - way.from) * 0.5, s = absolute(h);
  if (std::fabs(m.x) > b.x + s.x || std::fabs(m.y) > b.y + s.y || std::fabs(m.z) > b.z + s.z)
    return true;
  return std::fabs(m.y * h.z - m.z * h.y) > b.y * s.z + b.z * s.y ||
         std::fabs(m.z * h.x - m.x * h.z) > b.z * s.x + b.x * s.z ||
         std::fabs(m.x * h.y - m.y * h.x) > b.x * s.y + b.y * s.x;
}

/// Whether all begin on the polygon and leave it to the side on which they end.
bool OcclusionPretest::is_left(const Plane& plane, const Way& way,
                               std::span<const ShadowQuery> queries) const {
  const double end = dot(plane.normal, way.to) - plane.offset;
  if (!(std::fabs(end) > plane.block.slack + way.slack)) return false;
  return std::all_of(queries.begin(), queries.end(), [&](const ShadowQuery& query) {
    return query.portal != no_portal ||
           has_left(plane, dot(plane.normal, query.from) - plane.offset, end, query.guard,
                    flush_ ? flush_->left_by(query.guard) : LeftPlane{});
  });
}

void OcclusionPretest::narrow(const OcclusionPretest& whole, std::span<const ShadowQuery> queries) {
  Box begin, end;
  for (const ShadowQuery& query : queries) {
    if (query.portal != no_portal) continue;
    begin.add(query.from);
    end.add(query.to);
  }
  const Way way(begin, end);
  const auto take_near = [](const auto& all, auto& near, const auto& far) {
    near.clear();
    std::remove_copy_if(all.begin(), all.end(), std::back_inserter(near), far);
  };
  const auto missed = [&](const auto& obstacle) { return misses(way, obstacle); };
  complete_ = whole.complete_;
  flush_ = whole.flush_;
  take_near(whole.planes_, planes_,
            [&](const Plane& plane) { return misses(way, plane) || is_left(plane, way, queries); });
  take_near(whole.balls_, balls_, missed);
  take_near(whole.blocks_, blocks_, missed);
}

bool OcclusionPretest::surely_free(const ShadowQuery& query) const {
  if (!complete_ || query.portal != no_portal) return false;
  if (planes_.empty() && balls_.empty() && blocks_.empty()) return true;
  const Way way(query, flush_);
  const auto missed = [&](const auto& obstacle) { return misses(way, obstacle); };
  return std::all_of(planes_.begin(), planes_.end(), missed) &&
         std::all_of(balls_.begin(), balls_.end(), missed) &&
         std::all_of(blocks_.begin(), blocks_.end(), missed);
}

}  // namespace portalens
