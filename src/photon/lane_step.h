/// \file
/// One step of every lane: the default integrator over packs, with the events it may end in.
#pragma once

#include "photon/lane_coupled.h"
#include "photon/lane_field.h"
#include "photon/lane_graviton_map.h"
#include "photon/lane_scene.h"
#include "photon/lane_shortest_path.h"
#include "photon/nystrom.h"

namespace portalens {

/// The step's path as a cubic in the share u of it, 0 to 1.
template <class R>
struct LaneCubic {
  Vec3<R> c0, c1, c2, c3;
  R h;
  R stray;  ///< how far the curve can be from the straight way along its first direction

  LaneCubic(Vec3<R> x0, Vec3<R> t0, Vec3<R> x1, Vec3<R> t1, R length)
      : c0(x0), c1(t0 * length), h(length) {
    const Vec3<R> d = x1 - x0 - c1, e = (t1 - t0) * length;
    c2 = d * R(3) - e;
    c3 = e - d * R(2);
    stray = sqrt(dot(c2, c2)) + sqrt(dot(c3, c3));
  }
  [[nodiscard]] Vec3<R> position(R u) const { return c0 + (c1 + (c2 + c3 * u) * u) * u; }
  [[nodiscard]] Vec3<R> velocity(R u) const { return c1 + (c2 * R(2) + c3 * (R(3) * u)) * u; }
};

/// The earliest event of a step so far.
template <class R>
struct LaneFinding {
  R share{2.0};  ///< of the step; beyond 1: none
  R event{0}, object{-1};

  void offer(typename R::Mask found, R at, LaneEvent kind, R which) {
    const auto earlier = found & (at < share);
    share = select(earlier, at, share);
    event = select(earlier, R(static_cast<int>(kind)), event);
    object = select(earlier, which, object);
  }
};

/// @tparam F  the field: `LaneField`, or what has its members
template <class R, class F>
class LaneStepper {
 public:
  using Mask = typename R::Mask;
  using V = Vec3<R>;

  LaneStepper(const LaneScene& scene, Lanes& lanes, int first)
      : scene_(scene), lanes_(lanes), first_(first) {}

  void step() {
    const Mask live = read(lanes_.live) > R(0);
    if (!any(live)) return;
    const V x{read(lanes_.x), read(lanes_.y), read(lanes_.z)};
    const V t{read(lanes_.tx), read(lanes_.ty), read(lanes_.tz)};
    F field(scene_);
    field.decide(x + t * R(scene_.ahead));

    const LaneBending<R> start = field.bending(x, t);
    R h = Nystrom::propose(start.stiffness, start.nearness, R(scene_.stiffness_weight),
                           R(scene_.nearness_weight));
    const V bend = turning_part(start.acceleration, t);
    h = min(h, field.boundary(x, t, bend, h) + R(scene_.overshoot));
    h = select(field.acting & live, h, R(1));
    const auto acceleration = [&](V place) { return field.acceleration(place); };
    const StateOf<R> end = Nystrom::step(acceleration, StateOf<R>{x, t}, start.acceleration, h).end;

    const LaneCubic<R> cubic(x, t, end.position, end.direction, h);
    LaneFinding<R> found;
    find_horizons(cubic, found);
    find_portals(cubic, found);
    R doubtful(0);
    find_polygons(cubic, end, found, doubtful);
    find_spheres(cubic, found);
    R clear = read(lanes_.clear) - h;
    find_boxes(cubic, clear, doubtful);

    const Mask flies = live & !field.acting;
    const Mask consults = live & field.acting & (doubtful > R(0));
    const Mask stays = flies | consults | !live;
    const Mask ends = (found.share <= R(1)) & !stays;

    const R u = select(ends, found.share, R(1));
    const V x1 = cubic.position(u);
    const V t1 = normalize(cubic.velocity(u));
    const V turned = end.direction - t;
    const R chord2 = dot(turned, turned);
    const R angle = sqrt(chord2) * (R(1) + chord2 * R(1.0 / 24.0)) * u;

    write(lanes_.x, stays, x.x, select(ends, x1.x, end.position.x));
    write(lanes_.y, stays, x.y, select(ends, x1.y, end.position.y));
    write(lanes_.z, stays, x.z, select(ends, x1.z, end.position.z));
    write(lanes_.tx, stays, t.x, select(ends, t1.x, end.direction.x));
    write(lanes_.ty, stays, t.y, select(ends, t1.y, end.direction.y));
    write(lanes_.tz, stays, t.z, select(ends, t1.z, end.direction.z));
    add(lanes_.length, stays, h * u);
    add(lanes_.turning, stays, angle);
    write(lanes_.clear, stays, read(lanes_.clear), clear);
    write(lanes_.departed, stays, read(lanes_.departed), R(-1));
    add(lanes_.steps, stays, R(1));
    const Mask within = (read(lanes_.length) <= R(scene_.max_length)) &
                        (read(lanes_.turning) <= R(scene_.max_turning)) &
                        (read(lanes_.steps) <= R(scene_.max_steps));
    R event = select(ends, found.event, R(0));
    event = select(live & !within & !ends, R(static_cast<int>(LaneEvent::limit)), event);
    event = select(flies, R(static_cast<int>(LaneEvent::fly)), event);
    event = select(consults, R(static_cast<int>(LaneEvent::consult)), event);
    event.store(lanes_.event + first_);
    found.object.store(lanes_.object + first_);
  }

