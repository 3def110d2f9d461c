#include "world/mass_reader.h"

#include <cmath>
#include <string_view>

#include "core/words.h"
#include "geometry/extent.h"
#include "gravity/law.h"

namespace portalens {
namespace {

void refuse_without_mass(Parameters& parameters) {
  for (const std::string_view key : {"center_of_mass", "core_radius", "horizon"}) {
    if (parameters.has(key))
      parameters.fault(key, in_quotes(key) + " has no meaning without a mass",
                       "give 'mass' too, or remove it");
  }
}

}  // namespace

std::optional<std::uint32_t> read_mass(Parameters& parameters, const std::string& name, MassKey key,
                                       Vec3d center, const Physics& physics,
                                       std::vector<Mass>& masses) {
  if (key == MassKey::optional && !parameters.has("mass")) {
    refuse_without_mass(parameters);
    return std::nullopt;
  }
  Mass mass;
  mass.name = name;
  mass.center = center;
  const double kilograms = parameters.number("mass", non_negative);
  if (key == MassKey::optional && parameters.has("center_of_mass"))
    mass.center = to_vec3(parameters.triple("center_of_mass", coordinate));
  mass.core = parameters.number("core_radius", non_negative, 0.0);
  mass.horizon = parameters.boolean("horizon", mass.core == 0.0);
  if (!mass.horizon && mass.core == 0.0 && kilograms > 0.0 &&
      !constants_of(make_law(physics.law)).bare_masses)
    parameters.fault(
        "horizon",
        "under the law " + in_quotes(physics.law) +
            " light can't pass a mass that has neither a horizon nor a core",
        "leave it out, give a core_radius, or take the law \"newton\" or \"einstein\"");
  mass.gm = physics.G * kilograms;
  mass.horizon_radius = schwarzschild_radius(mass.gm, physics.c);
  mass.influence = influence_radius(mass.gm, physics.min_force);
  if (!(mass.horizon_radius <= largest_coordinate) || !std::isfinite(mass.gm)) {
    parameters.fault("mass", "the horizon of this mass is wider than 1e12",
                     "give a smaller mass, or a smaller G");
    return std::nullopt;
  }
  if (mass.gm == 0.0) return std::nullopt;
  masses.push_back(mass);
  return static_cast<std::uint32_t>(masses.size() - 1);
}

}  // namespace portalens
