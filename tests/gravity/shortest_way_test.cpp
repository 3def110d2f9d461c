#include "gravity/shortest_way.h"

#include <gtest/gtest.h>

#include <optional>

#include "gravity/clear_passage.h"
#include "gravity/plain_closest_point.h"
#include "gravity/portal_scenes.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

/// Minimum of a convex function by golden sections, its value exact to the square of what the
/// place lacks.
template <class F>
double golden_minimum(F f, double low, double high) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double fa = f(a), fb = f(b);
  for (int i = 0; i < 60; ++i) {
    if (fa < fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - ratio * (high - low);
      fa = f(a);
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + ratio * (high - low);
      fb = f(b);
    }
  }
  return std::min({fa, fb, f(0.0), f(1.0)});
}

double height(const Portal& portal, Vec3d x) {
  return dot(x - portal.vertices[0], portal.frame.normal);
}

/// Where along a-b the segment passes the face from front to back.
std::optional<double> passes(const Portal& portal, Vec3d a, Vec3d b) {
  const double tolerance = 1e-9 * portal.longest_edge;
  const double ha = height(portal, a), hb = height(portal, b);
  if (ha < -tolerance || hb > tolerance) return std::nullopt;
  const double t = ha > 0.0 ? ha / (ha - std::min(hb, 0.0)) : 0.0;
  const Vec3d y = a + (b - a) * t;
  for (std::size_t i = 0; i < portal.vertices.size(); ++i) {
    const Vec3d edge = portal.vertices[(i + 1) % portal.vertices.size()] - portal.vertices[i];
    if (dot(cross(edge, y - portal.vertices[i]), portal.frame.normal) < 0.0) return std::nullopt;
  }
  return t;
}

double plain_way(Vec3d x, Vec3d p, const Portal& portal) {
  if (passes(portal, x, p)) return length(p - x);
  double best = boundless;
  for (std::size_t i = 0; i < portal.vertices.size(); ++i) {
    const Vec3d a = portal.vertices[i];
    const Vec3d edge = portal.vertices[(i + 1) % portal.vertices.size()] - a;
    best = std::min(best, golden_minimum(
                              [&](double t) {
                                const Vec3d y = a + edge * t;
                                return length(x - y) + length(y - p);
                              },
                              0.0, 1.0));
  }
  return best;
}

double found_way(Vec3d x, Vec3d p, FaceRow faces) {
  Turns turns;
  if (!shortest_passages(x, p, faces, boundless, turns)) return boundless;
  return follow(x, p, faces, turns).length;
}

TEST(ShortestWay, ThroughOneFaceIsTheMinimumOverTheFace) {
  Random random(11);
  int straight = 0;
  for (int round = 0; round < scaled(100000); ++round) {
    const Portal portal = portal_on(random_polygon(random, 1.0));
    const PortalFace face(portal);
    const PortalFace* row[] = {&face};
    Vec3d x = random.point(4.0), p = random.point(4.0);
    if (round % 7 == 0) x -= portal.frame.normal * height(portal, x);
    if (round % 11 == 0) p -= portal.frame.normal * height(portal, p);
    if (round % 13 == 0) p = portal.frame.origin;
    if (round % 5 == 0) {
      x = portal.frame.to_world({random.uniform(-1, 1), random.uniform(-1, 1), 2.0});
      p = portal.frame.to_world({random.uniform(-1, 1), random.uniform(-1, 1), -1.0});
    }
    const double expected = plain_way(x, p, portal);
    ASSERT_NEAR(found_way(x, p, row), expected, 1e-9 * expected) << round;
    straight += expected == length(p - x);
  }
  EXPECT_GT(straight, scaled(100000) / 20);
}

/// The shortest path over sampled rims by dynamic programming, the samples drawn together around
/// the best way again and again. Every path it tries is allowed, so it is never too short.
class SampledRims {
 public:
  SampledRims(Vec3d x, Vec3d p, const std::vector<Portal>& faces) : x_(x), p_(p), faces_(faces) {}

  double shortest() {
    double best = boundless;
    const int first = static_cast<int>(faces_.front().vertices.size());
    const int last = static_cast<int>(faces_.back().vertices.size());
    for (int i = -1; i < first; ++i)
      for (int j = -1; j < last; ++j) best = std::min(best, shortest_by(i, j));
    return best;
  }

 private:
  static constexpr int samples = 24;
  struct Sample {
    Vec3d point;
    int edge;
    double t, cost;
    std::size_t face_before, before;
  };
  struct Window {
    int edge = -2;  ///< -2 all edges, -1 none: the face is passed straight
    double low = 0.0, high = 1.0;
  };

