#include "gravity/law.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "gravity/mass.h"

namespace portalens {
namespace {

template <class Variant>
struct List;

template <class... Types>
struct List<std::variant<Types...>> {
  static constexpr std::array<std::string_view, sizeof...(Types)> names = {Types::name...};

  static Law make(std::string_view name) {
    Law made;
    [[maybe_unused]] const bool known =
        ((Types::name == name ? (made.emplace<Types>(), true) : false) || ...);
    assert(known);
    return made;
  }
};

/// Where h(w) w, which grows with w, is 1: the w there.
template <class L>
double potential_of_light_sphere() {
  double low = 0.0, high = 2.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (L::weight(middle) * middle < 1.0 ? low : high) = middle;
  }
  return high;
}

template <class L>
LawConstants constants() {
  LawConstants found;
  found.uniform = L::uniform;
  found.far_weight = L::weight(0.0);
  found.greatest_potential = std::numeric_limits<double>::infinity();
  if constexpr (requires { L::greatest_potential; })
    found.greatest_potential = L::greatest_potential;
  found.bare_masses = L::bare_masses;
  found.light_sphere = 1.0 / potential_of_light_sphere<L>();
  return found;
}

/// Σ m/d at the centre of a mass, of all others.
double potential_at(const Mass& mass, std::span<const Mass> masses, double c) {
  double sum = 0.0;
  for (const Mass& other : masses) {
    const double distance = std::hypot(length(other.center - mass.center), other.core);
    // What stands in the same place is the same hole.
    if (&other != &mass && distance > 0.0) sum += gravitational_radius(other.gm, c) / distance;
  }
  return sum;
}

}  // namespace

std::span<const std::string_view> law_names() { return List<Law>::names; }

Law make_law(std::string_view name) { return List<Law>::make(name); }

LawConstants constants_of(const Law& law) {
  return std::visit([](const auto& one) { return constants<std::remove_cvref_t<decltype(one)>>(); },
                    law);
}

void set_horizons(const Law& law, std::span<Mass> masses, double c) {
  const auto set = [&](const auto& one) {
    for (Mass& mass : masses) {
      mass.horizon_radius = one.horizon_radius(gravitational_radius(mass.gm, c),
                                               one.uniform ? 0.0 : potential_at(mass, masses, c));
      // Only what acts counts to w.
      if constexpr (requires { one.greatest_potential; })
        mass.horizon_radius = std::fmin(mass.horizon_radius, mass.influence);
    }
  };
  std::visit(set, law);
}

}  // namespace portalens
