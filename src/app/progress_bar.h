/// \file
/// How far a render is, on one line of a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "render/render.h"

namespace portalens {

/// "0:07", "12:34", "1:02:03".
[[nodiscard]] std::string clock_text(double seconds);

/// "950", "12.3 k", "4.56 M": three digits and a unit.
[[nodiscard]] std::string rounded_count(double count);

/// `[#####...............]  25%  1.2 M photons/s  0:42 left`
/// @param photons, seconds  that it took since `before` was done
/// @pre 0 <= before <= done <= total, total > 0
[[nodiscard]] std::string progress_line(std::size_t done, std::size_t total, std::size_t photons,
                                        double seconds, std::size_t before = 0);

/// Draws that line on standard error, a few times a second, and takes it away in the end.
class ProgressBar : public Progress {
 public:
  /// @param before, tally  what stood before this began
  explicit ProgressBar(std::size_t before = 0, const Tally& tally = {});
  ~ProgressBar() override;
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void advanced(std::size_t done, std::size_t total, const Tally& tally) override;

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t before_;
  std::uint64_t photons_before_;
  Clock::time_point start_, drawn_;
};

/// Whether standard error is a terminal.
[[nodiscard]] bool errors_go_to_a_terminal();

}  // namespace portalens