  double shortest_by(int first_edge, int last_edge) {
    std::vector<Window> windows(faces_.size());
    windows.front().edge = first_edge;
    windows.back().edge = last_edge;
    if (faces_.size() == 1 && first_edge != last_edge) return boundless;
    double best = boundless;
    for (int zoom = 0; zoom < 9; ++zoom) {
      const double length = sweep(windows, zoom);
      if (length == boundless) break;
      best = std::min(best, length);
    }
    return best;
  }

  std::vector<Sample> sampled(std::size_t face, const Window& window) const {
    std::vector<Sample> result;
    const std::vector<Vec3d>& v = faces_[face].vertices;
    for (int e = 0; e < static_cast<int>(v.size()); ++e) {
      if (window.edge != -2 && window.edge != e) continue;
      for (int i = 0; i <= samples; ++i) {
        const double t = window.low + (window.high - window.low) * i / samples;
        const auto k = static_cast<std::size_t>(e);
        result.push_back({v[k] + (v[(k + 1) % v.size()] - v[k]) * t, e, t, boundless, 0, 0});
      }
    }
    return result;
  }

  /// True if the segment passes straight through the faces from `low` up to `high`, in order.
  bool open(Vec3d a, Vec3d b, std::size_t low, std::size_t high) const {
    double last = 0.0;
    for (std::size_t i = low; i < high; ++i) {
      const std::optional<double> t = passes(faces_[i], a, b);
      if (!t || *t < last - 1e-12) return false;
      last = *t;
    }
    return true;
  }

  /// The shortest path with rim points out of the windows, which then close in on it.
  double sweep(std::vector<Window>& windows, int zoom) const {
    const std::size_t none = faces_.size();
    std::vector<std::vector<Sample>> rims;
    for (std::size_t f = 0; f < faces_.size(); ++f) rims.push_back(sampled(f, windows[f]));
    rims.push_back({{p_, 0, 0.0, boundless, 0, 0}});
    for (std::size_t f = 0; f < rims.size(); ++f)
      for (Sample& sample : rims[f]) {
        if (open(x_, sample.point, 0, f)) {
          sample.cost = length(sample.point - x_);
          sample.face_before = none;
        }
        for (std::size_t g = 0; g < f; ++g)
          for (std::size_t i = 0; i < rims[g].size(); ++i) {
            const double cost = rims[g][i].cost + length(sample.point - rims[g][i].point);
            if (!(cost < sample.cost) || !open(rims[g][i].point, sample.point, g + 1, f)) continue;
            sample.cost = cost;
            sample.face_before = g;
            sample.before = i;
          }
      }
    const Sample* at = &rims.back()[0];
    const double best = at->cost;
    if (best == boundless) return best;
    const double width = 2.0 * std::pow(3.0 / samples, zoom + 1);
    for (Window& window : windows) window.edge = -1;
    while (at->face_before != none) {
      Window& window = windows[at->face_before];
      at = &rims[at->face_before][at->before];
      window = {at->edge, std::max(0.0, at->t - width), std::min(1.0, at->t + width)};
    }
    return best;
  }

  Vec3d x_, p_;
  const std::vector<Portal>& faces_;
};

/// True if the path found keeps to the rules: its bends lie on rims, and it passes all other faces
/// straight and in order.
bool keeps_the_rules(Vec3d x, Vec3d p, FaceRow faces, const std::vector<Portal>& portals) {
  Turns turns;
  if (!shortest_passages(x, p, faces, boundless, turns)) return false;
  const Polyline way = bends(x, p, faces, turns);
  std::size_t bend = 0;
  Vec3d last = x, next = way.count > 0 ? way.point(0) : p;
  double reached = 0.0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (turns[i].kind == Turn::Kind::straight) {
      const std::optional<double> t = passes(portals[i], last, next);
      if (!t || *t < reached - 1e-12) return false;
      reached = *t;
    } else {
      if (length(next - Plain::on_rim(next, portals[i].vertices)) > 1e-12) return false;
      last = next;
      ++bend;
      next = bend < way.count ? way.point(bend) : p;
      reached = 0.0;
    }
  }
  return bend == way.count;
}

/// True if an edge of the polygon passes through the face, from either side.
bool cuts(const Portal& face, const std::vector<Vec3d>& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (passes(face, a, b) || passes(face, b, a)) return true;
  }
  return false;
}

