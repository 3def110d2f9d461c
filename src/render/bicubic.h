/// \file
/// What photons would have found between sixteen that found alike.
#pragma once

#include <array>

#include "photon/photon.h"
#include "photon/space.h"

namespace portalens {

/// How far the photons of neighbouring pixels begin apart.
struct PixelSpan {
  double angle = 0.0;  ///< of their directions, radians
  double aside = 0.0;  ///< of their places
};

/// A step from node to node of a sampling grid.
struct NodeStep {
  int right = 0, down = 0;

  [[nodiscard]] bool is_none() const { return right == 0 && down == 0; }
};

/// The polynomial of the third degree each way through what sixteen photons found, four each way.
class Bicubic {
 public:
  using ProbeRays = std::array<std::array<const Arrival*, 4>, 4>;
  class Row;

  /// Whether such an arrival can be told by its neighbours.
  [[nodiscard]] static bool can_tell(const Space& space, const Arrival& arrival);

  /// @param aside  from the cell whose photons it tells of to the one between its inner four probe
  /// rays
  explicit Bicubic(NodeStep aside) : aside_(aside) {}

  /// Puts the polynomial through the probe rays if their third differences are so small that it
  /// errs by hundredths of a pixel.
  /// @param most  the largest third difference, pixels; that of directions is held to the tolerance
  ///              besides
  /// @return the largest third difference, as a multiple of `most`; above 1 the polynomial may not
  ///         be used. If it is above `given_up`, some value above that
  /// @pre the probe rays met the same, and `can_tell` says so of them
  double through(const Space& space, const ProbeRays& probe_rays, const PixelSpan& pixel,
                 double most, double given_up);

 private:
  using Four = float __attribute__((vector_size(16)));
  /// What is interpolated, relative to the model, so that floats are enough.
  struct Values {
    /// On a surface, the place in homogeneous coordinates, which over a plane are linear where
    /// light is straight: the last is the inverse of the path's length. In the sky the place and
    /// the length.
    Four place;
    Four turn;  ///< the direction, and how much the path turned

    friend Values operator+(const Values& a, const Values& b) {
      return {a.place + b.place, a.turn + b.turn};
    }
    friend Values operator-(const Values& a, const Values& b) {
      return {a.place - b.place, a.turn - b.turn};
    }
    friend Values operator*(const Values& a, float s) { return {a.place * s, a.turn * s}; }
  };
  /// Coefficients of a polynomial of the third degree, from that of the constant.
  using Cubic = std::array<Values, 4>;

  [[nodiscard]] static Cubic cubic_through(const Values& before, const Values& first,
                                           const Values& second, const Values& after);
  [[nodiscard]] static Values value(const Cubic& cubic, float at);

  NodeStep aside_;
  Arrival model_;                   ///< one of the probe rays; all values are relative to it
  const Sphere* sphere_ = nullptr;  ///< that the probe rays hit, if it is one
  /// Element k is the coefficient of uᵏ, as a cubic in v: shares of the cell, from its left and its
  /// upper edge.
  std::array<Cubic, 4> cubics_;
};

/// What photons would have found along a row of a cell. Borrows the polynomial.
class Bicubic::Row {
 public:
  /// @param v  share of the cell, from its upper edge
  Row(const Bicubic& cell, double v);
  /// @param u  share of the cell, from its left edge
  void tell(double u, Arrival& arrival) const;

 private:
  const Bicubic& cell_;
  float right_;  ///< how far the probe rays lie aside
  Cubic cubic_;
};

}  // namespace portalens
