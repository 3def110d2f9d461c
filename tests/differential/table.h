/// \file
/// What many comparisons come to, in the rows that engines are held to.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "differential/compare.h"

namespace portalens::differential {

/// A scene that was compared.
struct Entry {
  std::uint64_t index = 0;
  std::string kind;
  Comparison comparison;
};

/// One engine's sums over scenes.
struct Sums {
  std::uint64_t photons = 0, other_way = 0, over1 = 0, over10 = 0, over100 = 0;
  std::uint64_t unexplained_ways = 0, unexplained_directions = 0;
  std::uint64_t scenes = 0, scenes_over = 0;  ///< whose p99 is above the tolerance
  std::uint64_t steps = 0;
  std::vector<double> microseconds;  ///< a photon, of each scene
  double seconds = 0.0;

  void add(const Column& column);
};

struct Tally {
  Sums lanes, scalar;
  std::uint64_t scenes = 0, timed_out = 0;
  std::map<std::string, std::uint64_t> not_in_lanes, refused;  ///< by reason
  std::uint64_t reference_steps = 0;
  std::vector<double> lanes_to_scalar;  ///< time of the one to that of the other, of each scene

  void add(const Comparison& comparison);
};

/// A row of the table: a count among so many.
struct Row {
  const char* name;
  std::uint64_t count, of;
  double most;  ///< what is asked of it, a share

  [[nodiscard]] double share() const {
    return of == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(of);
  }
};
/// In the order in which they are printed.
[[nodiscard]] std::vector<Row> rows_of(const Sums& sums);

/// The table of one tally, as text.
[[nodiscard]] std::string table_of(const std::string& title, const Tally& tally);
/// A line for each kind.
[[nodiscard]] std::string kinds_of(const std::vector<Entry>& entries);
/// Whether no row of either engine is above its bound.
[[nodiscard]] bool holds(const Tally& tally);
/// At most so many scenes of those where that engine is over the tolerance for a photon: first
/// where most is unexplained.
[[nodiscard]] std::vector<Entry> worst_of(const std::vector<Entry>& entries, Engine engine,
                                          std::size_t count);
/// A line for each scene, with that engine's worst photon, how many paths + directions are
/// unexplained, and what the other engine's worst is.
[[nodiscard]] std::string lines_of(const std::vector<Entry>& entries, Engine engine);
/// What is wrong with a photon.
[[nodiscard]] std::string in_words(const Difference& difference);
/// All of it as one JSON object.
[[nodiscard]] std::string json_of(const std::vector<Entry>& entries);

}  // namespace portalens::differential
