#include "portal/passage.h"

#include <cassert>

namespace portalens {
namespace {

template <class Variant>
struct List;

template <class... Types>
struct List<std::variant<Types...>> {
  static Passage make(const PassageInput& input) {
    Passage made;
    const auto takes = [&](auto passage) {
      const bool fits = passage.has_value();
      if (fits) made = *std::move(passage);
      return fits;
    };
    [[maybe_unused]] const bool taken = (takes(Types::between(input)) || ...);
    assert(taken);
    return made;
  }
};

}  // namespace

Passage passage_between(const PassageInput& input) { return List<Passage>::make(input); }

}  // namespace portalens
