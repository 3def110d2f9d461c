#include "photon/horizons.h"

#include <cmath>

#include "gravity/attraction.h"

namespace portalens {
namespace {

/// The end of the stretch from `low` on which `holds`, to the last digits.
template <class Predicate>
double bisect(double low, double high, Predicate holds) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (holds(middle) ? low : high) = middle;
  }
  return high;
}

/// Where the curve meets this horizon, or nothing.
std::optional<double> contact(const Mass& mass, const Curve& curve) {
  const double h = curve.length();
  const double r2 = mass.horizon_radius * mass.horizon_radius;
  const auto outside = [&](double s) {
    const Vec3d d = curve.position(s) - mass.center;
    return dot(d, d) - r2;
  };
  const auto approaches = [&](double s) {
    return dot(curve.position(s) - mass.center, curve.direction(s)) < 0.0;
  };
  if (!approaches(0.0)) return std::nullopt;
  double closest = h;
  if (outside(h) > 0.0) {
    if (approaches(h)) return std::nullopt;
    closest = bisect(0.0, h, approaches);
    if (outside(closest) > 0.0) return std::nullopt;
  }
  return bisect(0.0, closest, [&](double s) { return outside(s) > 0.0; });
}

/// Whether the curve stays farther from the mass than its horizon, by a bound.
bool surely_misses(const Mass& mass, const Curve& curve) {
  const Vec3d d = curve.position(0.0) - mass.center;
  const double least = mass.horizon_radius + curve.length();
  return dot(d, d) > least * least;
}

/// Σ m/d of the masses that act directly at a place, and which of them counts for most.
struct Depth {
  double potential = 0.0, most = 0.0;
  std::uint32_t deepest = 0;

  Depth(const Space& space, std::span<const std::uint32_t> near, Vec3d x) {
    const double c2 = space.physics.c * space.physics.c;
    for (const std::uint32_t i : near) {
      const Mass& mass = space.masses[i];
      if (!mass.reaches(x)) continue;
      const double w = mass.potential(x) / c2;
      potential += w;
      if (w > most) most = w, deepest = i;
    }
  }
};

/// As `contact`, with the surface on which w is the law's `greatest_potential`.
std::optional<HorizonContact> deepest_contact(const Space& space,
                                              std::span<const std::uint32_t> near,
                                              const Curve& curve) {
  const double h = curve.length(), limit = space.medium.greatest_potential;
  const auto depth = [&](double s) { return Depth(space, near, curve.position(s)); };
  const auto above = [&](double s) { return depth(s).potential < limit; };
  const auto sinks = [&](double s) {
    const Vec3d x = curve.position(s);
    Vec3d pull;
    for (const std::uint32_t i : near) {
      const Mass& mass = space.masses[i];
      if (mass.reaches(x)) pull += attraction(mass.center - x, mass.gm, mass.core * mass.core);
    }
    return dot(pull, curve.direction(s)) > 0.0;
  };
  double deepest = h;
  if (above(h)) {
    if (!sinks(0.0) || sinks(h)) return std::nullopt;
    deepest = bisect(0.0, h, sinks);
    if (above(deepest)) return std::nullopt;
  }
  const double at = bisect(0.0, deepest, above);
  return HorizonContact{depth(at).deepest, at};
}

}  // namespace

std::optional<std::uint32_t> horizon_around(const Space& space, std::span<const std::uint32_t> near,
                                            Vec3d x) {
  if (std::isfinite(space.medium.greatest_potential)) {
    const Depth depth(space, near, x);
    if (depth.potential >= space.medium.greatest_potential) return depth.deepest;
    return std::nullopt;
  }
  for (const std::uint32_t i : near) {
    const Mass& mass = space.masses[i];
    const Vec3d d = mass.center - x;
    if (mass.has_horizon() && dot(d, d) <= mass.horizon_radius * mass.horizon_radius) return i;
  }
  return std::nullopt;
}

std::optional<HorizonContact> first_horizon(const Space& space, std::span<const std::uint32_t> near,
                                            const Curve& curve) {
  if (std::isfinite(space.medium.greatest_potential)) return deepest_contact(space, near, curve);
  std::optional<HorizonContact> first;
  for (const std::uint32_t i : near) {
    const Mass& mass = space.masses[i];
    if (!mass.has_horizon() || surely_misses(mass, curve)) continue;
    const auto at = contact(mass, curve);
    if (at && (!first || *at < first->distance)) first = HorizonContact{i, *at};
  }
  return first;
}

}  // namespace portalens
