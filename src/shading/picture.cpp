#include "shading/picture.h"

#include <algorithm>
#include <cmath>

namespace portalens {
namespace {

/// The remainder of the floored division, in [0, period).
double wrapped(double x, double period) {
  const double rest = x - std::floor(x / period) * period;
  return rest >= 0.0 && rest < period ? rest : 0.0;
}

Rgb mixed_colors(Rgb a, Rgb b, double share) { return a * (1.0 - share) + b * share; }

/// The two whole neighbours of a continuous coordinate, and the share of the second.
struct Neighbours {
  int first = 0, second = 0;
  double share = 0.0;
};

Neighbours repeated(double x, int count) {
  const double low = std::floor(x - 0.5);
  const int first = static_cast<int>(wrapped(low, count));
  return {first, (first + 1) % count, (x - 0.5) - low};
}

Neighbours clamped(double x, int count) {
  // What is no number counts as 0: it is looked at no place that is none.
  const double place = x > 0.5 ? std::min(x - 0.5, count - 1.0) : 0.0;
  const int first = static_cast<int>(place);
  return {first, std::min(first + 1, count - 1), place - first};
}

/// A coordinate of a picture that does not repeat, and the centres of whose outermost pixels are
/// its edges.
double within(double x, Wrap wrap, int count) {
  const double turned = wrapped(x, 2.0);
  const double place = wrap == Wrap::clamp ? x : turned > 1.0 ? 2.0 - turned : turned;
  const double edge = 0.5 / count;
  return place > edge ? std::min(place, 1.0 - edge) : edge;  // what is no number lies there, too
}

}  // namespace

Rgb bilinear(const Image& image, double x, double y, Rows rows) {
  const Neighbours column = repeated(x, image.width);
  const Neighbours row =
      rows == Rows::repeat ? repeated(y, image.height) : clamped(y, image.height);
  const Rgb top = mixed_colors(pixel(image, column.first, row.first),
                               pixel(image, column.second, row.first), column.share);
  const Rgb bottom = mixed_colors(pixel(image, column.first, row.second),
                                  pixel(image, column.second, row.second), column.share);
  return mixed_colors(top, bottom, row.share);
}

Rgb Picture::at(double u, double v) const {
  const double x = wrapped(u, 1.0) * image->width;
  const double y = (1.0 - wrapped(v, 1.0)) * image->height;
  return bilinear(*image, x, y, Rows::repeat) * scale;
}

Rgb Picture::placed_at(const SurfacePoint& point) const {
  const bool by_lengths = placement->size && point.flat;
  const double right = (by_lengths ? point.along : point.u) - placement->offset[0];
  const double up = (by_lengths ? point.across : point.v) - placement->offset[1];
  const auto [width, height] = placement->size.value_or(std::array{1.0, 1.0});
  const double u = (right * placement->cosine + up * placement->sine) / width;
  const double v = (up * placement->cosine - right * placement->sine) / height;
  if (!std::isfinite(u) || !std::isfinite(v)) return at(0.0, 0.0);
  if (placement->wrap == Wrap::repeat) return at(u, v);
  return at(within(u, placement->wrap, image->width), within(v, placement->wrap, image->height));
}

}  // namespace portalens
