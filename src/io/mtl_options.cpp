#include "io/mtl_options.h"

#include <algorithm>

#include "io/lines.h"
#include "io/tokens.h"

namespace portalens {
namespace {

/// An option, how many values it has at least and at most, and the values that change nothing: of
/// numbers all that are left out are the last of them.
struct MapOption {
  std::string_view name;
  std::size_t low, high;
  std::vector<std::string_view> neutral;  ///< empty: none of its values counts for a colour
};

const MapOption* find_option(std::string_view word) {
  static const std::vector<MapOption> options{{"-blendu", 1, 1, {"on"}},
                                              {"-blendv", 1, 1, {"on"}},
                                              {"-bm", 1, 1, {}},
                                              {"-boost", 1, 1, {}},
                                              {"-cc", 1, 1, {}},
                                              {"-clamp", 1, 1, {"off"}},
                                              {"-colorspace", 1, 1, {"srgb"}},
                                              {"-imfchan", 1, 1, {}},
                                              {"-mm", 2, 2, {"0", "1"}},
                                              {"-o", 1, 3, {"0", "0", "0"}},
                                              {"-s", 1, 3, {"1", "1", "1"}},
                                              {"-t", 1, 3, {"0", "0", "0"}},
                                              {"-texres", 1, 1, {}},
                                              {"-type", 1, 1, {}}};
  const auto found = std::find_if(options.begin(), options.end(),
                                  [&](const MapOption& one) { return one.name == word; });
  return found == options.end() ? nullptr : &*found;
}

bool same(std::string_view said, std::string_view neutral) {
  const auto a = parse_number(said), b = parse_number(neutral);
  return a && b ? *a == *b : in_small_letters(said) == neutral;
}

}  // namespace

MapOptions map_options(const std::vector<std::string_view>& words) {
  MapOptions options;
  std::size_t& at = options.name;
  while (at < words.size()) {
    const MapOption* option = find_option(in_small_letters(words[at]));
    if (!option && !(words[at][0] == '-' && at + 2 < words.size())) break;
    // What is not known has one value, most likely.
    static const MapOption unknown{"", 1, 1, {"?"}};
    if (!option) option = &unknown;
    const std::size_t first = at + 1;
    std::size_t end = std::min(first + option->low, words.size());
    while (end < std::min(first + option->high, words.size()) && parse_number(words[end])) ++end;
    bool neutral = true;
    std::string said(words[at]);
    for (std::size_t i = first; i < end; ++i) {
      said += ' ' + std::string(words[i]);
      neutral = neutral && (option->neutral.empty() || same(words[i], option->neutral[i - first]));
    }
    if (!neutral) options.not_done.push_back(said);
    at = end;
  }
  return options;
}

}  // namespace portalens
