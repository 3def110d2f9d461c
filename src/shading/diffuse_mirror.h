/// \file
/// The paper's surface: Lambert's law, and a mirror, polished or rough.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "shading/bsdf_sample.h"
#include "shading/reflection.h"
#include "shading/texture.h"

namespace portalens {

/// Lamps are answered by the diffuse part alone: a mirror shows lamps, but throws no light on from
/// points, which no photon meets.
class DiffuseMirror {
 public:
  static constexpr std::string_view name = "diffuse-mirror";
  /// Keys diffuse, reflective: textures; roughness, 0 to 1.
  static DiffuseMirror from(Parameters& parameters, const ImageLoader& load);
  explicit DiffuseMirror(Texture diffuse = Constant{}, Texture reflective = Constant{{}},
                         double roughness = 0.0);

  [[nodiscard]] std::vector<const Texture*> textures() const { return {&diffuse_, &reflective_}; }
  [[nodiscard]] Rgb max_reflected() const { return brightest_sum(diffuse_, reflective_); }
  [[nodiscard]] Rgb color() const { return max_reflected(); }
  [[nodiscard]] bool answers() const { return diffuses_; }
  [[nodiscard]] bool sends() const { return mirrors_; }
  [[nodiscard]] double roughness() const { return roughness_; }

  class Here;
  [[nodiscard]] inline Here at(const SurfacePoint& point) const;

 private:
  Texture diffuse_;     ///< reflectance ρ of Lambert's law
  Texture reflective_;  ///< share of the mirrored radiance
  double roughness_;    ///< GGX with α = roughness²; 0: an exact mirror
  bool diffuses_;       ///< somewhere
  bool mirrors_;        ///< somewhere
};

class DiffuseMirror::Here {
 public:
  Here(Rgb diffuse, Rgb reflective, double roughness)
      : diffuse_(diffuse), reflective_(reflective), roughness_(roughness) {}

  [[nodiscard]] Rgb albedo(Vec3d /*normal*/, Vec3d /*out*/) const { return diffuse_; }
  [[nodiscard]] Rgb value(Vec3d /*normal*/, Vec3d /*out*/, Vec3d /*in*/) const { return diffuse_; }
  [[nodiscard]] std::optional<BsdfSample> sample(Vec3d normal, Vec3d out, double u1,
                                                 double u2) const {
    if (is_black(reflective_)) return std::nullopt;
    const auto reflection = reflect(-out, normal, roughness_, u1, u2);
    if (!reflection) return std::nullopt;
    return BsdfSample{reflection->direction, reflective_, reflection->weight};
  }

 private:
  Rgb diffuse_, reflective_;
  double roughness_;
};

inline DiffuseMirror::Here DiffuseMirror::at(const SurfacePoint& point) const {
  return {color_at(diffuse_, point), mirrors_ ? color_at(reflective_, point) : Rgb{}, roughness_};
}

}  // namespace portalens
