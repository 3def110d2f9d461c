/// \file
/// Triangles that shine, each of which is chosen with a probability in proportion to its power.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "math/vec3.h"
#include "shading/texture.h"

namespace portalens {

using TriangleCorners = std::array<Vec3d, 3>;

class TriangleChoice {
 public:
  /// @param brightness  about its radiance; > 0
  void add(const TriangleCorners& corners, double brightness);
  [[nodiscard]] std::size_t size() const { return brightness_.size(); }
  [[nodiscard]] double area() const { return area_; }

  /// A point of one of them. Within a triangle all are as likely.
  struct Point {
    std::size_t triangle = 0;
    double second = 0.0, third = 0.0;  ///< its weights of those corners
    double by_density = 0.0;           ///< 1 over the probability per area

    [[nodiscard]] Vec3d on(const TriangleCorners& t) const {
      return t[0] + (t[1] - t[0]) * second + (t[2] - t[0]) * third;
    }
  };
  /// @pre there is one
  [[nodiscard]] Point choose(double u1, double u2) const;

 private:
  std::vector<double> brightness_;
  std::vector<double> power_up_to_;  ///< up to and with each triangle
  double area_ = 0.0;
};

[[nodiscard]] double area_of(const TriangleCorners& corners);

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
