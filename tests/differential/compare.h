/// \file
/// Engines against the reference, photon by photon.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "differential/stage.h"

namespace portalens::differential {

/// How one answer differs from the reference's.
struct Difference {
  bool other_way = false;    ///< another fate, object, or portals crossed
  double tolerances = 0.0;   ///< between the directions, where the path is the same
  bool unexplained = false;  ///< more than starts a little aside differ among themselves

  [[nodiscard]] bool counts() const { return other_way || tolerances > 1.0; }
};

/// Whether `a` is worse than `b`: what is unexplained comes first, then other ways, then how far
/// directions are apart.
[[nodiscard]] bool is_worse(const Difference& a, const Difference& b);

/// What one engine did in a scene.
struct Column {
  std::uint64_t photons = 0, other_way = 0, over1 = 0, over10 = 0, over100 = 0;
  std::uint64_t unexplained_ways = 0, unexplained_directions = 0;
  double p99 = 0.0;      ///< of the directions, tolerances; other ways count as infinitely far
  double seconds = 0.0;  ///< of this thread's processor time
  std::uint64_t steps = 0;
  std::size_t worst = 0;  ///< index of the photon that is worst
  Difference worst_difference;
};

enum class Outcome : std::uint8_t { in_lanes, not_in_lanes, timed_out, refused };

struct Comparison {
  Outcome outcome = Outcome::refused;
  std::string reason;  ///< why not in lanes, or why the scene is refused
  Column lanes, scalar;
  std::uint64_t reference_steps = 0;

  /// What that engine did.
  [[nodiscard]] const Column& of(Engine engine) const {
    return engine == Engine::automatic ? lanes : scalar;
  }
};

/// What the reference may take for one scene, seconds of processor time.
inline constexpr double usual_limit = 20.0;

/// Traces the photons three times: in lanes, by the scalar engine, and by the reference. Nothing is
/// traced where the space has no lanes.
[[nodiscard]] Comparison compare(const Stage& stage, double limit = usual_limit);

/// The answer of the reference.
[[nodiscard]] Arrival exact_arrival(const Stage& stage, const Photon& photon);

/// How far `found` is from the reference's answer for this photon. It is explained by how much the
/// photon's path magnifies errors if one of 8 photons of the reference, whose starts point 3
/// tolerances aside, all around, goes the same other way, or differs at least as much in direction.
[[nodiscard]] Difference difference_of(const Stage& stage, const Photon& photon,
                                       const Arrival& found, const Arrival& exact);

}  // namespace portalens::differential
