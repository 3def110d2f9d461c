#include "shading/shade.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <variant>

#include "math/random.h"
#include "math/sobol.h"
#include "shading/lamp_share.h"
#include "shading/shading_point.h"

namespace portalens {
namespace {

/// What a photon's random key is combined with, so that no number is used twice. Small numbers are
/// left to whoever makes the photon.
constexpr std::uint64_t mirror_purpose = std::uint64_t{1} << 32;
constexpr std::uint64_t secondary_purpose = std::uint64_t{2} << 32;
constexpr std::uint64_t light_purpose = std::uint64_t{3} << 32;  // + index of the light

/// The shading normal, bent where a mirror with it would send what leaves along `out` below the
/// surface: then it sends it just over it.
Vec3d mirroring_normal(Vec3d normal, Vec3d outward, Vec3d out) {
  constexpr double least_height = 1e-2;
  const Vec3d mirrored = normal * (2.0 * dot(normal, out)) - out;
  const double height = dot(mirrored, outward);
  if (height > 0.0) return normal;
  return normalize(out + normalize(mirrored + outward * (least_height - height)));
}

/// Shades arrivals, one at a time. The path that most of them go is inlined as a whole, and what
/// few ask for is kept out of it, with a copy of the shading point: so this need not lie in memory.
class Shader {
 public:
  Shader(const Space& space, const Appearance& appearance, ShadeOutput& output)
      : space_(space),
        appearance_(appearance),
        points_(space, appearance),
        output_(output),
        beyond_all_(4.0 * space.extent) {}

