/// \file
/// The surface of glTF 2.0: a metal, or something else under a mirroring skin, or a mixture.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "shading/bsdf_sample.h"
#include "shading/ggx_albedo.h"
#include "shading/texture.h"

namespace portalens {

/// Microfacets of GGX with Schlick's Fresnel factor; over a diffuse ground, where it is no metal.
/// It keeps energy: what bounces between the microfacets is given back, and the ground gets what
/// the skin lets through (Kulla and Conty 2017), so that white gives back all it gets. What it
/// mirrors, lamps are asked for and photons find.
class MetallicRoughness {
 public:
  static constexpr std::string_view name = "metallic-roughness";
  /// Keys base_color: a texture; metallic, roughness: 0 to 1; ior: at least 1.
  static MetallicRoughness from(Parameters& parameters, const ImageLoader& load);
  /// @param base_color  of the ground, and of what a metal mirrors
  /// @param ior         of what is no metal: the skin mirrors ((ior - 1) / (ior + 1))² of what
  /// comes
  ///                    straight
  explicit MetallicRoughness(Texture base_color = Constant{{1, 1, 1}}, double metallic = 0.0,
                             double roughness = 0.5, double ior = 1.5);

  [[nodiscard]] std::vector<const Texture*> textures() const { return {&base_color_}; }
  /// At a grazing angle all of it.
  [[nodiscard]] Rgb max_reflected() const;
  [[nodiscard]] Rgb color() const { return brightest(base_color_); }
  [[nodiscard]] bool answers() const { return true; }
  [[nodiscard]] bool sends() const { return true; }

  class Here;
  [[nodiscard]] Here at(const SurfacePoint& point) const;

 private:
  Texture base_color_;
  double metallic_;   ///< share of metal
  double roughness_;  ///< α = roughness²
  double skin_;       ///< F0 of what is no metal
};

class MetallicRoughness::Here {
 public:
  Here(Rgb base_color, double metallic, double roughness, double skin);

  [[nodiscard]] Rgb albedo(Vec3d normal, Vec3d out) const;
  [[nodiscard]] Rgb value(Vec3d normal, Vec3d out, Vec3d in) const;
  [[nodiscard]] std::optional<BsdfSample> sample(Vec3d normal, Vec3d out, double u1,
                                                 double u2) const;
  [[nodiscard]] Glossy glossy(Vec3d normal, Vec3d out, Vec3d in) const;
  [[nodiscard]] Rgb glossy_albedo(Vec3d normal, Vec3d out) const;

 private:
  /// Polished: all of a direction comes from one other.
  [[nodiscard]] bool is_polished() const { return alpha_ < 1e-4; }
  [[nodiscard]] Rgb fresnel(double cosine) const;
  [[nodiscard]] double skin_albedo(const GgxAlbedo& albedo) const;
  [[nodiscard]] Glossy glossy_within(Vec3d out, Vec3d in) const;

  Rgb ground_;                ///< reflectance of the diffuse ground
  Rgb f0_;                    ///< what is mirrored of light that comes straight
  Rgb again_;                 ///< of what bounces between the microfacets, the share that comes out
  double skin_, skin_again_;  ///< the same two, of what is no metal
  double roughness_, alpha_;
  GgxAlbedo mean_;
};

}  // namespace portalens
