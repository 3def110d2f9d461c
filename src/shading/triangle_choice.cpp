#include "shading/triangle_choice.h"

#include <algorithm>

namespace portalens {

void TriangleChoice::add(const TriangleCorners& corners, double brightness) {
  const double area = area_of(corners);
  area_ += area;
  triangles_.push_back(corners);
  brightness_.push_back(brightness);
  power_up_to_.push_back((power_up_to_.empty() ? 0.0 : power_up_to_.back()) + area * brightness);
}

FewWeights::Choice TriangleChoice::by_power(double u) const {
  const double wanted = u * power_up_to_.back();
  const auto found = std::upper_bound(power_up_to_.begin(), power_up_to_.end() - 1, wanted);
  const double before = found == power_up_to_.begin() ? 0.0 : *(found - 1);
  const double power = *found - before;
  return {static_cast<std::size_t>(found - power_up_to_.begin()), power / power_up_to_.back(),
          std::clamp((wanted - before) / power, 0.0, 1.0)};
}

SeenPoint TriangleChoice::choose(Vec3d x, double u1, double u2) const {
  FewWeights::Choice choice;
  if (size() <= FewWeights::max_count) {
    FewWeights weights;
    for (std::size_t i = 0; i < size(); ++i)
      weights.add(brightness_[i] * solid_angle_of(triangles_[i], x));
    if (!(weights.total() > 0.0)) return {triangles_[0][0]};
    choice = weights.choose(u1);
  } else {
    choice = by_power(u1);
  }
  const TriangleCorners& triangle = triangles_[choice.index];
  const SeenPoint seen = sample_triangle(triangle, solid_angle_of(triangle, x), x, choice.left, u2);
  return {seen.position, seen.solid_angle / choice.probability, choice.index};
}

}  // namespace portalens
