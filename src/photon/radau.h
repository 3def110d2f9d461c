/// \file
/// The default: a step over Radau's nodes whose length follows from the field.
#pragma once

#include <array>
#include <cmath>

#include "math/multiply_add.h"
#include "photon/integrator_settings.h"
#include "photon/step.h"

namespace portalens {

/// The shares of a step at which its field is evaluated: Radau's four nodes, whose quadrature over
/// the step is of order 7.
inline constexpr std::array<double, 4> radau_nodes = {0.0, 0.212340538239152, 0.590533135559265,
                                                      0.911412040487296};

namespace radau_details {

using Weights = std::array<std::array<double, 4>, 4>;

/// Coefficients of the polynomial that is 1 at node `j` of the first `count`, and 0 at the others.
constexpr std::array<double, 4> basis(std::size_t count, std::size_t j) {
  std::array<double, 4> p = {1.0};
  for (std::size_t i = 0; i < count; ++i) {
    if (i == j) continue;
    const double scale = 1.0 / (radau_nodes[j] - radau_nodes[i]);
    for (std::size_t k = 3; k > 0; --k) p[k] = scale * (p[k - 1] - radau_nodes[i] * p[k]);
    p[0] *= -scale * radau_nodes[i];
  }
  return p;
}

/// Of ∫₀ᵘ basis and ∫₀ᵘ∫₀ᵛ basis.
constexpr double once(std::size_t count, std::size_t j, double u) {
  const auto p = basis(count, j);
  return u * (p[0] + u * (p[1] / 2 + u * (p[2] / 3 + u * p[3] / 4)));
}
constexpr double twice(std::size_t count, std::size_t j, double u) {
  const auto p = basis(count, j);
  return u * u * (p[0] / 2 + u * (p[1] / 6 + u * (p[2] / 12 + u * p[3] / 20)));
}

/// Row i: the integral up to node i, from the values at the nodes before it or at all of them.
template <class Integral>
constexpr Weights to_nodes(const Integral& integral, bool from_all) {
  Weights weights{};
  for (std::size_t i = 1; i < 4; ++i)
    for (std::size_t j = 0; j < (from_all ? 4 : i); ++j)
      weights[i][j] = integral(from_all ? 4 : i, j, radau_nodes[i]);
  return weights;
}

/// The place of node 1 follows from the value at node 0 alone, with an error of order h³. That of
/// node 2 is shifted so that its error is opposite, and both errors cancel in the direction at the
/// end: that raises the order from 3 to 4.
constexpr Weights place_weights() {
  Weights weights = to_nodes(twice, false);
  const auto cube = [](double u) { return u * u * u; };
  const double share =
      once(4, 1, 1.0) / once(4, 2, 1.0) * cube(radau_nodes[1]) / (6 * radau_nodes[1]);
  weights[2][0] -= share;
  weights[2][1] += share;
  return weights;
}

/// Row k: the coefficient of uᵏ of the polynomial through the values at all nodes.
constexpr Weights coefficients() {
  Weights weights{};
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t k = 0; k < 4; ++k) weights[k][j] = basis(4, j)[k];
  return weights;
}

inline constexpr Weights place_from_before = place_weights();
inline constexpr Weights turn_from_before = to_nodes(once, false);
inline constexpr Weights turn_from_all = to_nodes(once, true);
inline constexpr Weights polynomial = coefficients();
inline constexpr std::array<double, 4> end_place = {twice(4, 0, 1), twice(4, 1, 1), twice(4, 2, 1),
                                                    twice(4, 3, 1)};
inline constexpr std::array<double, 4> last_place = {
    twice(4, 0, radau_nodes[3]), twice(4, 1, radau_nodes[3]), twice(4, 2, radau_nodes[3]),
    twice(4, 3, radau_nodes[3])};
inline constexpr std::array<double, 4> end_turn = {once(4, 0, 1), once(4, 1, 1), once(4, 2, 1),
                                                   once(4, 3, 1)};

}  // namespace radau_details

/// The sum of vectors with weights.
template <class Real, class... More>
[[nodiscard]] Vec3<Real> weighted(const std::array<double, 4>& weights, Vec3<Real> first,
                                  More... others) {
  Vec3<Real> sum = first * Real(weights[0]);
  std::size_t j = 0;
  ((sum = multiply_add(others, Real(weights[++j]), sum)), ...);
  return sum;
}

/// dt/ds at the four nodes of a step.
template <class Real>
struct Bends {
  Vec3<Real> at[4];
  /// At the last node: its place as predicted from the values before it, and how far the direction
  /// that follows from all four values is from the predicted one.
  Vec3<Real> foreseen, turned;

  [[nodiscard]] Vec3<Real> sum(const std::array<double, 4>& weights) const {
    return weighted(weights, at[0], at[1], at[2], at[3]);
  }
};

