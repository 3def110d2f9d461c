/// \file
/// Three components of a `Real`: double, or a pack of lanes.
#pragma once

#include <array>
#include <cmath>
#include <concepts>

namespace portalens {

template <class Real>
struct Vec3 {
  Real x{}, y{}, z{};

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(Real s, Vec3 a) { return a * s; }
  /// Component by component, as colours multiply.
  friend constexpr Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend constexpr Vec3 operator/(Vec3 a, Real s) { return {a.x / s, a.y / s, a.z / s}; }
  constexpr Vec3& operator+=(Vec3 b) { return *this = *this + b; }
  constexpr Vec3& operator-=(Vec3 b) { return *this = *this - b; }
  constexpr Vec3& operator*=(Real s) { return *this = *this * s; }
  friend constexpr bool operator==(const Vec3& a,
                                   const Vec3& b) requires std::floating_point<Real> {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
};

template <class Real>
[[nodiscard]] constexpr Real dot(Vec3<Real> a, Vec3<Real> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
[[nodiscard]] constexpr Vec3<Real> cross(Vec3<Real> a, Vec3<Real> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Real>
[[nodiscard]] Real length(Vec3<Real> a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

/// Packs of lanes have faster ones, good enough for them.
[[nodiscard]] inline double inverse_sqrt(double x) { return 1.0 / std::sqrt(x); }
[[nodiscard]] inline double select(bool first, double a, double b) { return first ? a : b; }
[[nodiscard]] inline bool both(bool first, bool second) { return first && second; }
[[nodiscard]] inline double inverse_fourth_root(double x) { return 1.0 / std::sqrt(std::sqrt(x)); }

/// @pre the length is not 0
template <class Real>
[[nodiscard]] Vec3<Real> normalize(Vec3<Real> a) {
  return a * inverse_sqrt(dot(a, a));
}

using Vec3d = Vec3<double>;

/// Linear red, green, blue: a radiance, or a share of one.
using Rgb = Vec3<double>;

[[nodiscard]] constexpr Vec3d to_vec3(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }
[[nodiscard]] inline bool is_finite(Vec3d a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
[[nodiscard]] inline double max_component(Vec3d a) { return std::fmax(a.x, std::fmax(a.y, a.z)); }

/// A unit vector at right angles to the unit vector `n`; it is steady where `n` is.
[[nodiscard]] inline Vec3d any_perpendicular(Vec3d n) {
  const Vec3d axis = std::fabs(n.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  return normalize(cross(n, axis));
}

}  // namespace portalens
