/// \file
/// `graviton-map` over lanes, for rectangular portals: one look-up a portal.
#pragma once

#include "gravity/graviton_bilinear.h"
#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/first_meeting.h"
#include "lanes/four.h"
#include "lanes/path.h"
#include "lanes/pull.h"
#include "lanes/rectangle.h"
#include "lanes/scene.h"

namespace portalens {

template <class R>
class LaneGravitonMap {
 public:
  using Mask = typename R::Mask;

  explicit LaneGravitonMap(const LaneScene& scene)
      : scene_(scene), acting_(R(1) < R(0)), bound_(acting_) {}

  void decide(Vec3<R> anchor) {
    acting_ = bound_ = R(1) < R(0);
    for (int k = 0; k < scene_.map_count; ++k) {
      const LaneMap& map = scene_.maps[k];
      const Vec3<R> local = local_in(map.face, anchor);
      nearest_[k] = nearest_on(map.face, local);
      const R x = nearest_[k].x(local), y = nearest_[k].y(local);
      const R dx = local.x - x, dy = local.y - y;
      const Mask near = dx * dx + dy * dy + local.z * local.z < R(map.face.reach2);
      acts_[k] = select(near, R(1), R(0));
      acting_ = acting_ | near;
      // A step may run up to the nearest sharp cell; one that begins in a sharp cell ends with it.
      const Cell cell = cell_of(map, Spot(map, x, y));
      const R back = max(cell.to_sharp - R(1), R(0)), on = max(cell.to_sharp, R(1));
      low_x_[k] = R(map.low_x) + (cell.i - back) * R(map.spacing_x);
      high_x_[k] = R(map.low_x) + (cell.i + on) * R(map.spacing_x);
      low_y_[k] = R(map.low_y) + (cell.j - back) * R(map.spacing_y);
      high_y_[k] = R(map.low_y) + (cell.j + on) * R(map.spacing_y);
      nearness_[k] = cell.nearness * acts_[k];
      gradient_[k] = cell.gradient * acts_[k] * nearest_[k].moves();
      bound_ = bound_ | (near & (cell.nearness > R(map.max_nearness)));
    }
  }
  [[nodiscard]] Mask acting() const { return acting_; }

  void add_to(BendingOf<R>& sum, Vec3<R> x, Vec3<R> t) const {
    R slowness[max_lane_portals];
    for (int k = 0; k < scene_.map_count; ++k) {
      const LaneFace& face = scene_.maps[k].face;
      const Vec3<R> way = to_axes(t, face.right, face.up, face.normal);
      slowness[k] = slowness_of(nearest_[k].keep_x * way.x, nearest_[k].keep_y * way.y);
      sum.nearness = sum.nearness + nearness_[k] * slowness[k];
      add_gradient(sum, gradient_[k]);
    }
    const Found found = look_up(x, [&](int k) { return slowness[k]; });
    sum.acceleration += found.acceleration;
    sum.stiffness = sum.stiffness + found.stiffness;
  }

  [[nodiscard]] Vec3<R> acceleration(Vec3<R> x) const {
    return look_up(x, [](int) { return R(1); }).acceleration;
  }

  [[nodiscard]] LaneBorder<R> boundary(Vec3<R> x, Vec3<R> t, Vec3<R> bend, Mask acting, R) const {
    LaneBorder<R> first;
    for (int k = 0; k < scene_.map_count; ++k) {
      const LaneMap& map = scene_.maps[k];
      const Vec3<R> local = local_in(map.face, x);
      const Vec3<R> way = to_axes(t, map.face.right, map.face.up, map.face.normal);
      const Vec3<R> turn = to_axes(bend, map.face.right, map.face.up, map.face.normal);
      LaneBorder<R> own = until_other_nearest(map.face, nearest_[k], (acts_[k] > R(0)) | (!acting_),
                                              local, way, turn);
      const R qx = nearest_[k].x(local), qy = nearest_[k].y(local);
      const R vx = nearest_[k].keep_x * way.x, vy = nearest_[k].keep_y * way.y;
      const Vec3<R> right{R(1), R(0), R(0)}, up{R(0), R(1), R(0)};
      own.offer({until_zero(qx - low_x_[k], vx), qx - low_x_[k], right});
      own.offer({until_zero(qx - high_x_[k], vx), qx - high_x_[k], right});
      own.offer({until_zero(qy - low_y_[k], vy), qy - low_y_[k], up});
      own.offer({until_zero(qy - high_y_[k], vy), qy - high_y_[k], up});
      if (any(!acting))
        own.at = select(acting, own.at, max(own.at, until_ball(R(map.face.ball), local, way)));
      own.normal = to_world(map.face, own.normal);
      first.offer(own);
    }
    return first;
  }