/// A step of x'' = a(x) - (a·x') x' through four places. Where they are follows from the values
/// before them; the direction at each is then found again from all four, which needs no further
/// evaluation of the field. On a nearly straight path that leaves the error of the quadrature, of
/// seventh order; what a path's own bend feeds back into it is of fourth. The length
///     h = (Σ w m d⁻⁵ / η⁴ + Σ v d⁻⁴ / λ⁴)^(-1/4)
/// at distances d from masses is proposed, for it spreads the error evenly over the path;
/// `roughness` then judges the step, and one that errs by too much is taken again, shorter. η⁴ is a
/// multiple of the tolerance: the first sum keeps what is fed back below it. The second keeps a
/// step shorter than λ times the distance, since how well a quadrature follows the field depends on
/// h/d alone; so λ goes as the seventh root of the tolerance, and a little faster
/// (`longest_power`). Near capture a path magnifies every error made on the path: hence the weight
/// w, `path_weight`. What is left behind soon weighs little: hence v, `approach_weight`.
struct Radau {
  static constexpr std::string_view name = "adaptive";
  static constexpr bool fixed_step = false;
  static constexpr bool straight_pieces = false;
  double stiffness_weight;  ///< 1/η⁴
  double nearness_weight;   ///< 1/λ⁴
  double third_weight;      ///< 1/κ²: of `StepDoubt::uneven2`
  double feedback_weight;   ///< of what is fed back, radians

  static Radau from(const IntegratorSettings& settings) {
    const double tightness = std::fmin(settings.tolerance / 1e-4, 1.0);
    const double longest = longest_share * std::pow(tightness, longest_power);
    const double third = third_share * std::pow(settings.tolerance / 1e-4, 3.0 / 7.0);
    return {1.0 / (error_share * settings.tolerance), 1.0 / std::pow(longest, 4),
            1.0 / (third * third), feedback_share / settings.tolerance};
  }

  /// @param stiffness  Σ w m d⁻⁵, nearness  Σ v d⁻⁴, both 1/length⁴
  template <class Real>
  [[nodiscard]] static Real propose(Real stiffness, Real nearness, Real stiffness_weight,
                                    Real nearness_weight) {
    return inverse_fourth_root(
        multiply_add(nearness, nearness_weight, stiffness * stiffness_weight));
  }
  [[nodiscard]] double propose(double stiffness, double nearness) const {
    return propose(stiffness, nearness, stiffness_weight, nearness_weight);
  }

  /// The most that a step turns by: were the strongest of its bends to last, radians.
  template <class Real>
  [[nodiscard]] static Real turn(const Bends<Real>& bends, Real h) {
    using std::max, std::sqrt;
    Real most = dot(bends.at[0], bends.at[0]);
    for (int k = 1; k < 4; ++k) most = max(most, dot(bends.at[k], bends.at[k]));
    return sqrt(most) * h;
  }

  template <class Real>
  [[nodiscard]] static StepDoubt<Real> doubt(StateOf<Real> state, const Bends<Real>& bends, Real h,
                                             Real turn) {
    using namespace radau_details;
    const Vec3<Real> third = bends.sum(polynomial[3]) * h;
    const Vec3<Real> bent = bends.sum(last_place);
    const Vec3<Real> last = multiply_add(
        multiply_add(bent, h, state.direction * Real(radau_nodes[3])), h, state.position);
    const Vec3<Real> missed = last - bends.foreseen;
    return {dot(third, third), turn, dot(missed, missed), dot(bends.turned, bends.turned)};
  }

  /// The roughness of a step: 1 where its error is its share of the tolerance; the error grows as
  /// the power 7/6 of it. It is the larger of two estimates: of the quadrature's error, from the
  /// cubic coefficient of the polynomial through the four values, which falls with h³ where the
  /// field is smooth; and of what the path's own bend feeds back, from the last node's prediction.
  /// @param pull2     square of the length of the acceleration at the start, 1/length²
  /// @param gradient  of the acceleration, 1/length²
  template <class Real>
  [[nodiscard]] static Real roughness(const StepDoubt<Real>& doubt, Real pull2, Real gradient,
                                      Real h, Real third_weight, Real feedback_weight) {
    using std::max, std::min, std::sqrt;
    const Real follows = doubt.uneven2 * third_weight / max(doubt.turn, Real(1e-15));
    const Real fed_back = sqrt(multiply_add(doubt.missed2 * gradient, gradient,
                                            Real(direction_share2) * doubt.turned2 * pull2)) *
                          h;
    // m/d, about: near a strong mass a path magnifies every error made on the path.
    const Real strength = min(Real(2) * pull2 / max(gradient, Real(1e-30)), Real(2));
    const Real square = strength * strength;
    const Real severity = multiply_add(multiply_add(Real(40), square, Real(10)), square, Real(1));
    return max(follows, fed_back * feedback_weight) * severity;
  }
  [[nodiscard]] double roughness(const StepDoubt<double>& doubt, double pull2, double gradient,
                                 double h) const {
    return roughness(doubt, pull2, gradient, h, third_weight, feedback_weight);
  }
  /// How long the next step may be after one of that length and roughness. What is smooth does not
  /// bound it: a step may have been short for another reason.
  template <class Real>
  [[nodiscard]] static Real longest_after(Real h, Real roughness, Real unbounded) {
    using std::max, std::sqrt;
    const Real share = Real(0.9) * inverse_fourth_root(sqrt(max(roughness, Real(smooth))));
    return select(roughness > Real(smooth), h * max(share, Real(0.2)), unbounded);
  }
  /// Less rough steps tell nothing of the next.
  static constexpr double smooth = 0.2;
  /// Rougher steps are taken again, shorter.
  static constexpr double roughest = 1.7;

