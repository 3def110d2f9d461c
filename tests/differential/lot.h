/// \file
/// What scenes are drawn with: random numbers of the kinds that they need.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "math/frame.h"
#include "math/random.h"
#include "support/random.h"

namespace portalens::differential {

class Lot {
 public:
  Lot(std::uint64_t seed, std::uint64_t index) : random_(combined(mixed(seed), index)) {}

  [[nodiscard]] bool chance(double share) { return random_.uniform(0.0, 1.0) < share; }
  double uniform(double low, double high) { return random_.uniform(low, high); }
  /// As likely in each octave. @pre 0 < low < high
  double logarithmic(double low, double high) {
    return low * std::exp(random_.uniform(0.0, std::log(high / low)));
  }
  /// From `low` to `high`, both included.
  int whole(int low, int high) {
    return low + static_cast<int>(random_.bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  /// The place in the list of the weight that is drawn.
  int weighted(std::initializer_list<double> weights) {
    double sum = 0.0;
    for (const double weight : weights) sum += weight;
    double left = random_.uniform(0.0, sum);
    int place = 0;
    for (const double weight : weights) {
      left -= weight;
      if (left < 0.0) return place;
      ++place;
    }
    return place - 1;
  }
  Vec3d direction() { return random_.direction(); }
  Vec3d point(double size) { return random_.point(size); }
  /// A direction square to `normal`.
  Vec3d square_to(Vec3d normal) {
    Vec3d across = cross(normal, direction());
    while (length(across) < 0.1) across = cross(normal, direction());
    return normalize(across);
  }
  Frame frame(Vec3d origin, Vec3d normal) {
    const Vec3d right = square_to(normal);
    return {origin, right, cross(normal, right), normal};
  }
  Frame frame(Vec3d origin) { return frame(origin, direction()); }

 private:
  test::Random random_;
};

}  // namespace portalens::differential
