#include "portal/ellipse.h"

#include <algorithm>
#include <numbers>

namespace portalens {
namespace {

constexpr int corners = 128;

/// Turns a unit vector by the arc tangent of `by`.
void turn(double by, double& cosine, double& sine) {
  const double c = cosine - by * sine, s = sine + by * cosine;
  const double scale = 1.0 / std::sqrt(c * c + s * s);
  cosine = c * scale;
  sine = s * scale;
}

/// Where D vanishes between the axes, by Newton's method; where that leads out of what encloses the
/// place, by halving it.
/// @param slope  D and its derivative
template <class Slope>
void solve_in_quadrant(const Slope& slope, double& cosine, double& sine) {
  double low_c = 1.0, low_s = 0.0, high_c = 0.0, high_s = 1.0;
  for (int round = 0; round < 100; ++round) {
    const auto [first, second] = slope(cosine, sine);
    if (first == 0.0) return;
    (first < 0.0 ? low_c : high_c) = cosine;
    (first < 0.0 ? low_s : high_s) = sine;
    double c = cosine, s = sine;
    if (second > 0.0) turn(-first / second, c, s);
    const bool enclosed =
        second > 0.0 && low_c * s - low_s * c > 0.0 && c * high_s - s * high_c > 0.0;
    if (!enclosed) {
      c = low_c + high_c, s = low_s + high_s;
      turn(0.0, c, s);
    }
    const double moved = std::fabs(cosine * s - sine * c);
    cosine = c, sine = s;
    if (moved < 1e-16 || (enclosed && moved < 1e-9)) return;
  }
}

}  // namespace

std::optional<Ellipse> Ellipse::from(const FaceInput& input) {
  if (!(input.radii[0] > 0.0 && input.radii[1] > 0.0)) return std::nullopt;
  return Ellipse(input.radii[0], input.radii[1]);
}

std::array<double, 2> Ellipse::slope(double x, double y, double cosine, double sine) const {
  const double apart = (b_ - a_) * (b_ + a_);
  return {apart * sine * cosine + a_ * x * sine - b_ * y * cosine,
          apart * (cosine * cosine - sine * sine) + a_ * x * cosine + b_ * y * sine};
}

void Ellipse::descend(double x, double y, double& cosine, double& sine) const {
  const auto square = [&](double c, double s) {
    const double dx = a_ * c - x, dy = b_ * s - y;
    return dx * dx + dy * dy;
  };
  // No curvature of the square's half is greater.
  const double most = std::fabs(b_ * b_ - a_ * a_) + std::fabs(a_ * x) + std::fabs(b_ * y);
  double here = square(cosine, sine);
  for (int round = 0; round < 60; ++round) {
    const auto [first, second] = slope(x, y, cosine, sine);
    if (first == 0.0) return;
    const bool bowl = second > 1e-9 * most;
    double by = std::clamp(-first / (bowl ? second : most), -0.7, 0.7);
    double c = cosine, s = sine;
    turn(by, c, s);
    for (int k = 0; k < 8 && square(c, s) > here * (1.0 + 1e-14); ++k) {
      by *= 0.4;
      c = cosine, s = sine;
      turn(by, c, s);
    }
    cosine = c, sine = s;
    here = square(c, s);
    // The next step would be as the square of this one.
    if (std::fabs(by) < (bowl ? 1e-9 : 1e-15)) return;
  }
}

Feature Ellipse::nearest(Vec3d local, double tolerance) const {
  if (local.z >= -tolerance && covers(local.x, local.y)) return {Feature::Kind::face, 0};
  // The nearest place lies in the quadrant of the point, where D vanishes once and grows. The start
  // is right on the rim and near the middle line, and not far off elsewhere.
  const double x = std::fabs(local.x), y = std::fabs(local.y);
  double cosine = x / a_, sine = y / b_;
  if (cosine * cosine + sine * sine >= 1.0)
    cosine *= a_ * a_, sine *= b_ * b_;
  else
    (a_ >= b_ ? sine : cosine) = std::sqrt(1.0 - (a_ >= b_ ? cosine * cosine : sine * sine));
  const double scale = std::sqrt(cosine * cosine + sine * sine);
  cosine /= scale, sine /= scale;
  solve_in_quadrant([&](double c, double s) { return slope(x, y, c, s); }, cosine, sine);
  const bool wide = a_ >= b_;
  const double along = wide ? x : y, across = wide ? local.y : local.x;
  const bool other_half = across < 0.0 && along < middle_line();
  return {Feature::Kind::edge, other_half ? 1u : 0u, std::copysign(std::fabs(cosine), local.x),
          std::copysign(std::fabs(sine), local.y)};
}

Feature Ellipse::follow(Feature feature, Vec3d local) const {
  if (feature.kind != Feature::Kind::face) descend(local.x, local.y, feature.cosine, feature.sine);
  return feature;
}

Vec3d Ellipse::place(Feature feature, Vec3d local) const {
  if (feature.kind == Feature::Kind::face) return {local.x, local.y, 0.0};
  return {a_ * feature.cosine, b_ * feature.sine, 0.0};
}

Pace Ellipse::pace(Feature feature, Vec3d local) const {
  if (feature.kind == Feature::Kind::face) return {};
  const double c = feature.cosine, s = feature.sine;
  // As θ' = (the point's path along the rim's tangent) / D', whose length is that of the tangent.
  const double tangent2 = a_ * a_ * s * s + b_ * b_ * c * c;
  const double second = slope(local.x, local.y, c, s)[1];
  const double speed = tangent2 / std::max(second, 1e-6 * tangent2);
  const double radius_of_curvature = tangent2 * std::sqrt(tangent2) / (a_ * b_);
  return {speed, radius_of_curvature / speed};
}

double Ellipse::distance_to_discontinuity(Vec3d local, double tolerance) const {
  const double height = std::fabs(local.z);
  if (!covers(local.x, local.y)) {
    const Vec3d rim = place(nearest(local, tolerance), local);
    return std::max(0.0, std::hypot(local.x - rim.x, local.y - rim.y));
  }
  if (local.z >= -tolerance) return height;
  const bool wide = a_ >= b_;
  const double along = std::fabs(wide ? local.x : local.y);
  const double beyond = std::max(0.0, along - middle_line());
  return std::min(height, std::hypot(beyond, wide ? local.y : local.x));
}

std::vector<Vec3d> Ellipse::outline() const {
  std::vector<Vec3d> points;
  const double step = 2.0 * std::numbers::pi / corners, out = 1.0 / std::cos(0.5 * step);
  for (int i = 0; i < corners; ++i) {
    const double angle = (i + 0.5) * step - 0.5 * std::numbers::pi;
    points.push_back({a_ * out * std::cos(angle), b_ * out * std::sin(angle), 0.0});
  }
  return points;
}

double Ellipse::area() const { return std::numbers::pi * a_ * b_; }

}  // namespace portalens
