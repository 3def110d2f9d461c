#include "math/weld.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace portalens {

std::vector<std::uint32_t> welded(const std::vector<Vec3d>& positions) {
  std::vector<std::uint32_t> order(positions.size()), first(positions.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto key = [&](std::uint32_t i) {
    return std::array<double, 3>{positions[i].x, positions[i].y, positions[i].z};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return key(a) != key(b) ? key(a) < key(b) : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  return first;
}

}  // namespace portalens
