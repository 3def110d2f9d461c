#include "render/cut_turning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace portalens {
namespace {

bool ends(const Mass& mass) { return mass.gm > 0.0 && std::isfinite(mass.influence); }

Physics without_ends(Physics physics) {
  physics.min_force = 0.0;
  physics.portal_gravity = "none";
  return physics;
}

}  // namespace

EndlessPull::EndlessPull(const World& world) {
  std::vector<Mass> masses = world.space.masses;
  if (std::none_of(masses.begin(), masses.end(), ends)) return;
  for (Mass& mass : masses) mass.influence = std::numeric_limits<double>::infinity();
  space_.emplace(without_ends(world.space.physics), world.space.max_crossings, std::vector<Shape>{},
                 std::vector<Portal>{}, std::move(masses));
}

std::optional<double> EndlessPull::missing_turning(const Trace& trace) const {
  const bool straight = trace.path_trace.crossings.empty() && trace.bounces.empty();
  if (!space_ || !straight || trace.end.fate != Fate::escaped) return std::nullopt;
  PathTrace unused;
  const Arrival whole = advance_recorded(*space_, trace.start, unused);
  if (whole.fate != Fate::escaped) return std::nullopt;
  return whole.turning - trace.end.turning;
}

}  // namespace portalens
