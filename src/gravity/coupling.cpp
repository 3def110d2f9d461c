#include "gravity/coupling.h"

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

CouplingCost estimated_cost(std::string_view name, const CouplingInput& input) {
  return List<Coupling>::cost(name, input);
}

}  // namespace portalens
