/// \file
/// `graviton-map` over lanes: one look-up a portal.
#pragma once

#include "gravity/graviton_bilinear.h"
#include "lanes/any_face.h"
#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/first_meeting.h"
#include "lanes/four.h"
#include "lanes/gate_decisions.h"
#include "lanes/path.h"
#include "lanes/pull.h"
#include "lanes/rectangle.h"
#include "lanes/scene.h"

namespace portalens {

/// @tparam Nearest  the nearest feature of a portal: `LaneNearest`, of a rectangle, or
///                  `LaneAnyNearest`
template <class R, class Nearest>
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
      nearest_[k] = Nearest::on(map.face, local);
      const Vec3<R> q = nearest_[k].place(local), from = local - q;
      const Mask near = from.x * from.x + from.y * from.y + local.z * local.z < R(map.face.reach2);
      acts_[k] = select(near, R(1), R(0));
      acting_ = acting_ | near;
      // A step may run up to the nearest sharp cell; one that begins in a sharp cell ends with it.
      const Cell cell = cell_of(map, Spot(map, q));
      const R back = max(cell.to_sharp - R(1), R(0)), on = max(cell.to_sharp, R(1));
      low_x_[k] = R(map.low_x) + (cell.i - back) * R(map.spacing_x);
      high_x_[k] = R(map.low_x) + (cell.i + on) * R(map.spacing_x);
      low_y_[k] = R(map.low_y) + (cell.j - back) * R(map.spacing_y);
      high_y_[k] = R(map.low_y) + (cell.j + on) * R(map.spacing_y);
      nearness_[k] = cell.nearness * acts_[k];
      gradient_[k] = cell.gradient * acts_[k] * nearest_[k].moves();
      bound_ = bound_ | (near & (cell.nearness > R(map.max_nearness)));
      if constexpr (!LeadsOn<Nearest, R>) bound_ = bound_ | (near & runs_round(nearest_[k]));
    }
  }
  [[nodiscard]] Mask acting() const { return acting_; }

  void add_to(BendingOf<R>& sum, Vec3<R> x, Vec3<R> t) const {
    R slowness[max_lane_portals];
    for (int k = 0; k < scene_.map_count; ++k) {
      const LaneFace& face = scene_.maps[k].face;
      const Vec3<R> way = to_axes(t, face.right, face.up, face.normal);
      slowness[k] = slowness_of(nearest_[k].speed_x(way), nearest_[k].speed_y(way));
      sum.nearness = sum.nearness + nearness_[k] * slowness[k];
      if constexpr (!LeadsOn<Nearest, R>)
        sum.stiffness = multiply_add(gradient_[k] * nearest_[k].swings(),
                                     R(swing_weight * distant_weight) * slowness_of(way.x, way.y),
                                     sum.stiffness);
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
      const Vec3<R> q = nearest_[k].place(local);
      const R vx = nearest_[k].speed_x(way), vy = nearest_[k].speed_y(way);
      const Vec3<R> right{R(1), R(0), R(0)}, up{R(0), R(1), R(0)};
      own.offer({until_zero(q.x - low_x_[k], vx), q.x - low_x_[k], right});
      own.offer({until_zero(q.x - high_x_[k], vx), q.x - high_x_[k], right});
      own.offer({until_zero(q.y - low_y_[k], vy), q.y - low_y_[k], up});
      own.offer({until_zero(q.y - high_y_[k], vy), q.y - high_y_[k], up});
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
      Vec3<R> start;
      for (int k = 0; k < LaneLooks<R>::count; ++k) {
        const Vec3<R> local = local_in(face, looks.place[k]);
        Nearest nearest_point = nearest_[m];
        const Mask other = has_other_nearest(face, nearest_point, local);
        if (any(other & !acts)) nearest_point.take(other & !acts, Nearest::on(face, local));
        const Vec3<R> q = nearest_point.place(local), from = local - q;
        squares = {squares.high, dot(from, from)};
        if (k == 0) start = q;
        if (k == 0) continue;
        const LaneSpan<R> span = looks.before(k);
        const Mask still = which & first.open(span);
        if (!any(still)) continue;
        const Mask changed = still & acts & other;
        // What does not move stays in its cell, whatever rounding says.
        const Mask leaves_x = (!(q.x == start.x)) & ((q.x < low_x_[m]) | (q.x > high_x_[m]));
        const Mask leaves_y = (!(q.y == start.y)) & ((q.y < low_y_[m]) | (q.y > high_y_[m]));
        if (any(changed | (still & acts & (leaves_x | leaves_y)))) {
          const auto seen = LocalPath<R>::over(face, path);
          offer_borders(first, face, nearest_[m], changed, seen, span);
          const Mask stays = still & acts & !changed;
          const R line_x = select(q.x < low_x_[m], low_x_[m], high_x_[m]);
          const R line_y = select(q.y < low_y_[m], low_y_[m], high_y_[m]);
          if constexpr (LeadsOn<Nearest, R>) {
            const LocalPath<R> led = nearest_[m].led_by(seen);
            first.offer(stays & leaves_x, led.x + -line_x, span);
            first.offer(stays & leaves_y, led.y + -line_y, span);
          } else {
            const LaneLed<R> led{nearest_[m], seen};
            first.offer(stays & leaves_x, led.beyond(R(1), R(0), line_x), span);
            first.offer(stays & leaves_y, led.beyond(R(0), R(1), line_y), span);
          }
        }
        first.offer_ball(still, acts, sqrt(R(face.reach2)), squares, gap, span, [&] {
          return LaneApart<R, LaneFace, Nearest>{face, LocalPath<R>::over(face, path), nearest_[m],
                                                 acts};
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

    Spot(const LaneMap& map, Vec3<R> q) {
      const R across = (q.x - R(map.low_x)) * R(map.per_x);
      const R along = (q.y - R(map.low_y)) * R(map.per_y);
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
      const Spot spot(map, nearest_[k].place(local));
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
  Nearest nearest_[max_lane_portals];
  R acts_[max_lane_portals];  ///< 1 within reach, else 0
  R nearness_[max_lane_portals], gradient_[max_lane_portals];
  R low_x_[max_lane_portals], high_x_[max_lane_portals];
  R low_y_[max_lane_portals], high_y_[max_lane_portals];
  Mask acting_, bound_;
};

}  // namespace portalens
