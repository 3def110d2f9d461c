#include "app/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace portalens {

std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(std::clamp(seconds, 0.0, 3.6e9)));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string rounded_count(double count) {
  const char* unit = "";
  for (const char* larger : {" k", " M", " G", " T"}) {
    if (count < 999.5) break;
    count /= 1000.0;
    unit = larger;
  }
  const int decimals = *unit == '\0' || count >= 99.95 ? 0 : count >= 9.995 ? 1 : 2;
  return fmt::format("{:.{}f}{}", count, decimals, unit);
}

std::string progress_line(std::size_t done, std::size_t total, std::size_t photons, double seconds,
                          std::size_t before) {
  constexpr std::size_t width = 24;
  const double share = static_cast<double>(done) / static_cast<double>(total);
  const auto filled = static_cast<std::size_t>(share * width);
  std::string line = fmt::format("[{}{}] {:3.0f}%", std::string(filled, '#'),
                                 std::string(width - filled, '.'), std::floor(100.0 * share));
  if (seconds <= 0.0 || done == before) return line;
  const auto left = static_cast<double>(total - done) / static_cast<double>(done - before);
  return line + fmt::format("  {} photons/s  {} left",
                            rounded_count(static_cast<double>(photons) / seconds),
                            clock_text(seconds * left));
}

ProgressBar::ProgressBar(std::size_t before, const Tally& tally)
    : before_(before), photons_before_(tally.photons), start_(Clock::now()), drawn_(start_) {}

ProgressBar::~ProgressBar() { std::fputs("\r\033[K", stderr); }

void ProgressBar::advanced(std::size_t done, std::size_t total, const Tally& tally) {
  const auto now = Clock::now();
  if (done < total && now - drawn_ < std::chrono::milliseconds(200)) return;
  drawn_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::fputs(
      ("\r\033[K" + progress_line(done, total, tally.photons - photons_before_, seconds, before_))
          .c_str(),
      stderr);
  std::fflush(stderr);
}

bool errors_go_to_a_terminal() { return isatty(STDERR_FILENO) == 1; }

}  // namespace portalens
