/// \file
/// Over lanes: where within a step what acts changes first.
#pragma once

#include "lanes/path.h"

namespace portalens {

/// The first place on a step's path where what acts changes.
template <class R>
struct FirstMeeting {
  using Mask = typename R::Mask;

  R share{2};  ///< of the step; beyond 1: none
  Mask missed =
      R(1) < R(0);  ///< lanes where something has changed at once, but where was not found

  /// Where nothing has been met before a span.
  [[nodiscard]] Mask open(LaneSpan<R> span) const { return (share > span.low) & !missed; }

  /// Where a height vanishes that has other signs at the ends of a span; which lanes that is in.
  /// Large, and seldom asked for: never inlined, as all that is asked for only where something
  /// changes.
  /// @param height  a polynomial, or the square of a distance less that of a radius
  template <class Height>
  [[gnu::noinline]] Mask offer(Mask may, const Height& height, LaneSpan<R> span) {
    const R z0 = height.at(span.low), z1 = height.at(span.high);
    const auto crosses = may & (((z0 > R(0)) & (z1 <= R(0))) | ((z0 < R(0)) & (z1 >= R(0))));
    if (!any(crosses)) return crosses;
    const R part = z0 / select(crosses, z0 - z1, R(1));
    const R guess = multiply_add(span.high - span.low, part, span.low);
    const R u = crossing(crosses, height, guess, z0, span.low, span.high);
    share = min(share, select(crosses, u, R(2)));
    return crosses;
  }

  /// Where a ball is entered or left within a span, be it only for a part of it.
  /// @param within  it counts as within at the start of the step
  /// @param squares  of the distance from the ball's middle at both ends of the span
  /// @param gap     no distance changes by more over the span
  /// @param square  gives the square of the distance, less that of the radius, on the path
  template <class Square>
  void offer_ball(Mask may, Mask within, R radius, LaneSpan<R> squares, R gap, LaneSpan<R> span,
                  const Square& square) {
    const auto ends_in = squares.high < radius * radius;
    const Mask toggles = may & ((ends_in & !within) | (within & !ends_in));
    const R inner = max(radius - R(0.5) * gap, R(0)), outer = radius + R(0.5) * gap;
    const Mask grazes = may & !toggles &
                        ((within & (max(squares.low, squares.high) > inner * inner)) |
                         ((!within) & (min(squares.low, squares.high) < outer * outer)));
    if (any(toggles | grazes)) meet_ball(toggles, grazes, within, span, square);
  }

  /// Something has changed within a span, but where was not found: the step ends before it.
  void miss(Mask where, LaneSpan<R> span) {
    const Mask later = span.low > R(0);
    share = select(where & later, min(share, span.low), share);
    missed = missed | (where & !later);
  }

 private:
  /// What `offer_ball` does where the ball is met.
  template <class Square>
  [[gnu::noinline]] void meet_ball(Mask toggles, Mask grazes, Mask within, LaneSpan<R> span,
                                   const Square& square) {
    const auto excess = square();
    if (any(grazes)) offer_graze(grazes, within, excess, span);
    // Where the path passes the face's plane from behind, the distance falls at once: a search for
    // where it equals the reach may end too early or too late, so the plane is offered, too.
    if constexpr (requires { excess.plane(); }) offer(toggles & !within, excess.plane(), span);
    if (any(toggles)) miss(toggles & !offer(toggles, excess, span), span);
  }

  /// Where a ball is entered and left again within a span, or left and entered.
  template <class Excess>
  void offer_graze(Mask may, Mask within, const Excess& excess, LaneSpan<R> span) {
    const R side = select(within, R(-1), R(1));
    const Mask turns =
        may & (excess.slope(span.low) * side < R(0)) & (excess.slope(span.high) * side > R(0));
    if (!any(turns)) return;
    R low = span.low, high = span.high;
    for (int k = 0; k < 8; ++k) {
      const R middle = (low + high) * R(0.5);
      const auto before = excess.slope(middle) * side < R(0);
      low = select(before, middle, low);
      high = select(before, high, middle);
    }
    const R turn = (low + high) * R(0.5);
    const Mask passes = turns & (excess.at(turn) * side < R(0));
    if (any(passes)) offer(passes, excess, {span.low, turn});
  }
};

}  // namespace portalens
