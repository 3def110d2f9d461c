/// \file
/// Over lanes: what a step meets: horizons, portals, surfaces, and boxes of what lanes can't judge.
#pragma once

#include "lanes/face_axes.h"
#include "lanes/finding.h"
#include "lanes/outline.h"
#include "lanes/pack.h"
#include "lanes/path.h"

namespace portalens {

/// Finds for the lanes of one pack. What is found of a lane never depends on who travels beside it.
template <class R>
class LaneMeetings {
 public:
  using Mask = typename R::Mask;
  using V = Vec3<R>;

  LaneMeetings(const LaneScene& scene, const LanePack<R>& pack) : scene_(scene), pack_(pack) {}

  /// @param field    of the masses that may absorb, with what was decided at the step's start
  /// @param resigns  gets the lanes that are too near a mass that has no horizon
  template <class F>
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

  /// Where w comes to the greatest: no path leads out of there again.
  template <class F>
  void find_depth(const LanePath<R>& path, const F& field, LaneFinding<R>& found) const {
    const Mask falls =
        field.acting & (field.potential(path.end.position) >= R(F::Weight::greatest_potential));
    if (!any(falls)) return;
    const R u = crossing(falls, Depth<F>{field, path}, R(1), R(1), R(0), R(1));
    found.offer(falls, u, LaneEvent::horizon, field.deepest(path.place.at(u)));
  }

  void find_portals(const LanePath<R>& path, LaneFinding<R>& found) const {
    const R departed = pack_.read(&Lanes::departed), side = pack_.read(&Lanes::departed_side);
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
    const R departed = pack_.read(&Lanes::departed), side = pack_.read(&Lanes::departed_side);
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
    const R departed = pack_.read(&Lanes::departed), side = pack_.read(&Lanes::departed_side);
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

  /// @param clear     nothing that boxes hold is met within that much path from the step's end
  /// Where paths may meet something in a box.
  /// @param doubtful  gets the lanes that may in a narrow one
  [[nodiscard]] Mask find_boxes(const LanePath<R>& path, R clear, Mask& doubtful) const {
    Mask found = R(1) < R(0);
    if (scene_.box_count == 0) return found;
    const Mask needed = clear < R(0);
    if (!any(needed)) return found;
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
      Mask& where = box.narrow ? doubtful : found;
      where = where | (needed & (low <= high));
    }
    return found;
  }

 private:
  /// How far over the surface where light ends: as 1/w, that is nearly the distance.
  template <class F>
  struct Depth {
    const F& field;
    const LanePath<R>& path;

    [[nodiscard]] R at(R u) const {
      return R(1) / field.potential(path.place.at(u)) - R(1.0 / F::Weight::greatest_potential);
    }
    [[nodiscard]] R slope(R u) const {
      const R w = field.potential(path.place.at(u));
      return -field.potential_slope(path.place.at(u), path.place.slope(u)) / (w * w);
    }
  };

  /// Finite even where v is 0: what lies between two planes there is all or nothing.
  [[nodiscard]] static R inverse_of(R v) { return R(1) / select(abs(v) > R(1e-20), v, R(1e-20)); }

  static void cut(R from, R to, R inverse, R& low, R& high) {
    const R a = from * inverse, b = to * inverse;
    low = max(low, min(a, b));
    high = min(high, max(a, b));
  }

  const LaneScene& scene_;
  const LanePack<R>& pack_;
};

}  // namespace portalens
