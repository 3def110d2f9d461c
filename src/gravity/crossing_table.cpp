#include "gravity/crossing_table.h"

#include <array>
#include <cmath>

#include "math/quadrature.h"

namespace portalens {
namespace {

/// Cells of the quadratures.
constexpr int pieces = 2;
/// `CrossingRange::scale` in gravitational radii.
constexpr double scale = 2.0;
/// The table's ends, where what it holds is 0 / 0, are looked at from that far.
constexpr double off_the_end = 1e-9;

/// What both integrals along a path add up.
struct Integrals {
  double swept = 0.0, length = 0.0;
  friend Integrals operator+(Integrals a, Integrals b) {
    return {a.swept + b.swept, a.length + b.length};
  }
  friend Integrals operator*(Integrals a, double s) { return {a.swept * s, a.length * s}; }
};

double capture_of(double share) { return 2.0 * share * std::exp(0.5 - share); }

double cosine_of(double sine) { return std::sqrt(std::fmax(0.0, (1.0 - sine) * (1.0 + sine))); }

/// From the rim to the rim. With r = r0 / (1 - w²), and A = (b / n r)²,
///     ∫ b dr / (r √(n² r² - b²)) = ∫ 2 w exp(m w²/r0) / √(1 - A) dw,
/// and the length, less that of the straight path from r0 on at right angles to the radius,
///     ∫ (1/√(1 - A) - 1/√(1 - B)) dr,   B = (r0/r)²:
/// both smooth up to w = 0 and far out.
Crossing passing(double share, double b) {
  const double r0 = closest_approach(share, b), bend = share / r0;
  const auto integrand = [&](double w) -> Integrals {
    const double w2 = w * w, log_b = 2.0 * std::log1p(-w2), rise = 2.0 * bend * w2;
    const double a = std::sqrt(-std::expm1(log_b + rise)), straight = std::sqrt(-std::expm1(log_b));
    return {2.0 * w * std::exp(0.5 * rise) / a,
            2.0 * w * r0 * std::expm1(rise) / (a * straight * (a + straight))};
  };
  const double end = std::sqrt(1.0 - r0);
  const Integrals half = integrate(integrand, 0.0, end, pieces);
  const double turning = 2.0 * (half.swept - std::atan2(cosine_of(b), b));
  return {std::tan(0.5 * turning), turning, 2.0 * (cosine_of(r0) + half.length)};
}

/// From the rim to the horizon, r = 2 m / (1 - w²). With s = b/b_c, q² = 1 - s² and
/// w² = p (p + 2 q) it is smooth for all q, for √(n² r² - b²) is nearly (p + q) b_c.
Crossing captured(double share, double b) {
  const double sine = b / capture_of(share), q = cosine_of(sine), q2 = q * q;
  const auto integrand = [&](double p) -> Integrals {
    const double w2 = p * (p + 2.0 * q);
    const double exponent = 2.0 * std::log1p(-w2) + w2;  // ln (b_c / n r)²
    const double root = std::sqrt(q2 - sine * sine * std::expm1(exponent));
    return {2.0 * (p + q) * sine * std::exp(0.5 * w2) / root,
            4.0 * share * (p + q) * sine * sine * std::exp(w2) / (root * (1.0 + root))};
  };
  const double end2 = 1.0 - 2.0 * share;
  const double end = end2 / (std::sqrt(end2 + q2) + q);
  const Integrals sum = integrate(integrand, 0.0, end, pieces);
  const double turning = sum.swept - (std::atan2(sine, q) - std::atan2(b, cosine_of(b)));
  return {std::tan(0.5 * turning), turning, end2 + sum.length};
}

}  // namespace

double closest_approach(double share, double b) {
  // Newton's method on ln r + m/r = m + ln b, which is concave beyond 2 m: from there it only
  // rises.
  const double target = share + std::log(b);
  double r = b;
  for (int i = 0; i < 60; ++i) {
    const double next =
        std::fmax(2.0 * share, r - (std::log(r) + share / r - target) * r * r / (r - share));
    const bool still = std::fabs(next - r) <= 1e-16 * r;
    r = next;
    if (still) break;
  }
  return std::fmin(r, 1.0);
}

Crossing exact_crossing(double share, double b) {
  return b < capture_of(share) ? captured(share, b) : passing(share, b);
}

CrossingTable::CrossingTable(double share) : share_(share) {
  range_ = {capture_of(share), scale * share, 1.0};
  const double farthest = passing_place(range_, 1.0, 0.0).cell - captured_cells;
  range_.stretch = passing_cells / farthest;
  cells_.resize(std::size_t{captured_cells + passing_cells} * floats_per_cell);
  for (int cell = 0; cell < captured_cells + passing_cells; ++cell) {
    fill(cell);
    for (const double within : {0.1, 0.5}) measure(cell, within);
  }
}

double CrossingTable::impact_of(int cell, double within) const {
  if (cell < captured_cells) {
    const double cosine = std::fmin((cell + within) / captured_cells, 1.0 - off_the_end);
    return range_.capture * cosine_of(cosine);
  }
  const double root = 1.0 - (cell - captured_cells + within) / range_.stretch;
  return std::fmin(range_.capture + range_.scale * (1.0 / (root * root) - 1.0), 1.0 - off_the_end);
}

Crossing CrossingTable::exact_at(int cell, double b) const {
  return cell < captured_cells ? captured(share_, b) : passing(share_, b);
}

void CrossingTable::fill(int cell) {
  // Chebyshev's nodes, stretched so that neighbouring cells share one.
  constexpr std::array<double, 4> nodes = {0.0, 0.25, 0.75, 1.0};
  std::array<std::array<double, 4>, 3> values;
  for (std::size_t i = 0; i < 4; ++i) {
    const double b = impact_of(cell, nodes[i]);
    const Crossing exact = exact_at(cell, b);
    const bool falls = cell < captured_cells;
    const double factor = falls ? b / range_.capture : cosine_of(b);
    values[0][i] = exact.half_tangent / factor;
    values[1][i] = exact.turning / factor;
    values[2][i] = falls ? exact.length : exact.length / factor;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    // Newton's divided differences, and what they are in powers of the share of the cell.
    const auto& f = values[k];
    const double f01 = (f[1] - f[0]) / 0.25, f12 = (f[2] - f[1]) / 0.5, f23 = (f[3] - f[2]) / 0.25;
    const double f012 = (f12 - f01) / 0.75, f123 = (f23 - f12) / 0.75, cube = f123 - f012;
    const std::array<double, 4> powers = {f[0], f01 - 0.25 * f012 + 0.1875 * cube, f012 - cube,
                                          cube};
    for (std::size_t power = 0; power < 4; ++power)
      cells_[static_cast<std::size_t>(cell) * floats_per_cell + 4 * power + k] =
          static_cast<float>(powers[power]);
  }
}

void CrossingTable::measure(int cell, double within) {
  const double b = impact_of(cell, within);
  const Crossing exact = exact_at(cell, b), found = at(b);
  const double angle = std::fmax(std::fabs(found.turning - exact.turning),
                                 std::fabs(2.0 * std::atan(found.half_tangent) - exact.turning));
  angle_error_ = std::fmax(angle_error_, 2.0 * angle);
  length_error_ = std::fmax(length_error_, 2.0 * std::fabs(found.length - exact.length));
}

Crossing CrossingTable::at(double b) const {
  const bool falls = b < range_.capture;
  const CrossingPlace<double> place =
      falls ? captured_place(range_, b) : passing_place(range_, b, cosine_of(b));
  const double last = falls ? captured_cells - 1 : captured_cells + passing_cells - 1;
  const double first = std::floor(std::fmin(place.cell, last)), u = place.cell - first;
  const float* cell = cells_.data() + static_cast<std::size_t>(first) * floats_per_cell;
  const auto value = [&](int k) {
    return double{cell[k]} +
           (double{cell[4 + k]} + (double{cell[8 + k]} + double{cell[12 + k]} * u) * u) * u;
  };
  return {value(0) * place.factor, value(1) * place.factor,
          falls ? value(2) : value(2) * place.factor};
}

}  // namespace portalens
