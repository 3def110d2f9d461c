/// \file
/// `closest-point` as a plain recursion, and the closest points that it needs.
#pragma once

#include "gravity/portal_scenes.h"

namespace portalens::test {

/// Physics.md, sec. 5, as plainly as it can be said, sharing nothing with the coupling.
struct Plain {
  const PortalScene& scene;

  static Vec3d on_segment(Vec3d x, Vec3d a, Vec3d b) {
    const double t = dot(x - a, b - a) / dot(b - a, b - a);
    return a + (b - a) * std::clamp(t, 0.0, 1.0);
  }
  static Vec3d on_rim(Vec3d x, const std::vector<Vec3d>& polygon) {
    Vec3d best;
    double least = boundless;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d y = on_segment(x, polygon[i], polygon[(i + 1) % polygon.size()]);
      if (length(x - y) < least) {
        least = length(x - y);
        best = y;
      }
    }
    return best;
  }
  /// In barycentric coordinates inside, else the nearest point of the outline.
  static Vec3d on_triangle(Vec3d x, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d n = cross(b - a, c - a);
    const double u = dot(cross(c - b, x - b), n), v = dot(cross(a - c, x - c), n);
    const double w = dot(cross(b - a, x - a), n);
    if (u >= 0.0 && v >= 0.0 && w >= 0.0) return (a * u + b * v + c * w) / (u + v + w);
    return on_rim(x, {a, b, c});
  }
  static Vec3d on_polygon(Vec3d x, const std::vector<Vec3d>& polygon) {
    Vec3d best;
    double least = boundless;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      const Vec3d y = on_triangle(x, polygon[0], polygon[i], polygon[i + 1]);
      if (length(x - y) < least) {
        least = length(x - y);
        best = y;
      }
    }
    return best;
  }
  static Vec3d closest(Vec3d x, const Portal& portal) {
    const double height = dot(x - portal.vertices[0], portal.frame.normal);
    return height >= -1e-9 * portal.longest_edge ? on_polygon(x, portal.vertices)
                                                 : on_rim(x, portal.vertices);
  }
  double reach(std::size_t a, int k) const {
    if (k == 0) return 0.0;
    const Portal& pair = scene.portals[scene.portals[a].pair];
    double most = 0.0;
    for (const Mass& mass : scene.masses)
      most = std::max(
          most, mass.influence - length(mass.center - on_polygon(mass.center, pair.vertices)));
    for (std::size_t c = 0; c < scene.portals.size(); ++c)
      if (c != scene.portals[a].pair) most = std::max(most, reach(c, k - 1));
    return most;
  }
  Vec3d direct(Vec3d x) const {
    Vec3d sum;
    for (const Mass& mass : scene.masses) {
      const Vec3d d = mass.center - x;
      if (length(d) < mass.influence)
        sum += d * (mass.gm / std::pow(dot(d, d) + mass.core * mass.core, 1.5));
    }
    return sum;
  }
  Vec3d through(Vec3d x, int k, std::size_t left_out) const {
    Vec3d sum;
    if (k == 0) return sum;
    for (std::size_t a = 0; a < scene.portals.size(); ++a) {
      if (a == left_out) continue;
      const Portal& portal = scene.portals[a];
      const Vec3d q = closest(x, portal);
      if (!(length(x - q) < reach(a, k))) continue;
      const Vec3d beyond = portal.motion()->move(q);
      sum += portal.motion()->rotate_back(direct(beyond) + through(beyond, k - 1, portal.pair));
    }
    return sum;
  }
};

}  // namespace portalens::test
