#include "differential/compare.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>
#include <tuple>

#include "differential/way.h"

namespace portalens::differential {
namespace {

constexpr int jittered_starts = 8;
constexpr double jitter = 3.0;       // tolerances
constexpr std::size_t portion = 16;  // photons between two looks at the clock

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Difference plain_difference(const Arrival& found, const Arrival& exact, double tolerance) {
  Difference difference;
  difference.other_way = !same_way(found, exact);
  if (!difference.other_way) difference.tolerances = direction_apart(found, exact) / tolerance;
  return difference;
}

/// Whether starts aside of the photon's spread as far as that.
bool is_explained(const Stage& stage, const Photon& photon, const Arrival& found,
                  const Arrival& exact, const Difference& difference) {
  const double tolerance = stage.own.space.physics.tolerance;
  const Vec3d axis = std::fabs(photon.direction.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d right = normalize(cross(photon.direction, axis));
  const Vec3d up = cross(right, photon.direction);
  for (int i = 0; i < jittered_starts; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / jittered_starts;
    Photon aside = photon;
    aside.direction = normalize(
        photon.direction + jitter * tolerance * (std::cos(angle) * right + std::sin(angle) * up));
    const Arrival arrival = exact_arrival(stage, aside);
    if (difference.other_way ? same_way(arrival, found)
                             : angle_between(arrival, exact) >= difference.tolerances * tolerance)
      return true;
  }
  return false;
}

Column column_of(const Stage& stage, std::span<const Arrival> found,
                 std::span<const Arrival> exact) {
  Column column;
  column.photons = found.size();
  std::vector<double> apart;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Difference difference = difference_of(stage, stage.photons[i], found[i], exact[i]);
    column.steps += found[i].steps;
    column.other_way += difference.other_way;
    column.over1 += difference.tolerances > 1.0;
    column.over10 += difference.tolerances > 10.0;
    column.over100 += difference.tolerances > 100.0;
    if (difference.unexplained)
      ++(difference.other_way ? column.unexplained_ways : column.unexplained_directions);
    if (is_worse(difference, column.worst_difference)) {
      column.worst = i;
      column.worst_difference = difference;
    }
    apart.push_back(difference.other_way ? std::numeric_limits<double>::infinity()
                                         : difference.tolerances);
  }
  const auto p99 = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() * 99 / 100);
  std::nth_element(apart.begin(), p99, apart.end());
  column.p99 = *p99;
  return column;
}

/// @return seconds of processor time
double traced(const Stage& stage, Engine engine, std::vector<Arrival>& arrivals) {
  arrivals.resize(stage.photons.size());
  const double start = thread_seconds();
  advance(stage.own.space, stage.photons, arrivals, engine);
  return thread_seconds() - start;
}

/// @return false if it takes too long
bool trace_exactly(const Stage& stage, double limit, std::vector<Arrival>& arrivals) {
  arrivals.resize(stage.photons.size());
  const double end = thread_seconds() + limit;
  for (std::size_t i = 0; i < arrivals.size(); i += portion) {
    const std::size_t count = std::min(portion, arrivals.size() - i);
    advance(stage.exact.space, std::span(stage.photons).subspan(i, count),
            std::span(arrivals).subspan(i, count), Engine::scalar);
    if (thread_seconds() > end) return false;
  }
  return true;
}

}  // namespace

bool is_worse(const Difference& a, const Difference& b) {
  const auto rank = [](const Difference& d) {
    return std::tuple(d.counts() && d.unexplained, d.other_way, d.tolerances);
  };
  return rank(a) > rank(b);
}

Arrival exact_arrival(const Stage& stage, const Photon& photon) {
  Arrival arrival;
  advance(stage.exact.space, {&photon, 1}, {&arrival, 1}, Engine::scalar);
  return arrival;
}

Difference difference_of(const Stage& stage, const Photon& photon, const Arrival& found,
                         const Arrival& exact) {
  Difference difference = plain_difference(found, exact, stage.own.space.physics.tolerance);
  if (difference.counts())
    difference.unexplained = !is_explained(stage, photon, found, exact, difference);
  return difference;
}

Comparison compare(const Stage& stage, double limit) {
  Comparison comparison;
  if (!takes_lanes(stage.own.space, Engine::automatic)) {
    comparison.outcome = Outcome::not_in_lanes;
    comparison.reason = why_no_lanes(stage.own.space, Engine::automatic);
    return comparison;
  }
  std::vector<Arrival> lanes, scalar, exact;
  // The first time also pays for what is only needed once.
  double lanes_seconds = traced(stage, Engine::automatic, lanes);
  lanes_seconds = std::min(lanes_seconds, traced(stage, Engine::automatic, lanes));
  const double scalar_seconds = traced(stage, Engine::scalar, scalar);
  if (!trace_exactly(stage, limit, exact)) {
    comparison.outcome = Outcome::timed_out;
    return comparison;
  }
  comparison.outcome = Outcome::in_lanes;
  comparison.lanes = column_of(stage, lanes, exact);
  comparison.lanes.seconds = lanes_seconds;
  comparison.scalar = column_of(stage, scalar, exact);
  comparison.scalar.seconds = scalar_seconds;
  for (const Arrival& arrival : exact) comparison.reference_steps += arrival.steps;
  return comparison;
}

}  // namespace portalens::differential