  void take(const Photon& photon, const Arrival& arrival) {
    photon_ = &photon;
    arrival_ = &arrival;
    share_ = photon.throughput * arrival.tint;
    switch (arrival.fate) {
      case Fate::hit:
        return shade_surface();
      case Fate::escaped:
        return add_light(share_ * sky());
      case Fate::lost:
        // In an endless corridor: what would be seen at its end.
        if (arrival.out_of_crossings && !appearance_.limits.lost_color_given)
          return add_light(share_ * appearance_.environment.radiance(arrival_->direction));
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

  [[nodiscard]] Rgb sky() const {
    return photon_->density > 0.0 ? shared_sky(appearance_, *photon_, *arrival_)
                                  : appearance_.environment.radiance(arrival_->direction);
  }

  void shade_surface() {
    if (const Quad* quad = points_.plain_quad(*arrival_))
      shade_place(points_.on(*quad, *arrival_));
    else
      shade_other();
  }

  [[gnu::noinline]] void shade_other() { shade_place(points_.at(*arrival_)); }

  [[gnu::always_inline]] void shade_place(const ShadedSurface& place) {
    const Material& material = appearance_.materials[place.point.material];
    Rgb emitted = material.emitted_at(place.surface, arrival_->direction);
    if (photon_->density > 0.0)
      emitted = emitted * share_of_photon(appearance_, *photon_, *arrival_);
    std::visit(
        [&](const auto& bsdf) __attribute__((always_inline)) {
          shade_point(place.point, bsdf.at(place.surface), emitted, bsdf.sends());
        },
        material.bsdf());
  }

  /// @param bsdf  at that point
  template <class Here>
  [[gnu::always_inline]] void shade_point(const ShadingPoint& point, const Here& bsdf, Rgb emitted,
                                          bool sends) {
    const Rgb albedo = bsdf.albedo(point.normal, -arrival_->direction);
    add_light(share_ * (emitted + albedo * appearance_.limits.ambient));
    if (HasGlossy<Here> || !is_black(share_ * albedo)) ask_lights(point, bsdf);
    if (sends && may_bounce()) send_sampled(point, bsdf);
  }

  [[nodiscard]] bool may_bounce() const {
    return photon_->bounces < appearance_.limits.max_bounces;
  }

  template <class Here>
  [[gnu::noinline]] void send_sampled(ShadingPoint point, Here bsdf) {
    const auto [u1, u2] =
        sobol_pair(combined(photon_->random_key, mirror_purpose), photon_->pixel_sample);
    const Vec3d out = -arrival_->direction;
    const Vec3d normal = mirroring_normal(point.normal, point.outward, out);
    const auto sample = bsdf.sample(normal, out, u1, u2);
    if (!sample || !(dot(sample->direction, point.outward) > 0.0)) return;
    Photon secondary;
    secondary.throughput = share_ * sample->color * sample->weight;
    if (is_black(secondary.throughput)) return;
    secondary.position = point.position;
    secondary.direction = sample->direction;
    secondary.sample = photon_->sample;
    secondary.slot = photon_->slot;
    secondary.bounces = photon_->bounces + 1;
    secondary.pixel_sample = photon_->pixel_sample;
    secondary.random_key = combined(photon_->random_key, secondary_purpose);
    secondary.guard = point.leaving(sample->direction);
    secondary.density = sample->density;
    output_.secondary.push_back(secondary);
  }

  template <class Here>
  [[gnu::always_inline]] void ask_lights(const ShadingPoint& point, const Here& bsdf) {
    for (std::size_t i = 0; i < appearance_.lights.size(); ++i)
      std::visit(
          [&](const auto& light) __attribute__((always_inline)) {
            if constexpr (std::decay_t<decltype(light)>::is_delta)
              ask_light(point, bsdf, light, 0.0, 0.0, 1.0);
            else
              ask_large(point, bsdf, light, i);
          },
          appearance_.lights[i]);
  }

  /// A light that one sample does not tell.
  template <class Here, class Any>
  [[gnu::noinline]] void ask_large(ShadingPoint point, Here bsdf, const Any& light,
                                   std::size_t index) {
    const std::uint32_t count = appearance_.limits.shadow_samples;
    const std::uint64_t key = combined(photon_->random_key, light_purpose + index);
    // One sequence over all samples of the pixel, each of which takes the next `count` of it.
    for (std::uint32_t j = 0; j < count; ++j) {
      const auto [u1, u2] = sobol_pair(key, photon_->pixel_sample * count + j);
      ask_light(point, bsdf, light, u1, u2, count);
    }
  }

  /// How a sample of a light is drawn.
  struct Drawn {
    double count;        ///< of the samples that it is one of
    double density = 0;  ///< where photons find it, too
  };
  template <class Here, class Any>
  [[nodiscard]] static double density_for(const Here&, const Any& light, const LightSample& sample,
                                          Vec3d from) {
    if constexpr (HasGlossy<Here>)
      return density_of(light, sample, from);
    else
      return 0.0;
  }

  /// @param count  of the samples that this is one of
  template <class Here, class Any>
  [[gnu::always_inline]] void ask_light(const ShadingPoint& point, const Here& bsdf,
                                        const Any& light, double u1, double u2, double count) {
    const LightSample sample = light.sample(point.lit_at(), u1, u2);
    ask(point, bsdf, sample, {count, density_for(bsdf, light, sample, point.lit_at())}, {1, 1, 1},
        no_portal);
    if (!space_.portals.portals().empty()) ask_images(point, bsdf, light, u1, u2, count);
  }

  /// Its images in the portals.
  template <class Here, class Any>
  [[gnu::noinline]] void ask_images(ShadingPoint point, Here bsdf, const Any& light, double u1,
                                    double u2, double count) {
    const std::span<const Portal> portals = space_.portals.portals();
    for (std::uint32_t i = 0; i < portals.size(); ++i) {
      const Portal& portal = portals[i];
      const Rigid* motion = portal.motion();
      if (!motion) continue;
      const double height = portal.frame.to_local(point.lit_at()).z;
      if (height < -portal.height_tolerance() && !portal.two_sided) continue;
      const Vec3d seen_from = motion->move(point.lit_at());
      LightSample image = light.sample(seen_from, u1, u2);
      const Drawn drawn{count, density_for(bsdf, light, image, seen_from)};
      image.position =
          image.distant ? motion->rotate_back(image.position) : motion->move_back(image.position);
      if (crosses(i, point, end_of(image, point))) ask(point, bsdf, image, drawn, portal.tint, i);
    }
  }

  /// Where the straight path to a light's point ends: to one that is infinitely far, beyond all
  /// that may be in the way, on this side of a portal and on the other.
  [[nodiscard]] Vec3d end_of(const LightSample& sample, const ShadingPoint& point) const {
    return sample.distant ? point.lit_at() + sample.position * beyond_all_ : sample.position;
  }

  /// Whether the straight path from the point goes through the portal's face: from front to back,
  /// or either way if it is two-sided. In the plane of the face it leaves nothing is crossed.
  bool crosses(std::uint32_t portal, const ShadingPoint& point, Vec3d to) const {
    const Portal& crossed = space_.portals.portals()[portal];
    const Vec3d from = point.lit_at();
    const double distance = length(to - from);
    const Ray ray{from, (to - from) / distance};
    const double slope = dot(ray.direction, crossed.frame.normal);
    if (!(slope < 0.0) && !crossed.two_sided) return false;
    const auto contact = space_.portals.contact_near(portal, ray, distance);
    if (!contact || *contact * std::fabs(slope) < -crossed.height_tolerance()) return false;
    const LeftPlane left = space_.surfaces.flush().left_by(point.leaving_to_light(ray.direction));
    const PortalPlane& plane = space_.portals.plane_of(portal);
    return plane.plane != left.plane || !(slope * plane.side * left.side > 0.0) ||
           *contact > left.reach;
  }

  template <class Here>
  [[gnu::always_inline]] void ask(const ShadingPoint& point, const Here& bsdf,
                                  const LightSample& sample, const Drawn& drawn, Rgb tint,
                                  std::uint32_t portal) {
    const Vec3d from = point.lit_at(), way = sample.way_from(from);
    if (!(dot(way, point.outward) > 0.0) && !point.bulges()) return;
    const Rgb value = answer_of(point, bsdf, normalize(way), drawn);
    const Rgb share = share_ * value / std::numbers::pi / drawn.count * tint;
    const Rgb light = share * irradiance(sample, from, point.normal);
    if (is_black(light)) return;
    ShadowQuery& query = output_.shadows.emplace_back();
    query.from = from;
    query.to = end_of(sample, point);
    query.portal = portal;
    query.guard = point.leaving_to_light(way);
    query.contribution = light;
    query.sample = photon_->sample;
    query.slot = photon_->slot;
  }

  /// What the surface gives of light along `in`; of what photons find, too, the lamps' share.
  template <class Here>
  [[gnu::always_inline]] Rgb answer_of(const ShadingPoint& point, const Here& bsdf, Vec3d in,
                                       const Drawn& drawn) const {
    const Vec3d out = -arrival_->direction;
    Rgb value = bsdf.value(point.normal, out, in);
    if constexpr (HasGlossy<Here>) {
      const Glossy glossy =
          bsdf.glossy(mirroring_normal(point.normal, point.outward, out), out, in);
      // What no photon follows is the lamps'.
      const double other = may_bounce() ? glossy.density : 0.0;
      value += glossy.value * share_of(drawn.count * drawn.density, other);
    }
    return value;
  }

  const Space& space_;
  const Appearance& appearance_;
  ShadingPoints points_;
  ShadeOutput& output_;
  const Photon* photon_ = nullptr;
  const Arrival* arrival_ = nullptr;
  Rgb share_;          ///< of what is here that reaches the film
  double beyond_all_;  ///< a length: no way from one thing to another is half as long
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
    return std::visit([](const auto& one) { return !one.is_delta; }, light);
  };
  const auto sends = [](const Material& material) {
    return std::visit([](const auto& bsdf) { return bsdf.sends(); }, material.bsdf());
  };
  return std::any_of(appearance.lights.begin(), appearance.lights.end(), is_large) ||
         std::any_of(appearance.materials.begin(), appearance.materials.end(), sends);
}

std::size_t max_shadow_queries(const Space& space, const Appearance& appearance) {
  std::size_t samples = 0;
  for (const Light& light : appearance.lights)
    samples += std::visit([](const auto& one) { return one.is_delta; }, light)
                   ? 1
                   : appearance.limits.shadow_samples;
  return samples * (1 + space.portals.portals().size());
}

}  // namespace portalens