  template <class Real, class Acceleration>
  [[nodiscard]] static Bends<Real> bends(const Acceleration& acceleration, StateOf<Real> state,
                                         Vec3<Real> start_acceleration, Real h) {
    using namespace radau_details;
    using V = Vec3<Real>;
    const V x = state.position, t = state.direction;
    const auto place = [&](double node, V bent) {
      return multiply_add(multiply_add(bent, h, t * Real(node)), h, x);
    };
    const V k0 = turning_part(start_acceleration, t);
    const V a1 = acceleration(place(radau_nodes[1], weighted(place_from_before[1], k0)));
    V k1 = turning_part(a1, multiply_add(k0, Real(radau_nodes[1]) * h, t));
    k1 = turning_part(a1, multiply_add(k0 + k1, Real(0.5 * radau_nodes[1]) * h, t));
    const V a2 = acceleration(place(radau_nodes[2], weighted(place_from_before[2], k0, k1)));
    V k2 = turning_part(a2, multiply_add(weighted(turn_from_before[2], k0, k1), h, t));
    const V foreseen = place(radau_nodes[3], weighted(place_from_before[3], k0, k1, k2));
    const V a3 = acceleration(foreseen);
    const V before = multiply_add(weighted(turn_from_before[3], k0, k1, k2), h, t);
    V k3 = turning_part(a3, before);
    const V t1 = multiply_add(weighted(turn_from_all[1], k0, k1, k2, k3), h, t);
    const V t2 = multiply_add(weighted(turn_from_all[2], k0, k1, k2, k3), h, t);
    const V t3 = multiply_add(weighted(turn_from_all[3], k0, k1, k2, k3), h, t);
    k1 = turning_part(a1, t1);
    k2 = turning_part(a2, t2);
    k3 = turning_part(a3, t3);
    return {{k0, k1, k2, k3}, foreseen, t3 - before};
  }

  /// Where a step of `bends` ends; the direction's length is 1 but for the error of the step.
  template <class Real>
  [[nodiscard]] static StateOf<Real> end(StateOf<Real> state, const Bends<Real>& bends, Real h) {
    using namespace radau_details;
    const Vec3<Real> x = state.position, t = state.direction;
    return {multiply_add(multiply_add(bends.sum(end_place), h, t), h, x),
            multiply_add(bends.sum(end_turn), h, t)};
  }

  template <class Acceleration>
  [[nodiscard]] static StepResult<double> step(const Acceleration& acceleration, State state,
                                               Vec3d start_acceleration, double h) {
    using radau_details::polynomial;
    const Bends<double> found = bends(acceleration, state, start_acceleration, h);
    const Vec3d middle = found.sum(polynomial[0]) +
                         (found.sum(polynomial[1]) +
                          (found.sum(polynomial[2]) + found.sum(polynomial[3]) * 0.5) * 0.5) *
                             0.5;
    const State arrived = end(state, found, h);
    return {{arrived.position, normalize(arrived.direction)},
            portalens::length(middle),
            doubt(state, found, h, turn(found, h))};
  }

  /// η⁴ as a multiple of the tolerance, and λ at a tolerance of 1e-4: measured against the closed
  /// forms of one mass from near capture to far (tests/photon/closed_forms_test.cpp holds them to
  /// it). The last digits, like those of `path_weight`, were fitted on benchmarks/scenes: with them
  /// no median, percentile or greatest error there is above what it was before steps were judged.
  static constexpr double error_share = 101.12;
  static constexpr double longest_share = 0.6498;
  /// Of the tolerance in λ. By 1/7 the error at a step's end would stay the same share of the
  /// tolerance; the error within a step, where a surface may end the path, falls with a lower power
  /// of its length, and came to the whole tolerance at 1e-9.
  static constexpr double longest_power = 0.16;
  /// κ at a tolerance of 1e-4.
  static constexpr double third_share = 0.42;
  /// At a roughness of 1 what is fed back is twice the tolerance, were it all error. The second is
  /// the square of the direction's weight in it. Measured on random scenes (docs/differential.md).
  static constexpr double feedback_share = 0.5;
  static constexpr double direction_share2 = 0.04;
};

}  // namespace portalens
