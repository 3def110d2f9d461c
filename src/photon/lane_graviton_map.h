/// \file
/// `graviton-map` over lanes, for rectangular portals: one look-up a portal.
#pragma once

#include "gravity/graviton_bilinear.h"
#include "photon/lane_field.h"
#include "photon/lane_rectangle.h"

namespace portalens {

template <class R>
class LaneGravitonMap {
 public:
  using Mask = typename R::Mask;

  explicit LaneGravitonMap(const LaneScene& scene) : scene_(scene), acting_(R(1) < R(0)) {}

  void decide(Vec3<R> anchor) {
    acting_ = R(1) < R(0);
    for (int k = 0; k < scene_.map_count; ++k) {
      const LaneMap& map = scene_.maps[k];
      const Vec3<R> local = local_in(map.face, anchor);
      feet_[k] = foot_on(map.face, local);
      const R x = feet_[k].x(local), y = feet_[k].y(local);
      const R dx = local.x - x, dy = local.y - y;
      const Mask near = dx * dx + dy * dy + local.z * local.z < R(map.face.reach2);
      acts_[k] = select(near, R(1), R(0));
      acting_ = acting_ | near;
      const Cell cell = cell_at(map, x, y);
      // Steps may run to the nearest cell where they must end; one of those they don't leave.
      const R apart = R::gather(map.nodes + 5, cell.at);
      const R back = max(apart - R(1), R(0)), on = max(apart, R(1));
      low_x_[k] = R(map.low_x) + (cell.i - back) * R(map.spacing_x);
      high_x_[k] = R(map.low_x) + (cell.i + on) * R(map.spacing_x);
      low_y_[k] = R(map.low_y) + (cell.j - back) * R(map.spacing_y);
      high_y_[k] = R(map.low_y) + (cell.j + on) * R(map.spacing_y);
    }
  }
  [[nodiscard]] Mask acting() const { return acting_; }

  void add_to(LaneBending<R>& sum, Vec3<R> x) const {
    for (int k = 0; k < scene_.map_count; ++k) {
      const Found found = look_up(k, x);
      const float* nodes = scene_.maps[k].nodes;
      sum.acceleration += found.acceleration;
      sum.stiffness = sum.stiffness + R::gather(nodes + 3, found.cell.at) * acts_[k];
      sum.nearness = sum.nearness + R::gather(nodes + 4, found.cell.at) * acts_[k];
    }
  }

  [[nodiscard]] Vec3<R> acceleration(Vec3<R> x) const {
    Vec3<R> sum{R(0), R(0), R(0)};
    for (int k = 0; k < scene_.map_count; ++k) sum += look_up(k, x).acceleration;
    return sum;
  }

  [[nodiscard]] R boundary(Vec3<R> x, Vec3<R> t, Vec3<R>, R) const {
    const R never(scene_.farthest);
    R least = never;
    for (int k = 0; k < scene_.map_count; ++k) {
      const LaneMap& map = scene_.maps[k];
      const Vec3<R> local = local_in(map.face, x);
      const Vec3<R> way = to_axes(t, map.face.right, map.face.up, map.face.normal);
      least = min(least, until_other_foot(map.face, feet_[k], local, way, never));
      const R qx = feet_[k].x(local), qy = feet_[k].y(local);
      const R vx = feet_[k].keep_x * way.x, vy = feet_[k].keep_y * way.y;
      least = min(least, until_zero(qx - low_x_[k], vx, never));
      least = min(least, until_zero(qx - high_x_[k], vx, never));
      least = min(least, until_zero(qy - low_y_[k], vy, never));
      least = min(least, until_zero(qy - high_y_[k], vy, never));
    }
    return least;
  }

 private:
  /// The cell's lower left node: its numbers, and its place in the table.
  struct Cell {
    R i, j;
    typename R::Index at;
  };
  struct Found {
    Cell cell;
    Vec3<R> acceleration;
  };

  [[nodiscard]] static Cell cell_at(const LaneMap& map, R x, R y) {
    // What is no number ends up in the last cell.
    const R u = (x - R(map.low_x)) * R(map.per_x), v = (y - R(map.low_y)) * R(map.per_y);
    const auto i = whole(max(min(u, R(map.last_i)), R(0)));
    const auto j = whole(max(min(v, R(map.last_j)), R(0)));
    return {real(i), real(j), (j * map.row + i) * lane_map_stride};
  }

  [[nodiscard]] static Vec3<R> node(const float* nodes, typename R::Index at) {
    return {R::gather(nodes, at), R::gather(nodes + 1, at), R::gather(nodes + 2, at)};
  }

  [[nodiscard]] Found look_up(int k, Vec3<R> x) const {
    const LaneMap& map = scene_.maps[k];
    const Vec3<R> local = local_in(map.face, x);
    const R qx = feet_[k].x(local), qy = feet_[k].y(local);
    const Cell cell = cell_at(map, qx, qy);
    const R u = (qx - R(map.low_x)) * R(map.per_x) - cell.i;
    const R v = (qy - R(map.low_y)) * R(map.per_y) - cell.j;
    const float* above = map.nodes + lane_map_stride * map.row;
    return {cell, bilinear(node(map.nodes, cell.at), node(map.nodes + lane_map_stride, cell.at),
                           node(above, cell.at), node(above + lane_map_stride, cell.at), u, v) *
                      acts_[k]};
  }

  const LaneScene& scene_;
  LaneFoot<R> feet_[most_lane_portals];
  R acts_[most_lane_portals];  ///< 1 within reach, else 0
  R low_x_[most_lane_portals], high_x_[most_lane_portals];
  R low_y_[most_lane_portals], high_y_[most_lane_portals];
  Mask acting_;
};

}  // namespace portalens