 private:
  [[nodiscard]] R read(const float* values) const { return R::load(values + first_); }
  void write(float* values, Mask stays, R old, R fresh) const {
    select(stays, old, fresh).store(values + first_);
  }
  void add(float* values, Mask stays, R more) const {
    const R old = read(values);
    select(stays, old, old + more).store(values + first_);
  }

  /// The share of the step at which `height(u)` vanishes, by two steps of Newton's method.
  template <class Height, class Slope>
  [[nodiscard]] static R root(R guess, Height height, Slope slope) {
    R u = guess;
    for (int i = 0; i < 2; ++i) {
      const R better = u - height(u) / slope(u);
      u = select((better >= R(0)) & (better <= R(1)), better, u);
    }
    return u;
  }

  /// False only where the curve stays out of a ball about `-from`, as seen from its start.
  [[nodiscard]] static Mask may_touch(const LaneCubic<R>& cubic, V from, R radius) {
    const R along = -dot(from, cubic.c1);
    const R length2 = dot(cubic.c1, cubic.c1);
    const R share = min(max(along, R(0)), length2) / length2;
    const V nearest = from + cubic.c1 * share;
    const R within = (radius + cubic.stray) * R(1.0001);
    return dot(nearest, nearest) <= within * within;
  }

  void find_horizons(const LaneCubic<R>& cubic, LaneFinding<R>& found) const {
    for (int i = 0; i < scene_.mass_count; ++i) {
      const LaneMass& mass = scene_.masses[i];
      if (mass.horizon < 0.0f) continue;
      const V center = spread<R>(mass.center);
      const auto outside = [&](R u) {
        const V d = cubic.position(u) - center;
        return dot(d, d) - R(mass.horizon2);
      };
      const V from = cubic.c0 - center;
      if (!any(may_touch(cubic, from, R(mass.horizon)))) continue;
      const R approach = dot(from, cubic.c1);
      // The closest approach of the tangent bounds how near the step may come.
      const R closest = min(max(-approach / dot(cubic.c1, cubic.c1), R(0)), R(1));
      const R least = min(outside(closest), outside(R(1)));
      if (!any((least <= R(0)) & (approach < R(0)))) continue;
      const R inside = select(outside(closest) <= R(0), closest, R(1));
      R low(0), high = inside;
      for (int k = 0; k < 20; ++k) {
        const R middle = (low + high) * R(0.5);
        const auto out = outside(middle) > R(0);
        low = select(out, middle, low);
        high = select(out, high, middle);
      }
      found.offer((least <= R(0)) & (approach < R(0)), high, LaneEvent::horizon, R(i));
    }
  }

