#include "differential/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <tuple>

namespace portalens::differential {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double ratio(double a, double b) { return b > 0.0 ? a / b : 0.0; }

std::uint64_t count_of(const std::map<std::string, std::uint64_t>& reasons) {
  std::uint64_t sum = 0;
  for (const auto& [reason, count] : reasons) sum += count;
  return sum;
}

std::string note_of(const Tally& tally) {
  std::string text;
  auto to = std::back_inserter(text);
  const auto elsewhere = count_of(tally.not_in_lanes), refused = count_of(tally.refused);
  fmt::format_to(to,
                 "scenes: {}; in lanes {} ({:.1f} % of the photons), by the scalar engine {}, "
                 "timed out {}, refused {}\n",
                 tally.scenes, tally.lanes.scenes,
                 100.0 * ratio(static_cast<double>(tally.lanes.scenes),
                               static_cast<double>(tally.lanes.scenes + elsewhere)),
                 elsewhere, tally.timed_out, refused);
  for (const auto& [reason, count] : tally.not_in_lanes)
    fmt::format_to(to, "  by the scalar engine: {}, {}\n", count, reason);
  for (const auto& [reason, count] : tally.refused)
    fmt::format_to(to, "  refused: {}, {}\n", count, reason);
  const auto per_photon = [](double sum, const Sums& sums) {
    return ratio(sum, static_cast<double>(sums.photons));
  };
  const auto engine = [&](const char* name, const Sums& sums) {
    fmt::format_to(to,
                   "{}: {:.3f} us a photon in the median scene, {:.3f} in the mean; {:.1f} steps\n",
                   name, median(sums.microseconds), 1e6 * per_photon(sums.seconds, sums),
                   per_photon(static_cast<double>(sums.steps), sums));
  };
  engine("lanes", tally.lanes);
  engine("scalar", tally.scalar);
  fmt::format_to(to, "lanes take {:.3f} of the scalar engine's time in the median scene\n",
                 median(tally.lanes_to_scalar));
  fmt::format_to(to, "reference: {:.1f} steps\n",
                 per_photon(static_cast<double>(tally.reference_steps), tally.scalar));
  return text;
}

}  // namespace

void Sums::add(const Column& column) {
  photons += column.photons;
  other_way += column.other_way;
  over1 += column.over1;
  over10 += column.over10;
  over100 += column.over100;
  unexplained_ways += column.unexplained_ways;
  unexplained_directions += column.unexplained_directions;
  ++scenes;
  scenes_over += column.p99 > 1.0;
  steps += column.steps;
  seconds += column.seconds;
  microseconds.push_back(1e6 * ratio(column.seconds, static_cast<double>(column.photons)));
}

void Tally::add(const Comparison& comparison) {
  ++scenes;
  switch (comparison.outcome) {
    case Outcome::in_lanes:
      lanes.add(comparison.lanes);
      scalar.add(comparison.scalar);
      reference_steps += comparison.reference_steps;
      lanes_to_scalar.push_back(ratio(comparison.lanes.seconds, comparison.scalar.seconds));
      break;
    case Outcome::not_in_lanes:
      ++not_in_lanes[comparison.reason];
      break;
    case Outcome::timed_out:
      ++timed_out;
      break;
    case Outcome::refused:
      ++refused[comparison.reason];
      break;
  }
}

std::vector<Row> rows_of(const Sums& sums) {
  const std::uint64_t all = sums.photons;
  return {{"other fate, object or crossings", sums.other_way, all, 3e-5},
          {"direction off by over 1 tolerance", sums.over1, all, 1e-3},
          {"over 10 tolerances", sums.over10, all, 5e-5},
          {"over 100 tolerances", sums.over100, all, 5e-6},
          {"scenes with p99 above the tolerance", sums.scenes_over, sums.scenes, 5e-3},
          {"unexplained ways", sums.unexplained_ways, all, 5e-6},
          {"unexplained directions", sums.unexplained_directions, all, 5e-6}};
}

std::string table_of(const std::string& title, const Tally& tally) {
  std::string text = fmt::format("== {}\n{:<37}{:>22}{:>22}{:>12}\n", title, "", "lanes",
                                 "scalar engine", "at most");
  const std::vector<Row> lanes = rows_of(tally.lanes), scalar = rows_of(tally.scalar);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const auto cell = [](const Row& row) {
      return fmt::format("{:.5f} % ({})", 100.0 * row.share(), row.count);
    };
    text += fmt::format("{:<37}{:>22}{:>22}{:>10.4f} %\n", lanes[i].name, cell(lanes[i]),
                        cell(scalar[i]), 100.0 * lanes[i].most);
  }
  return text + fmt::format("photons: {}\n", tally.lanes.photons) + note_of(tally);
}

