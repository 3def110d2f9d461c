#include "io/obj_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "io/tokens.h"

namespace portalens {
namespace {

/// A thousand small faces have far fewer; a longer list is not kept.
constexpr std::size_t max_points = std::size_t{1} << 20;

/// Of a quad's longest edge: so far from their plane its vertices may be.
constexpr double flat = 1e-6;

bool is_bent(const std::array<Vec3d, 4>& v) {
  const Vec3d area = cross(v[1] - v[0], v[2] - v[0]) + cross(v[2] - v[0], v[3] - v[0]);
  double longest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) longest = std::fmax(longest, length(v[(i + 1) % 4] - v[i]));
  if (!(length(area) > 0.0)) return false;
  const Vec3d normal = normalize(area);
  return std::any_of(v.begin(), v.end(), [&](Vec3d vertex) {
    return std::fabs(dot(vertex - v[0], normal)) > flat * longest;
  });
}

}  // namespace

void PlainFaces::take(const std::vector<std::string_view>& words) {
  if (!plain_) return;
  const std::string_view word = words[0];
  if (word == "f") {
    take_face(words);
  } else if (word == "v") {
    std::array<double, 3> point{};
    plain_ = words.size() == 4 && points_.size() < max_points;
    for (std::size_t i = 0; plain_ && i < 3; ++i) {
      const auto number = parse_number(words[i + 1]);
      plain_ = number.has_value();
      point[i] = number.value_or(0.0);
    }
    points_.push_back(to_vec3(point));
  } else if (word == "vt") {
    plain_ = std::all_of(words.begin() + 1, words.end(),
                         [](std::string_view one) { return parse_number(one).has_value(); });
  } else {
    plain_ = false;
  }
}

void PlainFaces::take_face(const std::vector<std::string_view>& words) {
  std::array<Vec3d, 4> corners;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto index = parse_integer(words[i].substr(0, words[i].find('/')));
    plain_ &= index.has_value();
    if (!index || *index < 1 || *index > static_cast<std::int64_t>(points_.size())) return;
    if (i <= 4) corners[i - 1] = points_[static_cast<std::size_t>(*index) - 1];
  }
  if (words.size() == 5) bent_ |= is_bent(corners);
}

}  // namespace portalens
