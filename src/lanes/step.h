/// \file
/// One step of every lane: the default integrator over packs, with the events it may end in.
#pragma once

#include "lanes/coupled.h"
#include "lanes/crossing.h"
#include "lanes/few_masses.h"
#include "lanes/finding.h"
#include "lanes/gates.h"
#include "lanes/graviton_map.h"
#include "lanes/many_masses.h"
#include "lanes/outline.h"
#include "lanes/path.h"
#include "lanes/scene.h"
#include "lanes/shortest_path.h"
#include "math/multiply_add.h"
#include "photon/drift.h"

namespace portalens {

/// @tparam F  the field: `LaneMasses`, or what has its members
template <class R, class F>
class LaneStepper {
 public:
  using Mask = typename R::Mask;
  using V = Vec3<R>;

  LaneStepper(const LaneScene& scene, Lanes& lanes, int first)
      : scene_(scene), lanes_(lanes), first_(first) {}

  /// Bit i where lane `first` + i ends in an event.
  std::uint32_t step() {
    const Mask live = read(lanes_.live) > R(0);
    if (!any(live)) return 0;
    const V x{read(lanes_.x), read(lanes_.y), read(lanes_.z)};
    const V t{read(lanes_.tx), read(lanes_.ty), read(lanes_.tz)};
    F field(scene_);
    field.decide(x, t);

    const LaneBending<R> start = field.bending(x, t);
    const V bend = turning_part(start.acceleration, t);
    const Mask flies = !field.acting;
    const R most = min(longest(x, start, flies), select(flies, R(never), read(lanes_.longest)));
    const LaneBorder<R> border = field.boundary(x, t, bend, most);
    // What is decided holds from slightly ahead on: a border nearer than that is past.
    R h = min(most, max(border.at + R(scene_.overshoot), R(scene_.ahead)));
    // Scenes without isolated masses pay for a branch.
    const bool has_isolated = scene_.isolated_count > 0;
    LaneCrossing<R> isolated(scene_);
    if (has_isolated) {
      isolated.seek(x, t, flies, h);
      h = isolated.reach;
    }
    const auto acceleration = [&](V place) { return field.acceleration(place); };
    const StateOf<R> here{x, t};
    const Bends<R> bends = Radau::bends(acceleration, here, start.acceleration, h);
    LanePath<R> path(here, bends, h);
    const R pull2 = dot(start.acceleration, start.acceleration);
    // What the step errs by, as a multiple of what the scene allows, and of what this way may.
    const R error = Radau::roughness(Radau::doubt(here, bends, h, path.turn), pull2, start.gradient,
                                     h, R(scene_.third_weight), R(scene_.feedback_weight));
    const R roughness = error * read(lanes_.judged);
    if constexpr (F::foresees_planes)
      mend_length(border, most, (!flies) & (roughness <= R(Radau::smooth)), path, h);
    R next(never);
    if (any(roughness > R(Radau::smooth)))
      next = select(flies, next, Radau::longest_after(h, roughness, next));
    const Mask winds = read(lanes_.steps) > R(max_lane_steps);
    Mask again = live & !(flies | winds) & (roughness > R(Radau::roughest));
    if constexpr (F::may_lack_room) again = again & !field.lacks_room;
    LaneFinding<R> found;
    Mask doubtful = flies & (span(x) > R(F::sees_borders_far_off ? scene_.flight_limit : -1.0f));
    // Out there nothing is ahead of a path that leads further out.
    if (F::sees_borders_far_off && any(doubtful)) doubtful = doubtful & (dot(x, t) < R(0));
    Mask resigns = live & (winds | field.too_near(x) |
                           // Steps as short as borders are found exactly have no place here.
                           ((!flies) & (most < R(4) * R(scene_.overshoot))));
    find_horizons(path, field, found, resigns);
    find_portals(path, found);
    find_polygons(path, found, doubtful);
    find_spheres(path, found);
    R clear = read(lanes_.clear) - h;
    find_boxes(path, clear, doubtful);
    if (has_isolated) doubtful = doubtful | isolated.inside | (isolated.enters & may_end_within());
    if constexpr (F::may_lack_room) doubtful = doubtful | field.lacks_room;

    again = again & !resigns;
    path.met = min(found.share, R(1));
    find_change(path, field, live & !(flies | again | resigns | doubtful), found, doubtful);
    const Mask consults = live & doubtful & !(again | resigns);
    Mask ends = (found.share <= R(1)) & live & !(consults | again | resigns);
    // Within a step a path is not as exact as at its end: where that counts, it is gone again.
    const Mask cut = ends & !flies & (roughness > R(Radau::smooth)) & (found.share < R(0.98)) &
                     !(found.event == code(LaneEvent::horizon));
    if (any(cut)) {
      next = select(cut, h * found.share * R(1.002), next);
      again = again | cut;
      ends = ends & !cut;
    }
    Mask escapes =
        live & flies & (border.at >= R(never)) & !(found.share <= R(1)) & !(consults | resigns);
    if (has_isolated) {
      isolated.enters = live & isolated.enters & !(consults | resigns | ends);
      escapes = escapes & !isolated.enters;
    }
    const Mask stays = consults | resigns | escapes | again | !live;
    select(live, next, R(never)).store(lanes_.longest + first_);

    V x1 = path.end.position, t1 = path.end.direction;
    R length = h;
    if (any(ends)) {
      const R u = select(ends, found.share, R(1));
      length = length * u;
      x1 = choose(ends, path.place.at(u), x1);
      t1 = choose(ends, unit(path.place.slope(u) * (R(1) / h)), t1);
    }
    const V turned = t1 - t;
    const R chord2 = dot(turned, turned);
    R angle = sqrt(chord2) * multiply_add(chord2, R(1.0 / 24.0), R(1));
    const bool crosses = has_isolated && any(isolated.enters);
    R crossed(0);
    if (crosses) {
      const auto passage = isolated.pass();
      x1 = choose(isolated.enters, passage.place, x1);
      t1 = choose(isolated.enters, passage.direction, t1);
      length = length + passage.length;
      angle = angle + passage.turning;
      clear = clear - passage.length;
      crossed = select(passage.captured, code(LaneEvent::horizon), code(LaneEvent::cross));
      found.object = select(isolated.enters, passage.object, found.object);
    }
    write(lanes_.x, stays, x.x, x1.x);
    write(lanes_.y, stays, x.y, x1.y);
    write(lanes_.z, stays, x.z, x1.z);
    write(lanes_.tx, stays, t.x, t1.x);
    write(lanes_.ty, stays, t.y, t1.y);
    write(lanes_.tz, stays, t.z, t1.z);
    const R travelled = add(lanes_.length, stays, length);
    const R turning = add(lanes_.turning, stays, angle);
    const R steps = add(lanes_.steps, stays, R(1));
    const R drifted = drift(stays, length, span(x1), start.gradient,
                            R(scene_.tolerance) * select(flies, R(0), error));
    write(lanes_.clear, stays, read(lanes_.clear), clear);
    // After a short step a plane may still be as near as rounding.
    write(lanes_.departed, stays | (length < R(8) * R(scene_.ahead)), read(lanes_.departed), R(-1));
    const Mask within = (travelled <= R(scene_.max_length)) & (turning <= R(scene_.max_turning)) &
                        (steps <= R(scene_.max_steps));
    R event = select(live & !again & !within, code(LaneEvent::limit), R(0));
    if (crosses) {
      const Mask counts = (event == R(0)) | (crossed == code(LaneEvent::horizon));
      event = select(isolated.enters & counts, crossed, event);
    }
    event = select(ends & (found.event > R(0)), found.event, event);
    event = select(escapes, code(LaneEvent::escape), event);
    event = select(consults, code(LaneEvent::consult), event);
    // A path may drift until it is known where it leads: one that is swallowed tells no direction.
    const Mask tells = (event > R(0)) & !(event == code(LaneEvent::horizon));
    const Mask drifts =
        live & (drifted > select(tells, read(lanes_.max_drift), R(scene_.max_absorbed)));
    event = select(resigns | drifts, code(LaneEvent::resign), event);
    event.store(lanes_.event + first_);
    found.object.store(lanes_.object + first_);
    return bits(event > R(0));
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
  /// What the step and the rounding of where it ends add to what a path has drifted; how much its
  /// direction then has.
  [[nodiscard]] R drift(Mask stays, R length, R size, R gradient, R error) const {
    const R rounding(6e-8);
    const Drift<R> before{read(lanes_.astray), read(lanes_.askew)};
    Drift<R> after = before;
    after.pass(length, gradient, error + rounding);
    write(lanes_.astray, stays, before.place, multiply_add(size, rounding, after.place));
    write(lanes_.askew, stays, before.direction, after.direction);
    return select(stays, before.direction, after.direction);
  }
  [[nodiscard]] static R code(LaneEvent event) { return R(static_cast<int>(event)); }
  /// Whether a path may reach a limit before it has crossed the influence of an isolated mass.
  [[nodiscard]] Mask may_end_within() const {
    constexpr double max_turned = 1.6;  // by one mass
    return (read(lanes_.length) + R(scene_.farthest) > R(scene_.max_length)) |
           (read(lanes_.turning) + R(max_turned) > R(scene_.max_turning));
  }

  /// How long a step may be before borders cut it: what the field allows, or, where nothing acts,
  /// out of the scene.
  [[nodiscard]] R longest(V x, const LaneBending<R>& start, Mask flies) const {
    const R proposed = Radau::propose(start.stiffness, start.nearness, R(scene_.stiffness_weight),
                                      R(scene_.nearness_weight));
    return select(flies, span(x) + R(scene_.radius),
                  min(proposed * read(lanes_.shorter), R(scene_.farthest)));
  }

  /// A border was foreseen as if the path bent evenly. A step that ends a little before or past the
  /// plane that it was to end behind, ends there now: as near to its end its path is as exact.
  /// @param most  how long a step may be
  void mend_length(const LaneBorder<R>& border, R most, Mask may, LanePath<R>& path, R& h) const {
    constexpr double max_share = 1.0 / 32.0;
    const R height = border.height + dot(path.end.position - path.place.c0, border.normal);
    const R more = R(scene_.overshoot) - height / dot(path.end.direction, border.normal);
    const Mask mends = may & (border.at < h) & (abs(more) < h * R(max_share)) & (h + more <= most) &
                       (h > R(64) * R(scene_.overshoot));
    if (!any(mends)) return;
    path.stretch(mends, R(1) + more / h);
    h = path.h;
  }

  /// Ends the step where what acts changes, if `boundary` has not foreseen it. A straight flight
  /// ends where it has.
  void find_change(const LanePath<R>& path, const F& field, Mask which, LaneFinding<R>& found,
                   Mask& doubtful) const {
    if (!any(which)) return;
    const R over(scene_.overshoot);
    FirstMeeting<R> first;
    // What steps of a few borders' slack run over was decided past it, and so is what they meet
    // soon.
    const Mask soon = (found.share <= R(1)) & (path.met * path.h < R(8) * R(scene_.ahead));
    field.find_changes(first, which & (path.h > R(8) * over) & !soon, path, over);
    doubtful = doubtful | first.missed;
    // So close before what it meets, a step's end might be rounded to behind that.
    const R past = first.share + over / path.h;
    const Mask apart = past + R(8) * R(scene_.ahead) / path.h < found.share;
    found.offer((first.share <= R(1)) & apart, past, LaneEvent::none, R(-1));
  }

  void find_horizons(const LanePath<R>& path, const F& field, LaneFinding<R>& found,
                     Mask& resigns) const {
    for (int i = 0; i < field.mass_count(); ++i) {
      const LaneMass& mass = field.mass(i);
      if (mass.horizon < 0.0f) {
        resigns = resigns | (field.distance2(i) < R(mass.bare2));
        continue;
      }
      const R ahead = field.ahead(i), distance2 = field.distance2(i);
      const R reach = path.h + R(mass.horizon);
      Mask towards = (ahead > R(0)) & (distance2 < reach * reach);
      // A straight flight ends where an influence begins.
      if (mass.influence > mass.horizon) towards = towards & field.acting;
      if (!any(towards)) continue;
      // Straight on, as far as it may stray from that.
      const R aside = path.stray + R(mass.horizon);
      towards = towards & (subtract_product(distance2 * R(0.999999), ahead, ahead) < aside * aside);
      if (!any(towards)) continue;
      const V center = spread<R>(mass.center);
      const V last = path.end.position - center;
      Mask falls = towards & (dot(last, last) <= R(mass.horizon2));
      const LaneDistance<R> outside{path, center, R(mass.horizon2)};
      R inside(1);
      // Not at its end, but where it is nearest.
      const Mask passes = towards & !falls & (ahead < reach);
      if (any(passes)) {
        const R nearest = outside.nearest();
        inside = select(passes, nearest, inside);
        falls = falls | (passes & (outside.at(nearest) <= R(0)));
      }
      if (!any(falls)) continue;
      const R guess = outside.surface_from(inside, R(-1));
      found.offer(falls, crossing(falls, outside, guess, R(1), R(0), inside), LaneEvent::horizon,
                  R(field.object_of(i)));
    }
  }

  void find_portals(const LanePath<R>& path, LaneFinding<R>& found) const {
    const R departed = read(lanes_.departed), side = read(lanes_.departed_side);
    const bool leaves = any(departed <= R(first_departed_plane));
    for (int p = 0; p < scene_.portal_count; ++p) {
      const LanePortal& portal = scene_.portals[p];
      const V normal = spread<R>(portal.normal), origin = spread<R>(portal.origin);
      R z0 = dot(path.place.c0 - origin, normal);
      const R z1 = dot(path.end.position - origin, normal);
      // What has just left its plane may lie a float's rounding on the other side of it.
      R slack(0);
      if (leaves) {
        const Mask leaving = departed == R(portal.leaves);
        z0 = select(leaving, side * R(2.0f * portal.facing * portal.tolerance), z0);
        slack = select(leaving, R(portal.tolerance), slack);
      }
      Mask crosses = (z0 >= R(-portal.tolerance)) & (z1 < -slack) & (z1 < z0);
      if (portal.back > 0.0f) crosses = crosses | ((z0 < R(0)) & (z1 >= slack));
      if (!any(crosses)) continue;
      const R u =
          crossing(crosses, path.height(z0, normal), max(z0 / select(crosses, z0 - z1, R(1)), R(0)),
                   select(z1 < R(0), R(1), R(-1)), R(0), R(1));
      const V d = path.place.at(u) - origin;
      const R x = dot(d, spread<R>(portal.right)), y = dot(d, spread<R>(portal.up));
      Mask within = (abs(x) <= R(portal.half_width)) & (abs(y) <= R(portal.half_height));
      if (portal.outline) within = within & covers(*portal.outline, x, y);
      found.offer(crosses & within, u, LaneEvent::portal, R(p));
    }
  }

  void find_polygons(const LanePath<R>& path, LaneFinding<R>& found, Mask& doubtful) const {
    const R departed = read(lanes_.departed), side = read(lanes_.departed_side);
    const bool leaves = any((departed > R(-1)) | (departed < R(-1)));
    const R sagitta = span(path.end.direction * path.h - path.place.c1) * R(0.25);
    for (int p = 0; p < scene_.polygon_count; ++p) {
      const LanePolygon& polygon = scene_.polygons[p];
      const V normal = spread<R>(polygon.normal);
      R z0 = dot(path.place.c0, normal) - R(polygon.distance);
      const R z1 = dot(path.end.position, normal) - R(polygon.distance);
      if (leaves) z0 = select(departed == R(polygon.leaves), side * R(1e-20f * polygon.facing), z0);
      const Mask crosses = (z0 > R(0)) ^ (z1 > R(0));
      const Mask near = min(abs(z0), abs(z1)) < sagitta;
      if (!any(crosses | near)) continue;
      // Both ends on one side, first towards the plane, then away: it may dip through between.
      const R s0 = dot(path.place.c1, normal), s1 = dot(path.end.direction, normal);
      const Mask dips = near & !crosses & (z0 * s0 < R(0)) & (z1 * s1 > R(0));
      Mask within = (crosses | dips) &
                    path.may_touch(path.place.c0 - spread<R>(polygon.middle), R(polygon.radius));
      if (!any(within)) continue;
      const R u = crossing(crosses, path.height(z0, normal), z0 / select(crosses, z0 - z1, R(1)),
                           z0, R(0), R(1));
      const V at = path.place.at(select(crosses, u, R(0.5)));
      const R slack = select(dips, path.h, R(0));
      for (int k = 0; k < 4; ++k)
        within =
            within &
            (dot(at, spread<R>(polygon.edge_normal[k])) - R(polygon.edge_distance[k]) >= -slack);
      found.offer(crosses & within, u, LaneEvent::hit, R(polygon.shape));
      doubtful = doubtful | (dips & within);
    }
  }

  void find_spheres(const LanePath<R>& path, LaneFinding<R>& found) const {
    const R departed = read(lanes_.departed), side = read(lanes_.departed_side);
    // Of spheres in one place the last is met.
    for (int i = scene_.sphere_count; i-- > 0;) {
      const LaneSphere& sphere = scene_.spheres[i];
      const V center = spread<R>(sphere.center);
      // In the lanes that may: what is found must not depend on who travels beside.
      const Mask touches = path.may_touch(path.place.c0 - center, R(sphere.radius));
      if (!any(touches)) continue;
      const LaneDistance<R> outside{path, center, R(sphere.radius * sphere.radius)};
      const Mask leaving = departed == R(sphere.shape);
      const R f0 = select(leaving, side * R(1e-20), outside.at(R(0)));
      const R f1 = outside.at(R(1));
      // From outside the nearest point of the step decides.
      const R nearest = outside.nearest();
      const Mask enters = touches & (f0 > R(0)) & ((f1 <= R(0)) | (outside.at(nearest) <= R(0))) &
                          !(leaving & (nearest <= R(0)));
      const Mask exits = touches & (f0 <= R(0)) & (f1 > R(0));
      if (!any(enters | exits)) continue;
      const R before = select(enters, R(1), R(-1));
      const R inside = select(exits, R(0), select(f1 <= R(0), R(1), nearest));
      const R last = select(exits, R(1), inside);
      const R u = crossing(enters | exits, outside, outside.surface_from(inside, -before), before,
                           R(0), last);
      found.offer(enters | exits, u, LaneEvent::hit, R(sphere.shape));
    }
  }

  void find_boxes(const LanePath<R>& path, R clear, Mask& doubtful) const {
    if (scene_.box_count == 0) return;
    const Mask needed = clear < R(0);
    if (!any(needed)) return;
    // The share of the chord that lies between the planes of each pair; the curve strays from it.
    const V from = path.place.c0, chord = path.end.position - from;
    const R slack = path.stray;
    const V inverse{inverse_of(chord.x), inverse_of(chord.y), inverse_of(chord.z)};
    for (int i = 0; i < scene_.box_count; ++i) {
      const LaneBox& box = scene_.boxes[i];
      R low(0), high(1);
      cut(R(box.low.x) - slack - from.x, R(box.high.x) + slack - from.x, inverse.x, low, high);
      cut(R(box.low.y) - slack - from.y, R(box.high.y) + slack - from.y, inverse.y, low, high);
      cut(R(box.low.z) - slack - from.z, R(box.high.z) + slack - from.z, inverse.z, low, high);
      doubtful = doubtful | (needed & (low <= high));
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

/// Never inlined: one function of all fields is more than compilers find registers for.
template <class R, class F>
[[gnu::noinline]] std::uint32_t step_lanes_in(const LaneScene& scene, Lanes& lanes) {
  std::uint32_t events = 0;
  for (int first = 0; first < lane_count; first += R::lanes)
    events |= LaneStepper<R, F>(scene, lanes, first).step() << first;
  return events;
}

template <class R>
std::uint32_t step_lanes(const LaneScene& scene, Lanes& lanes) {
  if (scene.map_count > 0)
    return step_lanes_in<R, LaneCoupled<R, LaneGravitonMap<R>>>(scene, lanes);
  if (scene.way_count > 0)
    return step_lanes_in<R, LaneCoupled<R, LaneShortestPath<R>>>(scene, lanes);
  if (scene.gate_count > 0 && scene.outline_count > 0)
    return step_lanes_in<R, LaneCoupled<R, LaneGates<R, LaneOutlineNearest<R>>>>(scene, lanes);
  if (scene.gate_count > 0)
    return step_lanes_in<R, LaneCoupled<R, LaneGates<R, LaneNearest<R>>>>(scene, lanes);
  if (scene.many.count > 0) return step_lanes_in<R, LaneManyMassesField<R>>(scene, lanes);
  return step_lanes_in<R, LaneMasses<R>>(scene, lanes);
}

}  // namespace portalens
