#include "gravity/mass_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "gravity/influence.h"

namespace portalens {
namespace {

/// To ask so many costs less than to choose among them.
constexpr std::size_t few_masses = 16;
/// Boxes reach no farther.
constexpr double farthest = 1e12;

}  // namespace

MassTree::MassTree(std::span<const Mass> masses) : every_(masses.size()) {
  std::iota(every_.begin(), every_.end(), 0u);
  double sum = 0.0;
  for (const std::uint32_t i : every_) {
    const Mass& mass = masses[i];
    // A little more than that far: distances are rounded elsewhere, too.
    const double reach = std::fmax(mass.influence, mass.horizon_radius) * (1.0 + 1e-9);
    spheres_.push_back({mass.center, mass.influence, reach});
    if (std::isfinite(mass.influence)) sum += mass.influence;
    if (mass.has_horizon() && mass.horizon_radius >= mass.influence) bare_horizons_.push_back(i);
    const double extent =
        reach + std::fmax(std::fabs(mass.center.x),
                          std::fmax(std::fabs(mass.center.y), std::fabs(mass.center.z)));
    (extent < farthest ? in_tree_ : beside_).push_back(i);
  }
  if (!masses.empty()) usual_ = 0.5 * sum / static_cast<double>(masses.size());
  if (masses.size() <= few_masses || !(usual_ > 0.0)) return;
  tree_.emplace(TreeBuilder(), static_cast<std::uint32_t>(in_tree_.size()),
                [&](std::uint32_t item) {
                  const Sphere& sphere = spheres_[in_tree_[item]];
                  return Box{sphere.center, sphere.center}.grown(sphere.reach);
                });
}

void MassTree::around(Vec3d x, double radius, std::vector<std::uint32_t>& out) const {
  if (few()) {
    out = every_;
    return;
  }
  out.clear();
  const double wide = radius * (1.0 + 1e-9);
  const auto consider = [&](std::uint32_t i) {
    const double far = spheres_[i].reach + wide;
    const Vec3d to_mass = spheres_[i].center - x;
    if (!(dot(to_mass, to_mass) > far * far)) out.push_back(i);
  };
  for (const std::uint32_t i : beside_) consider(i);
  const Box& bounds = tree_->bounds();
  if (bounds.distance(x) > 1e5 * bounds.diagonal()) {
    for (const std::uint32_t i : in_tree_) consider(i);
  } else {
    tree_->around(x, wide, [&](std::uint32_t item) {
      consider(in_tree_[item]);
      return wide;
    });
  }
  std::sort(out.begin(), out.end());
}

double MassTree::entry(const Ray& ray) const {
  double least = std::numeric_limits<double>::infinity();
  const auto meet = [&](std::uint32_t i) {
    least = std::min(least, entry_into(spheres_[i].center, spheres_[i].influence, ray));
  };
  for (const std::uint32_t i : tree_ ? beside_ : every_) meet(i);
  if (tree_)
    tree_->along(ray, 0.0, least, [&](std::uint32_t item) {
      meet(in_tree_[item]);
      return least;
    });
  return least;
}

}  // namespace portalens
