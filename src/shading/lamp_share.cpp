#include "shading/lamp_share.h"

namespace portalens {
namespace {

/// The photon's share of light that `shadow_samples` draw with that density.
double share_beside(const Appearance& appearance, const Photon& photon, double density) {
  return share_of(photon.density, appearance.limits.shadow_samples * density);
}

}  // namespace

double share_of_photon(const Appearance& appearance, const Photon& photon, const Arrival& arrival) {
  // Through several portals, and of the backs of portals, nothing is asked.
  if (arrival.met != Met::surface || arrival.crossings > 1) return 1.0;
  const double area = appearance.bodies[arrival.object].found_area;
  if (!(area > 0.0)) return 1.0;
  return share_beside(appearance, photon, density_of_points(area, arrival.length));
}

Rgb shared_sky(const Appearance& appearance, const Photon& photon, const Arrival& arrival) {
  const Environment& sky = appearance.environment;
  if (arrival.crossings > 1) return sky.radiance(arrival.direction);
  Rgb seen = sky.radiance_beside_discs(arrival.direction);
  if (appearance.sky_light) {
    const auto& light = std::get<SkyLight>(appearance.lights[*appearance.sky_light]);
    seen = seen * share_beside(appearance, photon, light.density(arrival.direction));
  }
  for (const SkyDisc& disc : sky.discs)
    if (disc.is_seen_in(arrival.direction))
      seen += disc.radiance * share_beside(appearance, photon, disc.density());
  return seen;
}

}  // namespace portalens