void expect_shortest_through(std::size_t count, int rounds, std::uint64_t seed) {
  Random random(seed);
  int close = 0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Portal> portals;
    std::vector<PortalFace> faces;
    for (std::size_t i = 0; i < count; ++i) {
      // Faces that cut each other are left out: they have paths that only just keep their order.
      std::vector<Vec3d> polygon;
      do {
        polygon = random_polygon(random, 1.5);
      } while (std::any_of(portals.begin(), portals.end(), [&](const Portal& other) {
        return cuts(other, polygon) || cuts(portal_on(polygon), other.vertices);
      }));
      if (round % 2 == 0) {
        // A row that much can be seen through: each looks back along z.
        polygon.clear();
        const Vec3d middle = random.point(0.6) + Vec3d{0, 0, -1.5 * static_cast<double>(i)};
        for (const auto& [dx, dy] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
          polygon.push_back(middle + Vec3d{dx * 1.0, dy * 0.8, dx * 0.2});
      }
      portals.push_back(portal_on(polygon));
      faces.emplace_back(portals.back());
    }
    std::vector<const PortalFace*> row;
    for (const PortalFace& face : faces) row.push_back(&face);
    const Vec3d x = random.point(2.0) + Vec3d{0, 0, 1.5};
    const Vec3d p = random.point(2.0) + Vec3d{0, 0, -1.5 * static_cast<double>(count)};
    const double expected = SampledRims(x, p, portals).shortest();
    const double found = found_way(x, p, row);
    ASSERT_LE(found, expected * (1.0 + 1e-12)) << round;
    ASSERT_TRUE(keeps_the_rules(x, p, row, portals)) << round;
    close += found > expected * (1.0 - 1e-6);
  }
  // The samples may miss a path that has little room; it is then shorter, and keeps the rules.
  EXPECT_GE(close, 0.97 * rounds);
}

TEST(ShortestWay, ThroughTwoFacesIsTheMinimumOverTheRims) {
  expect_shortest_through(2, scaled(100), 12);
}

TEST(ShortestWay, ThroughThreeFacesIsTheMinimumOverTheRims) {
  expect_shortest_through(3, scaled(20), 13);
}

TEST(ShortestWay, OverARimThatTwoFacesShareGoesStraightOnFromOneToTheOther) {
  Random random(14);
  for (int round = 0; round < scaled(200); ++round) {
    // Two squares that meet in an edge, passed from the side where neither is open.
    const PortalFace a(portal_on({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    const PortalFace b(portal_on({{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}));
    const PortalFace* row[] = {&a, &b};
    const Vec3d x{1.5, random.uniform(0.2, 0.8), -random.uniform(0.1, 1.0)};
    const Vec3d p{1.0 + random.uniform(0.2, 1.0), random.uniform(0.2, 0.8), 0.0};
    const double over_edge =
        std::hypot(std::hypot(x.x - 1.0, x.z) + std::hypot(p.x - 1.0, p.z), x.y - p.y);
    EXPECT_NEAR(found_way(x, p, row), over_edge, 1e-9 * over_edge);
  }
}

TEST(ShortestWay, GivesUpBeyondItsLimit) {
  Random random(15);
  for (int round = 0; round < scaled(500); ++round) {
    const PortalFace a(portal_on(random_polygon(random, 1.0)));
    const PortalFace b(portal_on(random_polygon(random, 1.0)));
    const PortalFace* row[] = {&a, &b};
    const Vec3d x = random.point(3.0), p = random.point(3.0);
    for (const FaceRow faces : {FaceRow(row, 1), FaceRow(row, 2)}) {
      const double way = found_way(x, p, faces);
      Turns turns;
      EXPECT_TRUE(shortest_passages(x, p, faces, way * 1.000001, turns));
      EXPECT_FALSE(shortest_passages(x, p, faces, way * 0.999999, turns));
    }
  }
}

/// Whether a path slides from one to the other: they are equal, or a vertex and an edge that ends
/// in it.
bool are_neighbours(Turn a, Turn b, std::uint32_t count) {
  if (a.kind == Turn::Kind::edge) std::swap(a, b);
  if (a.kind != Turn::Kind::vertex || b.kind != Turn::Kind::edge)
    return a.kind == b.kind && a.index == b.index;
  return b.index == a.index || (b.index + 1) % count == a.index;
}

TEST(ShortestWay, DoesNotJumpWithinItsCalm) {
  Random random(24);
  int moved = 0;
  for (int round = 0; round < scaled(20000); ++round) {
    const Portal portal = portal_on(random_polygon(random, 1.0));
    const PortalFace face(portal);
    const PortalFace* faces = &face;
    const Vec3d to = random.point(3.0), from = random.point(3.0);
    const double distance_to_discontinuity = clear_passage(from, to, face);
    const Vec3d there = from + random.direction() * (std::min(distance_to_discontinuity, 3.0) *
                                                     random.uniform(0.5, 1.0) * (1.0 - 1e-9));
    Turns here{}, aside{};
    ASSERT_TRUE(shortest_passages(from, to, {&faces, 1}, boundless, here));
    ASSERT_TRUE(shortest_passages(there, to, {&faces, 1}, boundless, aside));
    ASSERT_TRUE(are_neighbours(here[0], aside[0], portal.vertices.size())) << round;
    moved += distance_to_discontinuity > 0.1;
  }
  EXPECT_GT(moved, scaled(20000) / 3);
}

}  // namespace
}  // namespace portalens::test