std::string kinds_of(const std::vector<Entry>& entries) {
  std::map<std::string, Tally> kinds;
  for (const Entry& entry : entries) kinds[entry.kind].add(entry.comparison);
  std::string text =
      fmt::format("{:<16}{:>7}{:>9}{:>11}{:>10}{:>10}{:>10}{:>8}{:>12}\n", "kind", "scenes",
                  "in lanes", "other way", "over 1", "over 10", "over 100", "p99", "unexplained");
  for (const auto& [kind, tally] : kinds) {
    const Sums& sums = tally.lanes;
    const auto percent = [&](std::uint64_t count) {
      return 100.0 * ratio(static_cast<double>(count), static_cast<double>(sums.photons));
    };
    text += fmt::format("{:<16}{:>7}{:>9}{:>9.4f} %{:>8.3f} %{:>8.4f} %{:>8.4f} %{:>8}{:>12}\n",
                        kind, tally.scenes, sums.scenes, percent(sums.other_way),
                        percent(sums.over1), percent(sums.over10), percent(sums.over100),
                        sums.scenes_over, sums.unexplained_ways + sums.unexplained_directions);
  }
  return text;
}

std::string in_words(const Difference& difference) {
  return fmt::format("{}{}", difference.unexplained ? "unexplained, " : "",
                     difference.other_way
                         ? std::string("another way")
                         : fmt::format("{:.3g} tolerances off", difference.tolerances));
}

bool holds(const Tally& tally) {
  const auto hold = [](const Sums& sums) {
    const std::vector<Row> rows = rows_of(sums);
    return std::all_of(rows.begin(), rows.end(),
                       [](const Row& row) { return row.share() <= row.most; });
  };
  return hold(tally.lanes) && hold(tally.scalar);
}

std::vector<Entry> worst_of(const std::vector<Entry>& entries, Engine engine, std::size_t count) {
  std::vector<Entry> worst;
  std::copy_if(entries.begin(), entries.end(), std::back_inserter(worst), [&](const Entry& entry) {
    return entry.comparison.of(engine).worst_difference.counts();
  });
  std::stable_sort(worst.begin(), worst.end(), [&](const Entry& a, const Entry& b) {
    const Column &x = a.comparison.of(engine), &y = b.comparison.of(engine);
    const auto rank = [](const Column& c) {
      return std::tuple(c.unexplained_ways, c.unexplained_directions);
    };
    return rank(x) == rank(y) ? is_worse(x.worst_difference, y.worst_difference)
                              : rank(x) > rank(y);
  });
  worst.resize(std::min(count, worst.size()));
  return worst;
}

std::string lines_of(const std::vector<Entry>& entries, Engine engine) {
  const bool lanes = engine == Engine::automatic;
  std::string text;
  for (const Entry& entry : entries) {
    const Column& column = entry.comparison.of(engine);
    const Column& other = entry.comparison.of(lanes ? Engine::scalar : Engine::automatic);
    text += fmt::format(
        "--only {:<6} {:<14} photon {:>5}: {}; p99 {:.3g}, unexplained {} + {}; {}: {}\n",
        entry.index, entry.kind, column.worst, in_words(column.worst_difference), column.p99,
        column.unexplained_ways, column.unexplained_directions, lanes ? "scalar" : "lanes",
        in_words(other.worst_difference));
  }
  return text;
}

std::string json_of(const std::vector<Entry>& entries) {
  static constexpr const char* outcomes[] = {"in lanes", "not in lanes", "timed out", "refused"};
  const auto column = [](const Column& c) {
    return fmt::format(
        R"({{"photons": {}, "other_way": {}, "over1": {}, "over10": {}, "over100": {}, )"
        R"("unexplained_ways": {}, "unexplained_directions": {}, "p99": {}, "seconds": {:.6g}, )"
        R"("steps": {}, "worst": {}, "worst_unexplained": {}, "worst_other_way": {}, )"
        R"("worst_tolerances": {}}})",
        c.photons, c.other_way, c.over1, c.over10, c.over100, c.unexplained_ways,
        c.unexplained_directions, std::isfinite(c.p99) ? c.p99 : 1e300, c.seconds, c.steps, c.worst,
        c.worst_difference.unexplained, c.worst_difference.other_way,
        std::isfinite(c.worst_difference.tolerances) ? c.worst_difference.tolerances : 1e300);
  };
  std::string text = "{\"scenes\": [";
  for (const Entry& entry : entries) {
    const Comparison& c = entry.comparison;
    text +=
        fmt::format("{}\n{{\"index\": {}, \"kind\": \"{}\", \"outcome\": \"{}\", \"reason\": {}",
                    &entry == &entries.front() ? "" : ",", entry.index, entry.kind,
                    outcomes[static_cast<std::size_t>(c.outcome)], nlohmann::json(c.reason).dump());
    if (c.outcome == Outcome::in_lanes)
      text += fmt::format(", \"reference_steps\": {}, \"lanes\": {}, \"scalar\": {}",
                          c.reference_steps, column(c.lanes), column(c.scalar));
    text += "}";
  }
  return text + "\n]}\n";
}

}  // namespace portalens::differential