  /// As in `LaneMasses`; and where the cells end that a step may use.
  void find_changes(FirstMeeting<R>& first, Mask which, const LanePath<R>& path, R over) const {
    const LaneLooks<R> looks(path, over);
    const R gap = path.h * R(1.0 / (LaneLooks<R>::count - 1));
    for (int m = 0; m < scene_.map_count; ++m) {
      const LaneFace& face = scene_.maps[m].face;
      const Mask acts = acts_[m] > R(0);
      LaneSpan<R> squares{R(0), R(0)};
      for (int k = 0; k < LaneLooks<R>::count; ++k) {
        const Vec3<R> local = local_in(face, looks.place[k]);
        LaneNearest<R> nearest_point = nearest_[m];
        const Mask other = has_other_nearest(face, nearest_point, local);
        if (any(other & !acts)) nearest_point.take(other & !acts, nearest_on(face, local));
        const R x = nearest_point.x(local), y = nearest_point.y(local);
        const Vec3<R> from{local.x - x, local.y - y, local.z};
        squares = {squares.high, dot(from, from)};
        if (k == 0) continue;
        const LaneSpan<R> span = looks.before(k);
        const Mask still = which & first.open(span);
        if (!any(still)) continue;
        const Mask changed = still & acts & other;
        const Mask leaves_x = (nearest_[m].keep_x > R(0)) & ((x < low_x_[m]) | (x > high_x_[m]));
        const Mask leaves_y = (nearest_[m].keep_y > R(0)) & ((y < low_y_[m]) | (y > high_y_[m]));
        if (any(changed | (still & acts & (leaves_x | leaves_y)))) {
          const auto seen = LocalPath<R>::over(face, path);
          offer_borders(first, face, nearest_[m], changed, seen, span);
          const Mask stays = still & acts & !changed;
          first.offer(stays & leaves_x, seen.x + -select(x < low_x_[m], low_x_[m], high_x_[m]),
                      span);
          first.offer(stays & leaves_y, seen.y + -select(y < low_y_[m], low_y_[m], high_y_[m]),
                      span);
        }
        first.offer_ball(still, acts, sqrt(R(face.reach2)), squares, gap, span, [&] {
          return LaneApart<R, LaneFace, LaneNearest<R>>{face, LocalPath<R>::over(face, path),
                                                        nearest_[m], acts};
        });
      }
    }
  }

  /// As of `LaneMasses`.
  [[nodiscard]] Mask too_near(Vec3<R>) const { return bound_; }

  static constexpr bool sees_borders_far_off = true;
  static constexpr bool foresees_planes = true;

 private:
  /// What a node holds.
  using Four = LaneFour<R>;

  /// A place on a grid, lane by lane, in cells from its corner; `held` within the grid.
  struct alignas(64) Spot {
    float u[R::lanes], v[R::lanes], held_u[R::lanes], held_v[R::lanes];

    Spot(const LaneMap& map, R x, R y) {
      const R across = (x - R(map.low_x)) * R(map.per_x), along = (y - R(map.low_y)) * R(map.per_y);
      across.store(u);
      along.store(v);
      // What is no number is held at the last cell.
      max(min(across, R(map.last_i)), R(0)).store(held_u);
      max(min(along, R(map.last_j)), R(0)).store(held_v);
    }
  };

  struct Cell {
    R i, j, nearness, to_sharp, gradient;
  };
  struct Found {
    Vec3<R> acceleration;
    R stiffness;
  };

  [[nodiscard]] static Cell cell_of(const LaneMap& map, const Spot& spot) {
    alignas(64) float is[R::lanes], js[R::lanes], nearness[R::lanes], to_sharp[R::lanes],
        gradient[R::lanes];
    for (int lane = 0; lane < R::lanes; ++lane) {
      const int i = static_cast<int>(spot.held_u[lane]), j = static_cast<int>(spot.held_v[lane]);
      const float* cell = map.cells + 3 * (j * map.row + i);
      is[lane] = static_cast<float>(i);
      js[lane] = static_cast<float>(j);
      nearness[lane] = cell[0];
      to_sharp[lane] = cell[1];
      gradient[lane] = cell[2];
    }
    return {R::load(is), R::load(js), R::load(nearness), R::load(to_sharp), R::load(gradient)};
  }

  /// The sum over all maps, the stiffness of each times its weight. Lane by lane: what one needs of
  /// a node lies together.
  template <class Weight>
  [[nodiscard]] Found look_up(Vec3<R> x, const Weight& weight) const {
    alignas(64) float acts[R::lanes], weights[R::lanes], out[4][R::lanes] = {};
    for (int k = 0; k < scene_.map_count; ++k) {
      if (!any(acts_[k] > R(0))) continue;
      const LaneMap& map = scene_.maps[k];
      const Vec3<R> local = local_in(map.face, x);
      const Spot spot(map, nearest_[k].x(local), nearest_[k].y(local));
      acts_[k].store(acts);
      weight(k).store(weights);
      for (int lane = 0; lane < R::lanes; ++lane) {
        const int i = static_cast<int>(spot.held_u[lane]), j = static_cast<int>(spot.held_v[lane]);
        const float* low = map.nodes + 4 * (j * map.row + i);
        const float* high = low + 4 * map.row;
        const Four four =
            bilinear(Four::load(low), Four::load(low + 4), Four::load(high), Four::load(high + 4),
                     spot.u[lane] - static_cast<float>(i), spot.v[lane] - static_cast<float>(j)) *
            acts[lane];
        for (int c = 0; c < 3; ++c) out[c][lane] += four.values[c];
        out[3][lane] += four.values[3] * weights[lane];
      }
    }
    return {{R::load(out[0]), R::load(out[1]), R::load(out[2])}, R::load(out[3])};
  }

  const LaneScene& scene_;
  LaneNearest<R> nearest_[max_lane_portals];
  R acts_[max_lane_portals];  ///< 1 within reach, else 0
  R nearness_[max_lane_portals], gradient_[max_lane_portals];
  R low_x_[max_lane_portals], high_x_[max_lane_portals];
  R low_y_[max_lane_portals], high_y_[max_lane_portals];
  Mask acting_, bound_;
};

}  // namespace portalens
