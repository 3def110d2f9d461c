#include "shading/triangle_choice.h"

#include <algorithm>
#include <cmath>

namespace portalens {

double area_of(const TriangleCorners& t) { return 0.5 * length(cross(t[1] - t[0], t[2] - t[0])); }

void TriangleChoice::add(const TriangleCorners& corners, double brightness) {
  const double area = area_of(corners);
  area_ += area;
  brightness_.push_back(brightness);
  power_up_to_.push_back((power_up_to_.empty() ? 0.0 : power_up_to_.back()) + area * brightness);
}

TriangleChoice::Point TriangleChoice::choose(double u1, double u2) const {
  const double wanted = u1 * power_up_to_.back();
  const auto found = std::upper_bound(power_up_to_.begin(), power_up_to_.end() - 1, wanted);
  const double before = found == power_up_to_.begin() ? 0.0 : *(found - 1);
  const auto triangle = static_cast<std::size_t>(found - power_up_to_.begin());
  // What is left of u1 within its triangle is uniform again; then the square folds to a triangle.
  const double within = std::clamp((wanted - before) / (*found - before), 0.0, 1.0);
  const double root = std::sqrt(within);
  return {triangle, root * (1.0 - u2), root * u2, power_up_to_.back() / brightness_[triangle]};
}

}  // namespace portalens
