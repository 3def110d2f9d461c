/// \file
/// Triangles that shine, drawn in proportion to their light.
#pragma once

#include <cstddef>
#include <vector>

#include "math/triangle_sample.h"
#include "shading/texture.h"

namespace portalens {

/// A few triangles are chosen by how much of their light a place gets, of many each by its power;
/// within a triangle all directions that it is seen in are as likely.
class TriangleChoice {
 public:
  /// @param brightness  about its radiance; > 0
  void add(const TriangleCorners& corners, double brightness);
  [[nodiscard]] std::size_t size() const { return triangles_.size(); }
  [[nodiscard]] const TriangleCorners& operator[](std::size_t i) const { return triangles_[i]; }
  [[nodiscard]] double area() const { return area_; }

  /// A point of one of them, as seen from `x`.
  /// @pre there is one
  [[nodiscard]] SeenPoint choose(Vec3d x, double u1, double u2) const;

 private:
  [[nodiscard]] FewWeights::Choice by_power(double u) const;

  std::vector<TriangleCorners> triangles_;
  std::vector<double> brightness_;
  std::vector<double> power_up_to_;  ///< up to and with each triangle
  double area_ = 0.0;
};

/// The mean of what is found in the middles of `parts`² equal parts of a triangle.
template <class Find>
[[nodiscard]] Rgb mean_over(const TriangleCorners& t, int parts, const Find& find) {
  const Vec3d right = (t[1] - t[0]) / (3.0 * parts), up = (t[2] - t[0]) / (3.0 * parts);
  Rgb sum;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j) {
      sum += find(t[0] + right * (3 * i + 1) + up * (3 * j + 1));
      if (i + j + 1 < parts) sum += find(t[0] + right * (3 * i + 2) + up * (3 * j + 2));
    }
  return sum / (double{1} * parts * parts);
}

/// What `TriangleChoice` counts a triangle's light for. It is never 0, since nothing that might
/// shine may be left out.
/// @param find  its surface point at a place on it
template <class Find>
[[nodiscard]] double brightness_of(const Texture& emitted, const TriangleCorners& t,
                                   const Find& find) {
  constexpr int parts = 3;
  constexpr double share_of_brightest = 0.1;
  const double brightest_of_all = max_component(brightest(emitted));
  if (std::holds_alternative<Constant>(emitted)) return brightest_of_all;
  const Rgb mean = mean_over(t, parts, [&](Vec3d x) { return color_at(emitted, find(x)); });
  return share_of_brightest * brightest_of_all + (1.0 - share_of_brightest) * max_component(mean);
}

}  // namespace portalens