  void find_portals(const LaneCubic<R>& cubic, LaneFinding<R>& found) const {
    for (int p = 0; p < scene_.portal_count; ++p) {
      const LanePortal& portal = scene_.portals[p];
      const V normal = spread<R>(portal.normal), origin = spread<R>(portal.origin);
      const R z0 = dot(cubic.c0 - origin, normal);
      const R z1 = dot(cubic.position(R(1)) - origin, normal);
      Mask crosses = (z0 >= R(-portal.tolerance)) & (z1 < R(0)) & (z1 < z0);
      if (portal.back > 0.0f) crosses = crosses | ((z0 < R(0)) & (z1 >= R(0)));
      if (!any(crosses)) continue;
      const R u = root(
          max(z0, R(0)) / select(crosses, z0 - z1, R(1)),
          [&](R at) { return dot(cubic.position(at) - origin, normal); },
          [&](R at) { return dot(cubic.velocity(at), normal); });
      const V d = cubic.position(u) - origin;
      const auto within = (abs(dot(d, spread<R>(portal.right))) <= R(portal.half_width)) &
                          (abs(dot(d, spread<R>(portal.up))) <= R(portal.half_height));
      found.offer(crosses & within, u, LaneEvent::portal, R(p));
    }
  }

  void find_polygons(const LaneCubic<R>& cubic, const StateOf<R>& end, LaneFinding<R>& found,
                     R& doubtful) const {
    const R departed = read(lanes_.departed), side = read(lanes_.departed_side);
    const V turned = end.direction * cubic.h - cubic.c1;
    const R sagitta = sqrt(dot(turned, turned)) * R(0.25);
    for (int p = 0; p < scene_.polygon_count; ++p) {
      const LanePolygon& polygon = scene_.polygons[p];
      const V normal = spread<R>(polygon.normal);
      const R leaving = select(departed == R(polygon.shape), R(1), R(0));
      R z0 = dot(cubic.c0, normal) - R(polygon.distance);
      z0 = select(leaving > R(0), side * R(1e-20), z0);
      const R z1 = dot(end.position, normal) - R(polygon.distance);
      const Mask crosses = ((z0 > R(0)) & (z1 <= R(0))) | ((z0 <= R(0)) & (z1 > R(0)));
      const R s0 = dot(cubic.c1, normal), s1 = dot(end.direction, normal);
      // Both ends on one side, first towards the plane, then away: it may dip through between.
      const Mask dips =
          (!crosses) & (z0 * s0 < R(0)) & (z1 * s1 > R(0)) & (min(abs(z0), abs(z1)) < sagitta);
      if (!any((crosses | dips) &
               may_touch(cubic, cubic.c0 - spread<R>(polygon.middle), R(polygon.radius))))
        continue;
      const R u = root(
          z0 / select(crosses, z0 - z1, R(1)),
          [&](R at) { return dot(cubic.position(at), normal) - R(polygon.distance); },
          [&](R at) { return dot(cubic.velocity(at), normal); });
      const V at = cubic.position(select(crosses, u, R(0.5)));
      Mask within = crosses | dips;
      const R slack = select(dips, cubic.h, R(0));
      for (int k = 0; k < 4; ++k)
        within =
            within &
            (dot(at, spread<R>(polygon.edge_normal[k])) - R(polygon.edge_distance[k]) >= -slack);
      found.offer(crosses & within, u, LaneEvent::hit, R(polygon.shape));
      doubtful = select(dips & within, R(1), doubtful);
    }
  }

