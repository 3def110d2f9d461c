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

/// Bounds the length of a vector from above, to within a factor of √3.
template <class R>
R span(Vec3<R> v) {
  return abs(v.x) + abs(v.y) + abs(v.z);
}

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
    stray = span(c2) + span(c3);
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
    field.decide(x, t);

    const LaneBending<R> start = field.bending(x, t);
    const V bend = turning_part(start.acceleration, t);
    const Mask flies = !field.acting;
    const R most = longest(x, start, flies);
    const R border = field.boundary(x, t, bend, most);
    const R h = min(most, border + R(scene_.overshoot));
    const auto acceleration = [&](V place) { return field.acceleration(place); };
    const StateOf<R> end = Nystrom::step(acceleration, StateOf<R>{x, t}, start.acceleration, h).end;

    const LaneCubic<R> cubic(x, t, end.position, end.direction, h);
    LaneFinding<R> found;
    R doubtful = select(
        flies & (span(x) > R(F::sees_borders_far_off ? scene_.flight_limit : -1.0f)), R(1), R(0));
    find_horizons(cubic, field, found);
    find_portals(cubic, found);
    find_polygons(cubic, end, found, doubtful);
    find_spheres(cubic, found);
    const R clear = read(lanes_.clear) - h;
    find_boxes(cubic, clear, doubtful);

    const Mask consults = live & (doubtful > R(0));
    const Mask ends = (found.share <= R(1)) & live & !consults;
    const Mask escapes = live & flies & (border >= R(never)) & !(found.share <= R(1)) & !consults;
    const Mask stays = consults | escapes | !live;

    V x1 = end.position, t1 = end.direction;
    const V turned = end.direction - t;
    const R chord2 = dot(turned, turned);
    R length = h, angle = sqrt(chord2) * (R(1) + chord2 * R(1.0 / 24.0));
    if (any(ends)) {
      const R u = select(ends, found.share, R(1));
      length = length * u;
      angle = angle * u;
      x1 = choose(ends, cubic.position(u), x1);
      t1 = choose(ends, normalize(cubic.velocity(u)), t1);
    }
    write(lanes_.x, stays, x.x, x1.x);
    write(lanes_.y, stays, x.y, x1.y);
    write(lanes_.z, stays, x.z, x1.z);
    write(lanes_.tx, stays, t.x, t1.x);
    write(lanes_.ty, stays, t.y, t1.y);
    write(lanes_.tz, stays, t.z, t1.z);
    const R path = add(lanes_.length, stays, length);
    const R turning = add(lanes_.turning, stays, angle);
    const R steps = add(lanes_.steps, stays, R(1));
    write(lanes_.clear, stays, read(lanes_.clear), clear);
    write(lanes_.departed, stays, read(lanes_.departed), R(-1));
    const Mask within = (path <= R(scene_.max_length)) & (turning <= R(scene_.max_turning)) &
                        (steps <= R(scene_.max_steps));
    R event = select(live & !within, code(LaneEvent::limit), R(0));
    event = select(ends, found.event, event);
    event = select(escapes, code(LaneEvent::escape), event);
    event = select(consults, code(LaneEvent::consult), event);
    event.store(lanes_.event + first_);
    found.object.store(lanes_.object + first_);
  }

 private:
  [[nodiscard]] R read(const float* values) const { return R::load(values + first_); }
  void write(float* values, Mask stays, R old, R fresh) const {
    select(stays, old, fresh).store(values + first_);
  }
  [[nodiscard]] R add(float* values, Mask stays, R more) const {
    const R old = read(values);
    const R sum = select(stays, old, old + more);
    sum.store(values + first_);
    return sum;
  }
  [[nodiscard]] static R code(LaneEvent event) { return R(static_cast<int>(event)); }
  [[nodiscard]] static V choose(Mask which, V a, V b) {
    return {select(which, a.x, b.x), select(which, a.y, b.y), select(which, a.z, b.z)};
  }

  /// How long a step may be before borders cut it: what the field allows, or, where nothing acts,
  /// out of the scene.
  [[nodiscard]] R longest(V x, const LaneBending<R>& start, Mask flies) const {
    const R proposed = Nystrom::propose(start.stiffness, start.nearness, R(scene_.stiffness_weight),
                                        R(scene_.nearness_weight));
    return select(flies, span(x) + R(scene_.radius), min(proposed, R(scene_.farthest)));
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

  /// The same where `height(u) * before` is positive at first and negative at last, however flat it
  /// is between: Newton's method, kept within what is left of the step.
  template <class Height, class Slope>
  [[nodiscard]] static R crossing(R guess, R before, Height height, Slope slope) {
    R u = guess, low(0), high(1);
    for (int i = 0; i < 5; ++i) {
      const R at = height(u);
      const Mask early = at * before > R(0);
      low = select(early, u, low);
      high = select(early, high, u);
      const R better = u - at / slope(u);
      u = select((better >= low) & (better <= high), better, (low + high) * R(0.5));
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

  void find_horizons(const LaneCubic<R>& cubic, const F& field, LaneFinding<R>& found) const {
    for (int i = 0; i < scene_.mass_count; ++i) {
      const LaneMass& mass = scene_.masses[i];
      if (mass.horizon < 0.0f) continue;
      const R reach = cubic.h + R(mass.horizon);
      if (!any(field.distance2(i) < reach * reach)) continue;
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
      const R u = crossing(
          max(z0, R(0)) / select(crosses, z0 - z1, R(1)), select(z1 < R(0), R(1), R(-1)),
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
    const bool leaves = any(departed >= R(0));
    const R sagitta = span(end.direction * cubic.h - cubic.c1) * R(0.25);
    for (int p = 0; p < scene_.polygon_count; ++p) {
      const LanePolygon& polygon = scene_.polygons[p];
      const V normal = spread<R>(polygon.normal);
      R z0 = dot(cubic.c0, normal) - R(polygon.distance);
      const R z1 = dot(end.position, normal) - R(polygon.distance);
      if (leaves) z0 = select(departed == R(polygon.shape), side * R(1e-20), z0);
      const Mask crosses = ((z0 > R(0)) & (z1 <= R(0))) | ((z0 <= R(0)) & (z1 > R(0)));
      const Mask near = min(abs(z0), abs(z1)) < sagitta;
      if (!any(crosses | near)) continue;
      // Both ends on one side, first towards the plane, then away: it may dip through between.
      const R s0 = dot(cubic.c1, normal), s1 = dot(end.direction, normal);
      const Mask dips = near & !crosses & (z0 * s0 < R(0)) & (z1 * s1 > R(0));
      if (!any((crosses | dips) &
               may_touch(cubic, cubic.c0 - spread<R>(polygon.middle), R(polygon.radius))))
        continue;
      const R u = crossing(
          z0 / select(crosses, z0 - z1, R(1)), z0,
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
    // The share of the chord that lies between the planes of each pair; the curve strays from it.
    const V chord = cubic.c1 + cubic.c2 + cubic.c3;
    const R slack = cubic.stray;
    const V inverse{inverse_of(chord.x), inverse_of(chord.y), inverse_of(chord.z)};
    for (int i = 0; i < scene_.box_count; ++i) {
      const LaneBox& box = scene_.boxes[i];
      R low(0), high(1);
      cut(R(box.low.x) - slack - cubic.c0.x, R(box.high.x) + slack - cubic.c0.x, inverse.x, low,
          high);
      cut(R(box.low.y) - slack - cubic.c0.y, R(box.high.y) + slack - cubic.c0.y, inverse.y, low,
          high);
      cut(R(box.low.z) - slack - cubic.c0.z, R(box.high.z) + slack - cubic.c0.z, inverse.z, low,
          high);
      doubtful = select(needed & (low <= high), R(1), doubtful);
    }
  }

  /// Finite even where v is 0: what lies between two planes there is all or nothing.
  [[nodiscard]] static R inverse_of(R v) { return R(1) / select(abs(v) > R(1e-20), v, R(1e-20)); }

  static void cut(R from, R to, R inverse, R& low, R& high) {
    const R a = from * inverse, b = to * inverse;
    low = max(low, min(a, b));
    high = min(high, max(a, b));
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
