/// \file
/// How long something takes.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>
#include <utility>
#include <vector>

namespace portalens::benchmarks {

/// Processor time of all threads of this process so far, seconds: what others do on the machine
/// lengthens it by little.
[[nodiscard]] inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds of wall time since some beginning.
[[nodiscard]] inline double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds of processor time that a call takes.
template <class Call>
[[nodiscard]] double time_of(Call&& call) {
  const double start = processor_seconds();
  std::forward<Call>(call)();
  return processor_seconds() - start;
}

/// The least of several; what takes long, where little disturbs, is done less often.
template <class Call>
[[nodiscard]] double least_time_of(int rounds, const Call& call) {
  constexpr double enough = 2.0;  // seconds together
  double least = std::numeric_limits<double>::infinity(), sum = 0.0;
  for (int round = 0; round < rounds && sum < enough; ++round) {
    const double seconds = time_of(call);
    least = std::min(least, seconds);
    sum += seconds;
  }
  return least;
}

/// @pre values is not empty
[[nodiscard]] inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace portalens::benchmarks
