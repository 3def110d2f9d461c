#include "shading/shade.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "math/random.h"
#include "shading/reflection.h"
#include "shading/shading_point.h"

namespace portalens {
namespace {

/// What a photon's random key is combined with, so that no number is used twice. Small numbers are
/// left to whoever makes the photon.
constexpr std::uint64_t mirror_purpose = std::uint64_t{1} << 32;
constexpr std::uint64_t secondary_purpose = std::uint64_t{2} << 32;
constexpr std::uint64_t light_purpose = std::uint64_t{3} << 32;  // + index of the light

/// One comparison in place of three.
bool is_black(Rgb light) {
  return std::fabs(light.x) + std::fabs(light.y) + std::fabs(light.z) == 0.0;
}

/// The cells of a grid over the unit square, as square as their number allows.
struct Strata {
  std::uint32_t columns = 1, rows = 1;

  explicit Strata(std::uint32_t count) {
    for (std::uint32_t i = 1; i * i <= count; ++i)
      if (count % i == 0) rows = i;
    columns = count / rows;
  }
};

/// Shades arrivals, one at a time. The path that most of them go is inlined as a whole, and what
/// few ask for is kept out of it, with a copy of the shading point: so this need not lie in memory.
class Shader {
 public:
  Shader(const Space& space, const Appearance& appearance, ShadeOutput& output)
      : space_(space), appearance_(appearance), points_(space, appearance), output_(output) {}

  void take(const Photon& photon, const Arrival& arrival) {
    photon_ = &photon;
    arrival_ = &arrival;
    share_ = photon.throughput * arrival.tint;
    switch (arrival.fate) {
      case Fate::hit:
        return shade_surface();
      case Fate::escaped:
        return add_light(share_ * appearance_.environment.radiance(arrival_->direction));
      case Fate::lost:
        // Tints are left out, so that light lost between two dark portals still shows.
        return add_light(photon_->throughput * appearance_.limits.lost_color);
      case Fate::absorbed:
      case Fate::trapped:
        return;
    }
  }

 private:
  void add_light(Rgb radiance) {
    if (is_black(radiance)) return;
    Contribution& contribution = output_.light.emplace_back();
    contribution.radiance = radiance;
    contribution.sample = photon_->sample;
    contribution.slot = photon_->slot;
  }

  void shade_surface() {
    if (const Quad* quad = points_.plain_quad(*arrival_))
      shade_point(points_.on(*quad, *arrival_));
    else
      shade_other();
  }

  [[gnu::noinline]] void shade_other() { shade_point(points_.at(*arrival_)); }

  [[gnu::always_inline]] void shade_point(const ShadingPoint& point) {
    const Material& material = appearance_.materials[point.material];
    add_light(share_ * (material.emitted + point.diffuse * appearance_.limits.ambient));
    const Rgb reflected = share_ * point.diffuse;
    if (!is_black(reflected)) ask_lights(point, reflected / std::numbers::pi);
    const Rgb mirrored = share_ * material.reflective;
    if (!is_black(mirrored) && photon_->bounces < appearance_.limits.max_bounces)
      send_mirrored(point, mirrored, material.roughness);
  }

  [[gnu::noinline]] void send_mirrored(ShadingPoint point, Rgb share, double roughness) {
    const std::uint64_t key = combined(photon_->random_key, mirror_purpose);
    const auto reflection = reflect(arrival_->direction, point.normal, roughness,
                                    random_number(key, 0), random_number(key, 1));
    if (!reflection || !(dot(reflection->direction, point.outward) > 0.0)) return;
    Photon secondary;
    secondary.position = point.position;
    secondary.direction = reflection->direction;
    secondary.throughput = share * reflection->weight;
    secondary.sample = photon_->sample;
    secondary.slot = photon_->slot;
    secondary.bounces = photon_->bounces + 1;
    secondary.random_key = combined(photon_->random_key, secondary_purpose);
    secondary.guard = point.leaving(reflection->direction);
    output_.secondary.push_back(secondary);
  }

  [[gnu::always_inline]] void ask_lights(const ShadingPoint& point, Rgb share) {
    for (std::size_t i = 0; i < appearance_.lights.size(); ++i) {
      if (const auto* lamp = std::get_if<PointLight>(&appearance_.lights[i]))
        ask_light(point, lamp->sample(0.0, 0.0), share);
      else
        ask_large(point, i, share);
    }
  }

