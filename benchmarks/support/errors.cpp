#include "support/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <vector>

#include "core/error.h"

namespace portalens::benchmarks {

Errors errors_of(std::span<const Arrival> arrivals, std::span<const Arrival> exact, double pixel) {
  assert(arrivals.size() == exact.size());
  std::vector<double> apart;
  std::size_t unlike = 0;
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    const Arrival &a = arrivals[i], &b = exact[i];
    if (a.fate != b.fate || a.met != b.met || a.object != b.object || a.crossings != b.crossings)
      ++unlike;
    else if (a.fate == Fate::escaped)
      apart.push_back(length(a.direction - b.direction) / pixel);
    else if (a.fate == Fate::hit)
      apart.push_back(length(a.position - b.position) / (b.length * pixel));
  }
  Errors errors;
  if (!arrivals.empty())
    errors.mismatch = static_cast<double>(unlike) / static_cast<double>(arrivals.size());
  if (apart.empty()) return errors;
  std::sort(apart.begin(), apart.end());
  errors.median = apart[apart.size() / 2];
  errors.p99 = apart[apart.size() * 99 / 100];
  errors.p9999 = apart[apart.size() * 9999 / 10000];
  errors.most = apart.back();
  return errors;
}

void demand_sound(const Errors& errors, const std::string& what, double pixels) {
  if (errors.mismatch <= 0.01 && errors.median <= 0.1 * pixels && errors.p99 <= pixels) return;
  throw WorkError(
      fmt::format("{} is wrong and was not timed: mismatch {:.3g}, median {:.3g} px, p99 {:.3g} px",
                  what, errors.mismatch, errors.median, errors.p99));
}

double pixel_angle(const World& world) {
  const int width = world.film.width, height = world.film.height;
  const Ray one = world.camera.ray(0.5 * width, 0.5 * height, width, height);
  const Ray next = world.camera.ray(0.5 * width, 0.5 * height + 1.0, width, height);
  return length(one.direction - next.direction);
}

}  // namespace portalens::benchmarks
