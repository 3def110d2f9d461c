#include "shading/ggx_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "shading/ggx.h"

namespace portalens {
namespace {

constexpr int count = 32;  // of roots of cosines, and of roughnesses: nodes from 0 to 1

GgxAlbedo mixed(const GgxAlbedo& a, const GgxAlbedo& b, double share) {
  return {a.facing + (b.facing - a.facing) * share, a.grazing + (b.grazing - a.grazing) * share};
}

/// One direction and roughness, by quadrature over the visible normals: of the angle about the view
/// it is periodic.
GgxAlbedo computed(double cosine, double roughness) {
  constexpr int radii = 24, angles = 24;
  const double alpha = roughness * roughness;
  const Vec3d out{std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
  const double lambda = ggx::smith_lambda(out, alpha);
  GgxAlbedo sum{0.0, 0.0};
  for (int i = 0; i < radii; ++i)
    for (int j = 0; j < angles; ++j) {
      const Vec3d half = ggx::visible_normal(out, alpha, (i + 0.5) / radii, (j + 0.5) / angles);
      const Vec3d in = ggx::mirrored(-out, half);
      if (!(in.z > 0.0)) continue;
      const double weight = (1.0 + lambda) / (1.0 + lambda + ggx::smith_lambda(in, alpha));
      sum.facing += weight;
      sum.grazing += weight * std::pow(1.0 - std::min(1.0, dot(out, half)), 5.0);
    }
  return {sum.facing / (radii * angles), sum.grazing / (radii * angles)};
}

/// The place of a number of [0, 1] among the nodes.
struct Place {
  std::size_t node = 0;
  double share = 0.0;  ///< of the next one
  explicit Place(double x) {
    const double scaled = std::clamp(x, 0.0, 1.0) * (count - 1);
    node = std::min(static_cast<std::size_t>(scaled), static_cast<std::size_t>(count - 2));
    share = scaled - static_cast<double>(node);
  }
};

class Tables {
 public:
  Tables() {
    constexpr double least_cosine = 1e-4;  // at 0 there is no limit: it depends on what goes first
    for (std::size_t r = 0; r < count; ++r) {
      const double roughness = static_cast<double>(r) / (count - 1);
      for (std::size_t c = 0; c < count; ++c) {
        const double root = static_cast<double>(c) / (count - 1);
        albedo_[r][c] = computed(std::max(root * root, least_cosine), roughness);
      }
      mean_[r] = mean_of(r);
    }
  }

  [[nodiscard]] GgxAlbedo albedo(double cosine, double roughness) const {
    const Place r(roughness), c(std::sqrt(std::clamp(cosine, 0.0, 1.0)));
    return mixed(of_row(r.node, c), of_row(r.node + 1, c), r.share);
  }
  [[nodiscard]] GgxAlbedo mean(double roughness) const {
    const Place r(roughness);
    return mixed(mean_[r.node], mean_[r.node + 1], r.share);
  }

 private:
  using Row = std::array<GgxAlbedo, count>;

  [[nodiscard]] GgxAlbedo of_row(std::size_t r, const Place& c) const {
    return mixed(albedo_[r][c.node], albedo_[r][c.node + 1], c.share);
  }
  /// ∫ 2 c A dc with c = t²: ∫ 4 t³ A dt, of an A that is linear in t between the nodes.
  [[nodiscard]] GgxAlbedo mean_of(std::size_t r) const {
    constexpr double width = 1.0 / (count - 1);
    GgxAlbedo sum{0.0, 0.0};
    for (std::size_t c = 0; c + 1 < count; ++c) {
      const double t = static_cast<double>(c) * width, end = t + width;
      const double all = std::pow(end, 4) - std::pow(t, 4);
      const double first_moment = 0.8 * (std::pow(end, 5) - std::pow(t, 5)) - t * all;
      const GgxAlbedo here = mixed(albedo_[r][c], albedo_[r][c + 1], first_moment / width / all);
      sum.facing += here.facing * all;
      sum.grazing += here.grazing * all;
    }
    return sum;
  }

  std::array<Row, count> albedo_;  ///< by roughness, then by the root of the cosine
  Row mean_;
};

/// They take a few hundredths of a second, and are made when they are first asked for.
const Tables& tables() {
  static const Tables made;
  return made;
}

}  // namespace

GgxAlbedo ggx_albedo(double cosine, double roughness) { return tables().albedo(cosine, roughness); }

GgxAlbedo ggx_mean_albedo(double roughness) { return tables().mean(roughness); }

}  // namespace portalens
