#include "app/beyond.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace portalens {
namespace {

/// Without what rounding leaves of 0.
std::string list_of(Vec3d v) {
  const double least = 1e-12 * (1.0 + length(v));
  const auto clean = [least](double x) { return std::fabs(x) < least ? 0.0 : x; };
  return fmt::format("[{:.10g}, {:.10g}, {:.10g}]", clean(v.x), clean(v.y), clean(v.z));
}

}  // namespace

CameraPlace place_of(const Camera& camera) {
  return {camera.position, camera.position + camera.forward, camera.up};
}

std::optional<CameraPlace> beyond(const Portal& portal, const CameraPlace& place) {
  const Rigid* motion = portal.motion();
  if (!motion) return std::nullopt;
  return CameraPlace{motion->move(place.position), motion->move(place.look_at),
                     motion->rotate(place.up)};
}

std::optional<CameraPlace> beyond(const World& world, const Trace& trace) {
  const std::vector<std::uint32_t>& crossed = trace.path_trace.crossings;
  const std::size_t count = trace.bounces.empty() ? crossed.size() : trace.bounces[0].crossings;
  if (count == 0) return std::nullopt;
  const Vec3d start = trace.start.position;
  std::optional<CameraPlace> place =
      trace.view ? place_of(world.camera)
                 : CameraPlace{start, start + trace.start.direction, world.camera.up};
  for (std::size_t i = 0; place && i < count; ++i)
    place = beyond(world.space.portals.portals()[crossed[i]], *place);
  return place;
}

std::string as_toml(const CameraPlace& place, std::string_view blanks) {
  return fmt::format("{0}position = {1}\n{0}look_at = {2}\n{0}up = {3}\n", blanks,
                     list_of(place.position), list_of(place.look_at), list_of(place.up));
}

Json to_json(const CameraPlace& place) {
  return {{"position", to_json(place.position)},
          {"look_at", to_json(place.look_at)},
          {"up", to_json(place.up)}};
}

}  // namespace portalens
