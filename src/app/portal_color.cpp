#include "app/portal_color.h"

#include <array>
#include <string>
#include <string_view>

namespace portalens {
namespace {

struct NamedColor {
  std::string_view name;
  Color color;
};
constexpr std::array<NamedColor, 8> portal_colors = {{{"blue", {0.10, 0.40, 0.85}},
                                                      {"orange", {0.90, 0.45, 0.05}},
                                                      {"purple", {0.55, 0.25, 0.70}},
                                                      {"olive", {0.50, 0.50, 0.10}},
                                                      {"teal", {0.05, 0.52, 0.52}},
                                                      {"red", {0.82, 0.15, 0.20}},
                                                      {"pink", {0.85, 0.35, 0.65}},
                                                      {"brown", {0.50, 0.32, 0.18}}}};

}  // namespace

Color portal_color(std::span<const Portal> portals, std::uint32_t portal) {
  for (const NamedColor& known : portal_colors)
    if (portals[portal].name.find(known.name) != std::string::npos) return known.color;
  return portal_colors[portal % portal_colors.size()].color;
}

}  // namespace portalens
