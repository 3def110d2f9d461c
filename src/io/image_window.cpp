#include "io/image_window.h"

#include <algorithm>
#include <cstddef>

namespace portalens {
namespace {

/// From the first to before the last.
struct Span {
  std::int64_t first, last;
  [[nodiscard]] bool is_empty() const { return first >= last; }
};

Span shared(std::int64_t a, int a_count, std::int64_t b, int b_count) {
  return {std::max(a, b), std::min(a + a_count, b + b_count)};
}

Span shared_columns(const PixelWindow& a, const PixelWindow& b) {
  return shared(a.x, a.width, b.x, b.width);
}
Span shared_rows(const PixelWindow& a, const PixelWindow& b) {
  return shared(a.y, a.height, b.y, b.height);
}

}  // namespace

bool share_a_pixel(const PixelWindow& a, const PixelWindow& b) {
  return !shared_columns(a, b).is_empty() && !shared_rows(a, b).is_empty();
}

std::vector<float> shown(std::vector<float> pixels, int channels, const PixelWindow& data,
                         const PixelWindow& display) {
  if (data == display) return pixels;
  std::vector<float> result(static_cast<std::size_t>(display.width) *
                            static_cast<std::size_t>(display.height) *
                            static_cast<std::size_t>(channels));
  const Span columns = shared_columns(data, display), rows = shared_rows(data, display);
  if (columns.is_empty()) return result;
  const std::int64_t count = channels * (columns.last - columns.first);
  for (std::int64_t y = rows.first; y < rows.last; ++y) {
    const std::int64_t from = channels * ((y - data.y) * data.width + columns.first - data.x);
    const std::int64_t to =
        channels * ((y - display.y) * display.width + columns.first - display.x);
    std::copy_n(pixels.begin() + from, count, result.begin() + to);
  }
  return result;
}

}  // namespace portalens
