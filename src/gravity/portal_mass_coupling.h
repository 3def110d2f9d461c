/// \file
/// `portal-mass`: each portal stands for one mass at its centroid. Dunigan & Pianta, sec. 8;
/// equations.md, sec. 5. The cheapest way and the crudest, kept to compare.
///
///     M_A = Σ M_i a² / (a² + d_i²),  a = sqrt(area / π) = core radius,  R = sqrt(G M_A / f)
///
/// with d_i the distance from the pair's centroid to mass i. Any depth above 0 counts as 1.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gravity/coupling_input.h"

namespace portalens {

class PortalMassCoupling {
 public:
  static constexpr std::string_view name = "portal-mass";
  static constexpr bool asks_motion = false;

  explicit PortalMassCoupling(const CouplingInput& input);
  [[nodiscard]] static CouplingCost cost(const CouplingInput& input);

  [[nodiscard]] Pull pull(Vec3d x, Vec3d anchor) const;
  [[nodiscard]] std::uint64_t signature(Vec3d x) const;
  template <class Layout>
  [[nodiscard]] std::string lay_out(Layout& layout) const {
    for (const Image& image : images())
      layout.mass(image.center, image.gm, image.core2, image.influence);
    return "";
  }
  [[nodiscard]] double distance_to_support(Vec3d x) const;
  [[nodiscard]] double distance_to_discontinuity(Vec3d x) const;
  /// One part a portal; all its places are the centroid.
  [[nodiscard]] std::vector<PullPart> parts(Vec3d x) const;

  /// A portal as a mass.
  struct Image {
    Vec3d center;
    double gm, core2, influence;
    std::uint32_t portal;
  };
  /// One entry a portal that acts at all.
  [[nodiscard]] const std::vector<Image>& images() const { return images_; }

 private:
  std::vector<Image> images_;
};

}  // namespace portalens
