#include "photon/field_parts.h"

#include <variant>

#include "gravity/attraction.h"

namespace portalens {
namespace {

bool acts(const Mass& mass, Vec3d x) {
  const Vec3d to = mass.center - x;
  const double square = dot(to, to);
  // Exactly at a point mass no direction is better than another.
  return mass.gm > 0.0 && square < mass.influence * mass.influence &&
         square + mass.core * mass.core > 0.0;
}

Vec3d pull_of(const Mass& mass, Vec3d x) {
  return attraction(mass.center - x, mass.gm, mass.core * mass.core);
}

/// w at x: of the masses that act, and of what comes through portals.
double potential_at(const Space& space, Vec3d x) {
  double sum = std::visit([&](const auto& coupling) { return coupling.pull(x, x).potential; },
                          space.coupling);
  for (const Mass& mass : space.masses)
    if (acts(mass, x)) sum += mass.potential(x);
  return sum / (space.physics.c * space.physics.c);
}

}  // namespace

Vec3d field_at(const Space& space, Vec3d x) {
  Vec3d total = std::visit([&](const auto& coupling) { return coupling.pull(x, x).acceleration; },
                           space.coupling);
  for (const Mass& mass : space.masses)
    if (acts(mass, x)) total += pull_of(mass, x);
  return total;
}

FieldReport report_field(const Space& space, Vec3d x) {
  FieldReport report;
  report.position = x;
  report.total = field_at(space, x);
  report.potential = potential_at(space, x);
  report.weight =
      std::visit([&](const auto& law) { return law.weight(report.potential); }, space.law);
  report.pull = report.total * report.weight;
  for (std::uint32_t i = 0; i < space.masses.size(); ++i) {
    const Mass& mass = space.masses[i];
    if (acts(mass, x)) report.direct.push_back({i, pull_of(mass, x), length(mass.center - x)});
  }
  report.through =
      std::visit([&](const auto& coupling) { return coupling.parts(x); }, space.coupling);
  return report;
}

}  // namespace portalens
