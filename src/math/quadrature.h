/// \file
/// Integrals of smooth functions.
#pragma once

namespace portalens {

/// Gauss-Legendre of order 10 in each of `cells` equal cells.
/// @param f  gives numbers, or what adds up and scales as they do and begins at 0
template <class F>
[[nodiscard]] auto integrate(const F& f, double low, double high, int cells) {
  constexpr double node[5] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                              0.8650633666889845, 0.9739065285171717};
  constexpr double weight[5] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820,
                                0.1494513491505806, 0.0666713443086881};
  const double h = (high - low) / cells;
  decltype(f(low)) sum{};
  for (int i = 0; i < cells; ++i) {
    const double middle = low + (i + 0.5) * h;
    for (int k = 0; k < 5; ++k)
      sum = sum + (f(middle - 0.5 * h * node[k]) + f(middle + 0.5 * h * node[k])) * weight[k];
  }
  return sum * (0.5 * h);
}

}  // namespace portalens
