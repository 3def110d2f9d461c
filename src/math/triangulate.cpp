#include "math/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace portalens {
namespace {

using Triangle = std::array<std::size_t, 3>;

/// Ears of a polygon in the plane it mostly lies in.
class EarClipper {
 public:
  explicit EarClipper(const std::vector<Vec3d>& points) : left_(points.size()) {
    flatten(points);
    std::iota(left_.begin(), left_.end(), std::size_t{0});
  }

  [[nodiscard]] bool convex() const {
    for (std::size_t i = 0; i < left_.size(); ++i) {
      if (turn(i) < 0.0) return false;
    }
    return true;
  }

  std::vector<Triangle> clip() {
    std::vector<Triangle> triangles;
    // `at` stays beside the last cut, where the next ear is likely; after a whole round without one
    // less is asked of an ear. In the end the polygon crosses itself, and whatever corner comes is
    // cut. So it is when the work is out of all proportion: a file made to be slow must not be.
    std::size_t at = 0, refused = 0, work = 0;
    const std::size_t max_work = 32 * left_.size() * left_.size();
    Asked asked = Asked::nothing_on_its_edges;
    while (left_.size() > 3) {
      at %= left_.size();
      work += left_.size();
      if (work >= max_work) asked = Asked::nothing;
      if (asked != Asked::nothing && !is_ear(at, asked)) {
        ++at;
        if (++refused < left_.size()) continue;
        refused = 0;
        asked = static_cast<Asked>(static_cast<int>(asked) + 1);
        continue;
      }
      triangles.push_back(corner(at));
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
      refused = 0;
      asked = Asked::nothing_on_its_edges;
      at = at > 0 ? at - 1 : 0;
    }
    triangles.push_back({left_[0], left_[1], left_[2]});
    return triangles;
  }

 private:
  struct Flat {
    double x, y;

    friend bool operator==(const Flat&, const Flat&) = default;
  };
  /// Of the outline, beside an ear; a corner without area is taken where only what lies inside
  /// counts.
  enum class Asked { nothing_on_its_edges, nothing_inside, nothing };

  /// Drops the axis along which the polygon's Newell normal is longest, and keeps the turning.
  void flatten(const std::vector<Vec3d>& points) {
    Vec3d normal;
    for (std::size_t i = 0; i < points.size(); ++i) {
      normal += cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
    }
    const Vec3d size{std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
    for (const Vec3d& p : points) {
      if (size.x >= size.y && size.x >= size.z) {
        flat_.push_back(normal.x > 0 ? Flat{p.y, p.z} : Flat{p.z, p.y});
      } else if (size.y >= size.z) {
        flat_.push_back(normal.y > 0 ? Flat{p.z, p.x} : Flat{p.x, p.z});
      } else {
        flat_.push_back(normal.z > 0 ? Flat{p.x, p.y} : Flat{p.y, p.x});
      }
    }
  }

  [[nodiscard]] Triangle corner(std::size_t at) const {
    const std::size_t n = left_.size();
    return {left_[(at + n - 1) % n], left_[at], left_[(at + 1) % n]};
  }

  /// Twice the signed area.
  [[nodiscard]] double area(std::size_t a, std::size_t b, std::size_t c) const {
    return (flat_[b].x - flat_[a].x) * (flat_[c].y - flat_[a].y) -
           (flat_[b].y - flat_[a].y) * (flat_[c].x - flat_[a].x);
  }

  [[nodiscard]] double turn(std::size_t at) const {
    const Triangle t = corner(at);
    return area(t[0], t[1], t[2]);
  }

  [[nodiscard]] bool is_ear(std::size_t at, Asked asked) const {
    const Triangle t = corner(at);
    const double whole = area(t[0], t[1], t[2]);
    if (whole == 0.0 && asked == Asked::nothing_inside) return true;
    if (whole <= 0.0) return false;
    for (std::size_t i = 0; i < left_.size(); ++i) {
      const std::size_t p = left_[i];
      if (p == t[0] || p == t[1] || p == t[2]) continue;
      const double least =
          std::min({area(t[0], t[1], p), area(t[1], t[2], p), area(t[2], t[0], p)});
      if (least < 0.0) continue;
      // An outline that goes round a hole passes some places twice, on its way there and back.
      const auto* twin =
          std::find_if(t.begin(), t.end(), [&](std::size_t c) { return flat_[c] == flat_[p]; });
      if (twin != t.end() ? leads_into(t, static_cast<std::size_t>(twin - t.begin()), i)
                          : least > 0.0 || asked == Asked::nothing_on_its_edges)
        return false;
    }
    return true;
  }

  /// Whether the outline goes into the triangle from its place `at`, which is that of a corner.
  [[nodiscard]] bool leads_into(const Triangle& t, std::size_t which, std::size_t at) const {
    const std::size_t here = t[which], next = t[(which + 1) % 3], before = t[(which + 2) % 3];
    const Triangle around = corner(at);
    const auto within = [&](std::size_t q) {
      return area(here, next, q) > 0.0 && area(here, before, q) < 0.0;
    };
    return within(around[0]) || within(around[2]);
  }

  std::vector<Flat> flat_;
  std::vector<std::size_t> left_;  ///< vertices not cut off yet, in order
};

std::vector<Triangle> fan(std::size_t count) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 2; i < count; ++i) triangles.push_back({0, i - 1, i});
  return triangles;
}

}  // namespace

std::vector<Triangle> triangulate(const std::vector<Vec3d>& points) {
  if (points.size() == 3) return {{0, 1, 2}};
  EarClipper clipper(points);
  if (!clipper.convex()) return clipper.clip();
  if (points.size() == 4 && length(points[3] - points[1]) < length(points[2] - points[0])) {
    return {{0, 1, 3}, {1, 2, 3}};
  }
  return fan(points.size());
}

}  // namespace portalens
