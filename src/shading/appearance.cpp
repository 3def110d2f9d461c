#include "shading/appearance.h"

namespace portalens {
namespace {

constexpr std::int64_t max_allowed_bounces = 1000;
constexpr std::int64_t max_shadow_samples = 1024;

Triple as_triple(Rgb color) { return {color.x, color.y, color.z}; }

}  // namespace

ShadingLimits ShadingLimits::from(Parameters& parameters) {
  ShadingLimits limits;
  limits.max_bounces = static_cast<std::uint32_t>(
      parameters.integer("max_bounces", 0, max_allowed_bounces, limits.max_bounces));
  limits.lost_color_given = parameters.has("lost_color");
  limits.lost_color =
      to_vec3(parameters.triple("lost_color", non_negative, as_triple(limits.lost_color)));
  limits.shadow_samples = static_cast<std::uint32_t>(
      parameters.integer("shadow_samples", 1, max_shadow_samples, limits.shadow_samples));
  limits.ambient = to_vec3(parameters.triple("ambient", non_negative, as_triple(limits.ambient)));
  return limits;
}

}  // namespace portalens
