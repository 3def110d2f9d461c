/// \file
/// Four neighbouring floats of a table, as one: for lanes that look up one by one.
#pragma once

namespace portalens {

/// @tparam R  the lanes: an engine's own, so that no two instruction sets share it
template <class R>
struct LaneFour {
  using Floats = float __attribute__((vector_size(16)));
  Floats values;

  static LaneFour load(const float* at) {
    LaneFour four;
    __builtin_memcpy(&four.values, at, sizeof four.values);
    return four;
  }
  friend LaneFour operator+(LaneFour a, LaneFour b) { return {a.values + b.values}; }
  friend LaneFour operator*(LaneFour a, float s) { return {a.values * s}; }
};

}  // namespace portalens