  void find_spheres(const LaneCubic<R>& cubic, LaneFinding<R>& found) const {
    const R departed = read(lanes_.departed), side = read(lanes_.departed_side);
    for (int i = 0; i < scene_.sphere_count; ++i) {
      const LaneSphere& sphere = scene_.spheres[i];
      const V center = spread<R>(sphere.center);
      const V from = cubic.c0 - center;
      if (!any(may_touch(cubic, from, R(sphere.radius)))) continue;
      const R r2(sphere.radius * sphere.radius);
      const auto outside = [&](R u) {
        const V d = cubic.position(u) - center;
        return dot(d, d) - r2;
      };
      const auto slope = [&](R u) {
        return R(2) * dot(cubic.position(u) - center, cubic.velocity(u));
      };
      const Mask leaving = departed == R(sphere.shape);
      R f0 = outside(R(0));
      f0 = select(leaving, side * R(1e-20), f0);
      const R f1 = outside(R(1));
      // From outside the nearest point of the step decides.
      R nearest = -dot(from, cubic.c1) / dot(cubic.c1, cubic.c1);
      nearest = min(max(nearest, R(0)), R(1));
      const V there = cubic.position(nearest) - center;
      const R better = nearest - dot(there, cubic.velocity(nearest)) / dot(cubic.c1, cubic.c1);
      nearest = min(max(better, R(0)), R(1));
      const Mask enters = (f0 > R(0)) & ((f1 <= R(0)) | (outside(nearest) <= R(0))) &
                          !(leaving & (nearest <= R(0)));
      const Mask exits = (f0 <= R(0)) & (f1 > R(0));
      if (!any(enters | exits)) continue;
      R low(0), high = select(exits | (f1 <= R(0)), R(1), nearest);
      const R sign = select(enters, R(1), R(-1));
      for (int k = 0; k < 6; ++k) {
        const R middle = (low + high) * R(0.5);
        const auto before = outside(middle) * sign > R(0);
        low = select(before, middle, low);
        high = select(before, high, middle);
      }
      const R u = root((low + high) * R(0.5), outside, slope);
      found.offer(enters | exits, u, LaneEvent::hit, R(sphere.shape));
    }
  }

  void find_boxes(const LaneCubic<R>& cubic, R clear, R& doubtful) const {
    if (scene_.box_count == 0) return;
    const Mask needed = clear < R(0);
    if (!any(needed)) return;
    const V end = cubic.position(R(1));
    const V turned = cubic.velocity(R(1)) - cubic.c1;
    const R slack = sqrt(dot(turned, turned)) * R(0.25);
    for (int i = 0; i < scene_.box_count; ++i) {
      const LaneBox& box = scene_.boxes[i];
      const Mask overlaps = (max(cubic.c0.x, end.x) + slack >= R(box.low.x)) &
                            (min(cubic.c0.x, end.x) - slack <= R(box.high.x)) &
                            (max(cubic.c0.y, end.y) + slack >= R(box.low.y)) &
                            (min(cubic.c0.y, end.y) - slack <= R(box.high.y)) &
                            (max(cubic.c0.z, end.z) + slack >= R(box.low.z)) &
                            (min(cubic.c0.z, end.z) - slack <= R(box.high.z));
      doubtful = select(needed & overlaps, R(1), doubtful);
    }
  }

  const LaneScene& scene_;
  Lanes& lanes_;
  int first_;
};

template <class R, class F>
void step_lanes_in(const LaneScene& scene, Lanes& lanes) {
  for (int first = 0; first < lane_count; first += R::lanes)
    LaneStepper<R, F>(scene, lanes, first).step();
}

template <class R>
void step_lanes(const LaneScene& scene, Lanes& lanes) {
  if (scene.map_count > 0)
    step_lanes_in<R, LaneCoupled<R, LaneGravitonMap<R>>>(scene, lanes);
  else if (scene.way_count > 0)
    step_lanes_in<R, LaneCoupled<R, LaneShortestPath<R>>>(scene, lanes);
  else
    step_lanes_in<R, LaneField<R>>(scene, lanes);
}

}  // namespace portalens
