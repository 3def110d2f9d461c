#include "photon/vicinity.h"

#include <cmath>
#include <numeric>

namespace portalens {
namespace {

/// To hold so many costs less than to choose among them.
constexpr std::size_t few = 16;

}  // namespace

Vicinity::Vicinity(std::span<const Mass> masses) : every_(masses.size()) {
  std::iota(every_.begin(), every_.end(), 0u);
  double sum = 0.0;
  for (const Mass& mass : masses) {
    // A little more than that far: distances are rounded elsewhere, too.
    const double radius = std::fmax(mass.influence, mass.schwarzschild) * (1.0 + 1e-9);
    reaches_.push_back({mass.center, radius});
    if (std::isfinite(mass.influence)) sum += mass.influence;
  }
  if (!masses.empty()) usual_ = 0.5 * sum / static_cast<double>(masses.size());
  all_ = masses.size() <= few || !(usual_ > 0.0);
}

void Vicinity::gather(Vec3d x, double reach) {
  const double radius = reach + usual_;
  if (!around_.holds(x, radius) || around_.radius > 32.0 * radius)
    fill(around_, x, 4.0 * radius, every_);
  fill(near_, x, radius, around_.held);
}

void Vicinity::fill(Ball& ball, Vec3d x, double radius, std::span<const std::uint32_t> from) const {
  ball.center = x;
  ball.radius = radius;
  ball.held.clear();
  for (const std::uint32_t i : from) {
    const double far = reaches_[i].radius + radius * (1.0 + 1e-9);
    const Vec3d to_mass = reaches_[i].center - x;
    if (!(dot(to_mass, to_mass) > far * far)) ball.held.push_back(i);
  }
}

}  // namespace portalens
