#include "gravity/portal_mass_coupling.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "gravity/attraction.h"
#include "gravity/decision_hash.h"

namespace portalens {

namespace {

bool within(const PortalMassCoupling::Image& image, Vec3d x) {
  const Vec3d to = image.center - x;
  return dot(to, to) < image.influence * image.influence;
}

}  // namespace

PortalMassCoupling::PortalMassCoupling(const CouplingInput& input) {
  if (input.depth == 0) return;
  for (std::uint32_t a = 0; a < input.portals.size(); ++a) {
    const Portal& portal = input.portals[a];
    const Vec3d beyond = input.portals[portal.pair].frame.origin;
    const double core2 = area_of(portal.aperture) / std::numbers::pi;
    double gm = 0.0;
    for (const Mass& mass : input.masses) {
      const Vec3d to_mass = mass.center - beyond;
      gm += mass.gm * core2 / (core2 + dot(to_mass, to_mass));
    }
    if (gm > 0.0)
      images_.push_back({portal.frame.origin, gm, core2, influence_radius(gm, input.min_force), a});
  }
}

CouplingCost PortalMassCoupling::cost(const CouplingInput& input) {
  return {input.depth > 0 ? static_cast<double>(input.portals.size()) : 0.0, 0.0};
}

Pull PortalMassCoupling::pull(Vec3d x, Vec3d anchor) const {
  Pull total;
  for (const Image& image : images_) {
    if (!within(image, anchor)) continue;
    const Vec3d to = image.center - x;
    const double inverse2 = 1.0 / (dot(to, to) + image.core2);
    total.acceleration += attraction(to, image.gm, image.core2);
    total.stiffness += image.gm * inverse2 * inverse2 * std::sqrt(inverse2);
    total.nearness += inverse2 * inverse2;
    total.gradient += 2.0 * image.gm * inverse2 * std::sqrt(inverse2);
    total.potential += image.gm * std::sqrt(inverse2);
  }
  return total;
}

double PortalMassCoupling::distance_to_discontinuity(Vec3d x) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Image& image : images_)
    least = std::min(least, std::fabs(length(image.center - x) - image.influence));
  return least;
}

std::vector<PullPart> PortalMassCoupling::parts(Vec3d x) const {
  std::vector<PullPart> found;
  for (const Image& image : images_) {
    if (!within(image, x)) continue;
    const Vec3d to = image.center - x;
    PullPart part;
    part.portals = {image.portal};
    part.acceleration = attraction(to, image.gm, image.core2);
    part.entrance = part.beyond = image.center;
    part.places = {image.center};
    part.distance = length(to);
    found.push_back(part);
  }
  return found;
}

std::uint64_t PortalMassCoupling::signature(Vec3d x) const {
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < images_.size(); ++i)
    if (within(images_[i], x)) total += mix_decision(0, i);
  return total;
}

double PortalMassCoupling::distance_to_support(Vec3d x) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Image& image : images_)
    least = std::min(least, std::max(0.0, length(image.center - x) - image.influence));
  return least;
}

}  // namespace portalens
