/// \file
/// An ellipse (a circle is one) as the face of a portal. Ours; equations.md, sec. 4.
///
/// The nearest point of its rim, (a cos θ, b sin θ), is where the distance is stationary in θ:
///     D(θ) = (b² - a²) sin θ cos θ + a x sin θ - b y cos θ = 0
/// which is Newton's method with the unit vector (cos θ, sin θ) turned by each step.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "portal/face_input.h"
#include "portal/plane_edge.h"

namespace portalens {

/// About the origin, with radii `a` along x and `b` along y.
class Ellipse {
 public:
  static constexpr std::string_view name = "ellipse";
  static constexpr bool curved = true;

  /// @pre both above 0
  Ellipse(double a, double b) : a_(a), b_(b) {}
  [[nodiscard]] static std::optional<Ellipse> from(const FaceInput& input);
  [[nodiscard]] Ellipse carried(const std::vector<Vec3d>&) const { return *this; }

  [[nodiscard]] bool within(double x, double y, double slack) const {
    const double u = x / (a_ + slack), v = y / (b_ + slack);
    return u * u + v * v <= 1.0;
  }
  [[nodiscard]] bool covers(double x, double y) const { return within(x, y, 0.0); }
  /// An edge: the rim. Behind the face two of its places are equally near at the middle line, so
  /// there its halves count as two.
  [[nodiscard]] Feature nearest(Vec3d local, double tolerance) const;
  [[nodiscard]] Feature follow(Feature feature, Vec3d local) const;
  [[nodiscard]] Vec3d place(Feature feature, Vec3d local) const;
  [[nodiscard]] Pace pace(Feature feature, Vec3d local) const;
  [[nodiscard]] double distance_to_discontinuity(Vec3d local, double tolerance) const;
  [[nodiscard]] double still(Feature, Vec3d) const { return 0.0; }

  [[nodiscard]] std::vector<PlaneEdge> edges() const { return {}; }  ///< none of them is straight
  template <class Layout>
  void lay_out(Layout& layout) const {
    layout.ellipse(a_, b_);
  }
  /// Touches it in as many points as it has corners.
  [[nodiscard]] std::vector<Vec3d> outline() const;
  [[nodiscard]] std::vector<std::vector<Vec3d>> pieces() const { return {outline()}; }
  [[nodiscard]] std::vector<std::vector<Vec3d>> gaps() const { return {}; }
  [[nodiscard]] PlaneBox box() const { return {-a_, -b_, a_, b_}; }
  [[nodiscard]] double size() const { return 2.0 * std::fmax(a_, b_); }
  [[nodiscard]] double area() const;
  [[nodiscard]] double mismatch(const Ellipse& pair) const {
    return std::fmax(std::fabs(a_ - pair.a_), std::fabs(b_ - pair.b_)) / size();
  }

  [[nodiscard]] double a() const { return a_; }
  [[nodiscard]] double b() const { return b_; }

 private:
  /// Half the length of the line behind the face from which two places of the rim are as near: on
  /// the longer axis.
  [[nodiscard]] double middle_line() const {
    return std::fabs(a_ * a_ - b_ * b_) / std::fmax(a_, b_);
  }
  /// D and its derivative.
  [[nodiscard]] std::array<double, 2> slope(double x, double y, double cosine, double sine) const;
  /// From an angle down to where the distance is least about it.
  void descend(double x, double y, double& cosine, double& sine) const;

  double a_, b_;
};

}  // namespace portalens
