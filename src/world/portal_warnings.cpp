#include "world/portal_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/words.h"
#include "world/world.h"

namespace portalens {
namespace {

constexpr std::size_t max_told = 20;

std::string told(Vec3d v) {
  // So that rounding shows no -0.
  const auto shown = [](double x) { return std::fabs(x) < 5e-4 ? 0.0 : x; };
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", shown(v.x), shown(v.y), shown(v.z));
}

/// Light passes from behind as if nothing were there: then none of the portals can be seen.
void about_backs(const World& world, std::vector<std::string>& warnings) {
  const auto portals = world.space.portals.portals();
  const auto shows_its_back = [&](const Portal& portal) {
    const double height = dot(world.camera.position - portal.frame.origin, portal.frame.normal);
    return !portal.has_back() && height < -portal.height_tolerance();
  };
  if (portals.empty() || !std::all_of(portals.begin(), portals.end(), shows_its_back)) return;
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(portals.size(), 4); ++i)
    names += (i > 0 ? ", " : "") + in_quotes(portals[i].name);
  if (portals.size() > 4) names += ", ...";
  warnings.push_back(
      fmt::format("the camera is behind every portal ({}), and their backs are open: none is seen "
                  "straight; list their corners in the other order, or give back = \"portal\"; a "
                  "camera that has gone through one stands elsewhere (docs/films.md)",
                  names));
}

/// The axis that the camera has upwards, or nearly.
std::optional<Vec3d> axis_upwards(const Camera& camera) {
  constexpr Vec3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec3d& axis : axes)
    if (const double along = dot(axis, camera.up); std::fabs(along) > 0.8)
      return along > 0.0 ? axis : -axis;
  return std::nullopt;
}

/// Whoever builds two upright doors by their corners easily begins one of them at another corner.
void about_turning(const World& world, std::vector<std::string>& warnings) {
  const auto up = axis_upwards(world.camera);
  if (!up) return;
  const auto portals = world.space.portals.portals();
  const auto stands = [&](const Portal& portal) {
    return std::fabs(dot(portal.frame.normal, *up)) < 1e-3;
  };
  std::size_t found = 0;
  for (std::size_t i = 0; i < portals.size() && found < max_told; ++i) {
    const Portal &a = portals[i], &b = portals[a.pair];
    if (a.pair < i || !stands(a) || !stands(b) || !a.motion()) continue;
    const Vec3d becomes = a.motion()->rotate(*up);
    if (dot(becomes, *up) > 0.99) continue;
    ++found;
    warnings.push_back(fmt::format(
        "portals {} and {} stand upright, but through {} up, {}, becomes {}: the first edges of "
        "both have to correspond; list the corners of {} from another one on",
        in_quotes(a.name), in_quotes(b.name), in_quotes(a.name), told(*up), told(becomes),
        in_quotes(b.name)));
  }
}

}  // namespace

void warn_about_portals(const World& world, std::vector<std::string>& warnings) {
  about_backs(world, warnings);
  about_turning(world, warnings);
}

}  // namespace portalens
