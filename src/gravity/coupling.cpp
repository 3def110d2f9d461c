#include "gravity/coupling.h"

#include <algorithm>
#include <cassert>

namespace portalens {

namespace {

template <class Variant>
struct List;

template <class... Types>
struct List<std::variant<Types...>> {
  static std::vector<std::string_view> names() { return {Types::name...}; }

  static Coupling make(std::string_view name, const CouplingInput& input) {
    Coupling made;
    [[maybe_unused]] const bool known =
        ((Types::name == name ? (made.emplace<Types>(input), true) : false) || ...);
    assert(known);
    return made;
  }

  static bool asks_motion(std::string_view name) {
    return ((Types::name == name && Types::asks_motion) || ...);
  }

  static CouplingCost cost(std::string_view name, const CouplingInput& input) {
    CouplingCost found;
    [[maybe_unused]] const bool known =
        ((Types::name == name ? (found = Types::cost(input), true) : false) || ...);
    assert(known);
    return found;
  }
};

}  // namespace

std::vector<std::string_view> coupling_names() { return List<Coupling>::names(); }

Coupling make_coupling(std::string_view name, const CouplingInput& input) {
  return List<Coupling>::make(name, input);
}

const Portal* barred_portal(std::string_view name, std::span<const Portal> portals) {
  if (!List<Coupling>::asks_motion(name)) return nullptr;
  const auto barred = std::find_if(portals.begin(), portals.end(),
                                   [](const Portal& portal) { return !portal.motion(); });
  return barred == portals.end() ? nullptr : &*barred;
}

CouplingCost estimated_cost(std::string_view name, const CouplingInput& input) {
  return List<Coupling>::cost(name, input);
}

}  // namespace portalens
