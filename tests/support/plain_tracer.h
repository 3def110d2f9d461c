/// \file
/// Straight light in rooms of flat things, traced by brute force: it knows which things hang on
/// which wall, and shares no code with what it tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "support/flat_rooms.h"

namespace portalens::test {

/// What straight light meets: a surface, or portals in between; nothing where it escapes.
struct Met {
  std::optional<std::uint32_t> shape;
  std::vector<std::uint32_t> crossed;
  bool lost = false;
  Vec3d position, direction;
  double slope = 0.0;  ///< of the direction and the wall's normal
  std::size_t wall = 0;
};

/// Straight light, one wall after the other.
class PlainTracer {
 public:
  /// @param blur  nothing is told of light that comes so close to an edge
  PlainTracer(const FlatRoom& room, double blur) : room_(room), blur_(blur) {}

  /// None where it comes too close to an edge, or grazes.
  /// @param left  the wall that it starts on, or none
  [[nodiscard]] std::optional<Met> follow(Vec3d from, Vec3d way, std::optional<std::size_t> left,
                                          std::size_t max_crossings) const {
    Met met;
    while (true) {
      const auto found = first(from, way, left);
      if (!found) return std::nullopt;
      met.position = from + way * found->distance;
      met.direction = way;
      met.wall = found->wall;
      if (!found->thing) return met;
      met.slope = dot(way, room_.walls[found->wall].normal);
      if (!found->thing->portal) {
        met.shape = found->thing->index;
        return met;
      }
      if (met.crossed.size() == max_crossings) {
        met.lost = true;
        return met;
      }
      met.crossed.push_back(found->thing->index);
      const auto [wall, beyond] = find_portal(found->thing->pair);
      from = through(found->wall, *found->thing, wall, *beyond, met.position, true);
      way = through(found->wall, *found->thing, wall, *beyond, way, false);
      left = wall;
    }
  }

 private:
  struct Found {
    double distance = 0.0;
    std::size_t wall = 0;
    const Hung* thing = nullptr;
  };

  [[nodiscard]] std::optional<Found> first(Vec3d from, Vec3d way,
                                           std::optional<std::size_t> left) const {
    std::vector<std::pair<double, std::size_t>> planes;
    for (std::size_t i = 0; i < room_.walls.size(); ++i) {
      if (left && *left == i) continue;
      const Wall& wall = room_.walls[i];
      const double slope = dot(way, wall.normal);
      if (std::fabs(slope) < 1e-3) return std::nullopt;
      const double distance = -dot(from - wall.origin, wall.normal) / slope;
      if (std::fabs(distance) < blur_) return std::nullopt;
      if (distance > 0.0) planes.emplace_back(distance, i);
    }
    std::sort(planes.begin(), planes.end());
    for (const auto& [distance, i] : planes) {
      const auto seen = uppermost(room_.walls[i], from + way * distance, way);
      if (!seen) return std::nullopt;
      if (*seen) return Found{distance, i, *seen};
    }
    return Found{};
  }

  /// None where an edge is near, null where nothing is.
  [[nodiscard]] std::optional<const Hung*> uppermost(const Wall& wall, Vec3d place,
                                                     Vec3d way) const {
    const Hung* best = nullptr;
    for (const Hung& thing : wall.things) {
      const double inside = depth(thing.vertices, wall.normal, place);
      if (std::fabs(inside) < blur_) return std::nullopt;
      if (inside < 0.0 || !can_be_met(thing, dot(way, wall.normal))) continue;
      if (!best || comes_before(thing, *best)) best = &thing;
    }
    return best;
  }

  [[nodiscard]] static bool can_be_met(const Hung& thing, double slope) {
    return !thing.portal || thing.two_sided || (thing.faces_out ? slope > 0.0 : slope < 0.0);
  }
  [[nodiscard]] static bool comes_before(const Hung& a, const Hung& b) {
    if (a.portal != b.portal) return a.portal;
    if (a.portal) return a.index < b.index;
    if (a.extent != b.extent) return a.extent < b.extent;
    return a.index > b.index;
  }
  /// How far inside its nearest edge a place lies.
  [[nodiscard]] static double depth(const std::vector<Vec3d>& v, Vec3d normal, Vec3d place) {
    double least = INFINITY;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Vec3d edge = normalize(v[(i + 1) % v.size()] - v[i]);
      least = std::fmin(least, dot(place - v[i], cross(normal, edge)));
    }
    return least;
  }

  [[nodiscard]] std::pair<std::size_t, const Hung*> find_portal(std::uint32_t index) const {
    for (std::size_t i = 0; i < room_.walls.size(); ++i)
      for (const Hung& thing : room_.walls[i].things)
        if (thing.portal && thing.index == index) return {i, &thing};
    return {0, nullptr};
  }

  /// (x, y, z) becomes (-x, y, -z), each in the frame of a portal: right along its first edge.
  [[nodiscard]] Vec3d through(std::size_t wall_a, const Hung& a, std::size_t wall_b, const Hung& b,
                              Vec3d what, bool is_place) const {
    const auto axes = [&](std::size_t wall, const Hung& thing) {
      const Vec3d n = room_.walls[wall].normal * (thing.faces_out ? -1.0 : 1.0);
      const std::size_t last = thing.vertices.size() - 1;
      const Vec3d edge = thing.faces_out ? thing.vertices[last - 1] - thing.vertices[last]
                                         : thing.vertices[1] - thing.vertices[0];
      const Vec3d x = normalize(edge);
      return std::array<Vec3d, 3>{x, cross(n, x), n};
    };
    const auto middle = [](const Hung& thing) {
      Vec3d sum;
      for (const Vec3d& vertex : thing.vertices) sum += vertex - thing.vertices[0];
      return thing.vertices[0] + sum / static_cast<double>(thing.vertices.size());
    };
    const auto from = axes(wall_a, a), to = axes(wall_b, b);
    const Vec3d d = is_place ? what - middle(a) : what;
    const Vec3d moved =
        to[0] * -dot(d, from[0]) + to[1] * dot(d, from[1]) - to[2] * dot(d, from[2]);
    return is_place ? middle(b) + moved : moved;
  }

  const FlatRoom& room_;
  double blur_;
};

}  // namespace portalens::test
