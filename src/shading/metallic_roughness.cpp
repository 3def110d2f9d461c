#include "shading/metallic_roughness.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "shading/ggx.h"

namespace portalens {
namespace {

double fifth(double x) { return x * x * x * x * x; }

/// Of what bounces between the microfacets, the share that comes out: at each bounce the mean of
/// Schlick's factor is kept, and a part of it comes out.
double share_after_bounces(double f0, double mean_albedo) {
  const double mean_fresnel = f0 + (1.0 - f0) / 21.0;
  return mean_fresnel * mean_fresnel * mean_albedo / (1.0 - mean_fresnel * (1.0 - mean_albedo));
}

Vec3d lambert_direction(double u1, double u2) {
  const double radius = std::sqrt(u1), angle = 2.0 * std::numbers::pi * u2;
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0 - u1)};
}

}  // namespace

MetallicRoughness MetallicRoughness::from(Parameters& parameters, const ImageLoader& load) {
  Texture base_color = texture_from(parameters, "base_color", Constant{{1, 1, 1}}, load);
  const double metallic = parameters.number("metallic", unit_interval, 0.0);
  const double roughness = parameters.number("roughness", unit_interval, 0.5);
  return MetallicRoughness(std::move(base_color), metallic, roughness,
                           parameters.number("ior", Bounds{1.0, 1e6}, 1.5));
}

MetallicRoughness::MetallicRoughness(Texture base_color, double metallic, double roughness,
                                     double ior)
    : base_color_(std::move(base_color)),
      metallic_(metallic),
      roughness_(roughness),
      skin_(((ior - 1.0) / (ior + 1.0)) * ((ior - 1.0) / (ior + 1.0))) {}

Rgb MetallicRoughness::max_reflected() const {
  const Rgb most = brightest(base_color_);
  return {std::max(most.x, 1.0), std::max(most.y, 1.0), std::max(most.z, 1.0)};
}

MetallicRoughness::Here MetallicRoughness::at(const SurfacePoint& point) const {
  return {color_at(base_color_, point), metallic_, roughness_, skin_};
}

MetallicRoughness::Here::Here(Rgb base_color, double metallic, double roughness, double skin)
    : ground_(base_color * (1.0 - metallic)),
      f0_(base_color * metallic + Rgb{1, 1, 1} * (skin * (1.0 - metallic))),
      skin_(skin),
      roughness_(roughness),
      alpha_(roughness * roughness),
      mean_(ggx_mean_albedo(roughness)) {
  const auto of_metal = [&](double f0) { return share_after_bounces(f0, mean_.facing); };
  skin_again_ = of_metal(skin);
  again_ = Rgb{of_metal(base_color.x), of_metal(base_color.y), of_metal(base_color.z)} * metallic +
           Rgb{1, 1, 1} * (skin_again_ * (1.0 - metallic));
}

Rgb MetallicRoughness::Here::fresnel(double cosine) const {
  const double grazing = fifth(1.0 - std::clamp(cosine, 0.0, 1.0));
  return f0_ * (1.0 - grazing) + Rgb{1, 1, 1} * grazing;
}

double MetallicRoughness::Here::skin_albedo(const GgxAlbedo& albedo) const {
  return albedo.with(skin_) + skin_again_ * (1.0 - albedo.facing);
}

Rgb MetallicRoughness::Here::albedo(Vec3d normal, Vec3d out) const {
  return ground_ * (1.0 - skin_albedo(ggx_albedo(dot(normal, out), roughness_)));
}

/// What the skin lets through to the ground, spread by Lambert's law, and through the skin again:
/// the same seen from both sides.
Rgb MetallicRoughness::Here::value(Vec3d normal, Vec3d out, Vec3d in) const {
  const double there = dot(normal, in);
  if (!(there > 0.0)) return {};
  const auto through = [&](const GgxAlbedo& albedo) { return 1.0 - skin_albedo(albedo); };
  const double from = through(ggx_albedo(dot(normal, out), roughness_));
  const double to = through(ggx_albedo(there, roughness_));
  return ground_ * (from * to / std::max(1e-9, through(mean_)));
}

Glossy MetallicRoughness::Here::glossy_within(Vec3d out, Vec3d in) const {
  if (is_polished() || !(in.z > 0.0) || !(out.z > 0.0)) return {};
  const Vec3d half = normalize(out + in);
  const double lambda = ggx::smith_lambda(out, alpha_);
  const double facets = ggx::distribution(half, alpha_) / (4.0 * out.z);  // D / (4 cos)
  const double once = facets / in.z / (1.0 + lambda + ggx::smith_lambda(in, alpha_));
  const double here = 1.0 - ggx_albedo(out.z, roughness_).facing;
  const double there = 1.0 - ggx_albedo(in.z, roughness_).facing;
  const double again = here * there / std::max(1e-9, 1.0 - mean_.facing);
  Glossy glossy;
  glossy.value = fresnel(dot(out, half)) * (std::numbers::pi * once) + again_ * again;
  glossy.density = (1.0 - here) * facets / (1.0 + lambda) + here * in.z / std::numbers::pi;
  return glossy;
}

Glossy MetallicRoughness::Here::glossy(Vec3d normal, Vec3d out, Vec3d in) const {
  const Frame frame = ggx::frame_about(normal);
  return glossy_within(frame.direction_to_local(out), frame.direction_to_local(in));
}

Rgb MetallicRoughness::Here::glossy_albedo(Vec3d normal, Vec3d out) const {
  const GgxAlbedo albedo = ggx_albedo(dot(normal, out), roughness_);
  const Rgb once = f0_ * (albedo.facing - albedo.grazing) + Rgb{1, 1, 1} * albedo.grazing;
  return once + again_ * (1.0 - albedo.facing);
}

/// By chance either once off a microfacet, or as what has bounced between them: as likely as a
/// white surface would send light by each.
std::optional<BsdfSample> MetallicRoughness::Here::sample(Vec3d normal, Vec3d out, double u1,
                                                          double u2) const {
  const Frame frame = ggx::frame_about(normal);
  const Vec3d from = frame.direction_to_local(out);
  if (!(from.z > 0.0)) return std::nullopt;
  if (is_polished()) return BsdfSample{ggx::mirrored(-out, normal), fresnel(from.z), 1.0, 0.0};
  const double again = 1.0 - ggx_albedo(from.z, roughness_).facing;
  const Vec3d in =
      u1 < again ? lambert_direction(u1 / again, u2)
                 : ggx::mirrored(
                       -from, ggx::visible_normal(from, alpha_, (u1 - again) / (1.0 - again), u2));
  const Glossy glossy = glossy_within(from, in);
  if (!(glossy.density > 0.0)) return std::nullopt;
  return BsdfSample{normalize(frame.direction_to_world(in)),
                    glossy.value * (in.z / (std::numbers::pi * glossy.density)), 1.0,
                    glossy.density};
}

}  // namespace portalens