  /// A light that has an area.
  [[gnu::noinline]] void ask_large(ShadingPoint point, std::size_t index, Rgb share) {
    const Light& light = appearance_.lights[index];
    const std::uint32_t count = sample_count(light, appearance_.limits.shadow_samples);
    const std::uint64_t key = combined(photon_->random_key, light_purpose + index);
    const Strata strata(count);
    for (std::uint32_t j = 0; j < count; ++j) {
      const double u1 = (j % strata.columns + random_number(key, 2 * j)) / strata.columns;
      const double u2 = (j / strata.columns + random_number(key, 2 * j + 1)) / strata.rows;
      ask_light(point, sample_light(light, u1, u2), share / count);
    }
  }

  void ask_light(const ShadingPoint& point, const LightSample& sample, Rgb share) {
    ask(point, sample, share, no_portal);
    if (!space_.portals.portals().empty()) ask_images(point, sample, share);
  }

  /// Its images in the portals.
  [[gnu::noinline]] void ask_images(ShadingPoint point, LightSample sample, Rgb share) {
    const std::span<const Portal> portals = space_.portals.portals();
    for (std::uint32_t i = 0; i < portals.size(); ++i) {
      const Portal& portal = portals[i];
      const double height = portal.frame.to_local(point.position).z;
      if (height < -portal.height_tolerance() && !portal.two_sided) continue;
      LightSample image = sample;
      image.position = portal.through.move_back(sample.position);
      image.normal = portal.through.rotate_back(sample.normal);
      if (crosses(i, point, image.position)) ask(point, image, share * portal.tint, i);
    }
  }

  /// Whether the straight path from the point goes through the portal's face: from front to back,
  /// or either way if it is two-sided. In the plane of the face it leaves nothing is crossed.
  bool crosses(std::uint32_t portal, const ShadingPoint& point, Vec3d to) const {
    const Portal& crossed = space_.portals.portals()[portal];
    const double distance = length(to - point.position);
    const Ray ray{point.position, (to - point.position) / distance};
    const double slope = dot(ray.direction, crossed.frame.normal);
    if (!(slope < 0.0) && !crossed.two_sided) return false;
    const auto contact = space_.portals.contact_near(portal, ray, distance);
    if (!contact || *contact * std::fabs(slope) < -crossed.height_tolerance()) return false;
    const LeftPlane left = space_.surfaces.flush().left_by(point.leaving(ray.direction));
    const PortalPlane& plane = space_.portals.plane_of(portal);
    return plane.plane != left.plane || !(slope * plane.side * left.side > 0.0) ||
           *contact > left.reach;
  }

  [[gnu::always_inline]] void ask(const ShadingPoint& point, const LightSample& sample, Rgb share,
                                  std::uint32_t portal) {
    if (!(dot(sample.position - point.position, point.outward) > 0.0)) return;
    const Rgb light = share * irradiance(sample, point.position, point.normal);
    if (is_black(light)) return;
    ShadowQuery& query = output_.shadows.emplace_back();
    query.from = point.position;
    query.to = sample.position;
    query.portal = portal;
    query.guard = point.leaving(sample.position - point.position);
    query.contribution = light;
    query.sample = photon_->sample;
    query.slot = photon_->slot;
  }

  const Space& space_;
  const Appearance& appearance_;
  ShadingPoints points_;
  ShadeOutput& output_;
  const Photon* photon_ = nullptr;
  const Arrival* arrival_ = nullptr;
  Rgb share_;  ///< of what is here that reaches the film
};

}  // namespace

void shade(const Space& space, const Appearance& appearance, std::span<const Photon> photons,
           std::span<const Arrival> arrivals, ShadeOutput& output) {
  assert(photons.size() == arrivals.size());
  Shader shader(space, appearance, output);
  for (std::size_t i = 0; i < photons.size(); ++i) shader.take(photons[i], arrivals[i]);
}

bool uses_random_numbers(const Appearance& appearance) {
  const auto is_large = [](const Light& light) {
    return !std::holds_alternative<PointLight>(light);
  };
  const auto mirrors = [](const Material& material) { return material.reflective != Rgb{}; };
  return std::any_of(appearance.lights.begin(), appearance.lights.end(), is_large) ||
         std::any_of(appearance.materials.begin(), appearance.materials.end(), mirrors);
}

std::size_t max_shadow_queries(const Space& space, const Appearance& appearance) {
  std::size_t samples = 0;
  for (const Light& light : appearance.lights)
    samples += sample_count(light, appearance.limits.shadow_samples);
  return samples * (1 + space.portals.portals().size());
}

}  // namespace portalens
