// Couplings through concave faces and ellipses against brute force that shares nothing with them.
#include "support/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "gravity/portal_scenes.h"
#include "gravity/shortest_path_coupling.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

const Frame entrance{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Frame outlet{{9, 1, -2}, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};

PortalScene scene_with(const FaceInput& face) {
  PortalScene scene;
  scene.min_force = 1e-3;
  scene.portals = pair_with(face, entrance, outlet);
  add_mass(scene, {8.0, 1.5, -1.5}, 0.7);
  add_mass(scene, {7.0, 0.2, -2.6}, 0.4, 0.2);
  add_mass(scene, {9.5, 2.0, -1.0}, 0.5);
  return scene;
}

/// Whether a corner list goes round a place of the plane: how often a ray to the right crosses it.
bool goes_round(const std::vector<Vec3d>& corners, Vec3d x) {
  bool odd = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3d a = corners[i], b = corners[(i + 1) % corners.size()];
    if ((a.y > x.y) != (b.y > x.y) && x.x < a.x + (b.x - a.x) * (x.y - a.y) / (b.y - a.y))
      odd = !odd;
  }
  return odd;
}

/// Places of a portal's rim in its own frame, closely one after the other.
std::vector<Vec3d> rim_of(const FaceInput& face, const Portal& portal) {
  if (face.vertices.empty()) return corners_on_ellipse(face.radii[0], face.radii[1], 6000);
  std::vector<Vec3d> corners, rim;
  for (const Vec3d& vertex : portal.vertices) corners.push_back(portal.frame.to_local(vertex));
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (int k = 0; k < 600; ++k)
      rim.push_back(corners[i] + (corners[(i + 1) % corners.size()] - corners[i]) * (k / 600.0));
  return rim;
}

bool holds(const FaceInput& face, const std::vector<Vec3d>& rim, Vec3d x) {
  if (!face.vertices.empty()) return goes_round(rim, x);
  return std::pow(x.x / face.radii[0], 2) + std::pow(x.y / face.radii[1], 2) < 1.0;
}

/// What of a portal is nearest; nothing where two places are as near but for the samples.
std::optional<Vec3d> nearest_of(const FaceInput& face, const Portal& portal, Vec3d place) {
  const std::vector<Vec3d> rim = rim_of(face, portal);
  const Vec3d x = portal.frame.to_local(place);
  if (x.z >= 0.0 && holds(face, rim, x)) return portal.frame.to_world({x.x, x.y, 0.0});
  Vec3d q;
  double least = boundless, second = boundless;
  for (const Vec3d& y : rim)
    if (length(y - x) < least) least = length(y - x), q = y;
  for (const Vec3d& y : rim)
    if (length(y - q) > 0.1) second = std::min(second, length(y - x));
  if (second < least + 1e-3) return std::nullopt;
  return portal.frame.to_world(q);
}

std::vector<FaceInput> new_faces() {
  return {polygon_input(letter_l()),         polygon_input(comb()),
          polygon_input(star(1.5, 0.4)),     ellipse_input(entrance, 1.2, 1.2),
          ellipse_input(entrance, 1.2, 0.6), ellipse_input(entrance, 0.4, 1.5)};
}

TEST(CouplingsOfFaces, ClosestPointIsThatOfBruteForce) {
  Random random(31);
  for (const FaceInput& face : new_faces()) {
    const PortalScene scene = scene_with(face);
    const ClosestPointCoupling coupling(scene.input(1));
    for (int i = 0; i < scaled(40); ++i) {
      const Vec3d x = random.point(2.0);
      Vec3d pull;
      bool sure = true;
      for (const Portal& portal : scene.portals) {
        const auto q = nearest_of(face, portal, x);
        sure = sure && q;
        if (!sure) break;
        Vec3d through;
        for (const Mass& mass : scene.masses) {
          const Vec3d d = mass.center - portal.motion()->move(*q);
          if (length(d) < mass.influence)
            through += d * (mass.gm / std::pow(dot(d, d) + mass.core * mass.core, 1.5));
        }
        pull += portal.motion()->rotate_back(through);
      }
      if (!sure) continue;
      ASSERT_LT(relative_difference(coupling.pull(x, x).acceleration, pull), 2e-3)
          << x.x << ' ' << x.y << ' ' << x.z;
    }
  }
}

TEST(CouplingsOfFaces, ShortestWayIsThatOfBruteForce) {
  Random random(32);
  for (const FaceInput& face : new_faces()) {
    const PortalScene scene = scene_with(face);
    const ShortestPathCoupling coupling(scene.input(1));
    const std::vector<Vec3d> rim = rim_of(face, scene.portals[0]);
    for (int i = 0; i < scaled(60); ++i) {
      const Vec3d x = random.point(2.5);
      for (const auto& image : coupling.images()) {
        if (coupling.chain(image).front() != 0) continue;
        const Vec3d p = image.center;
        double least = boundless;
        for (const Vec3d& y : rim) least = std::min(least, length(y - x) + length(p - y));
        if (x.z >= 0.0 && p.z <= 0.0 && holds(face, rim, x + (p - x) * (x.z / (x.z - p.z))))
          least = length(p - x);
        const Way way = coupling.way(image, x);
        if (least > 0.999 * image.influence) continue;
        ASSERT_NEAR(way.length, least, 5e-5) << x.x << ' ' << x.y << ' ' << x.z;
      }
    }
  }
}

/// Two ellipses in a row: the same as two polygons of many edges.
TEST(CouplingsOfFaces, ChainsThroughEllipsesAreThoseThroughTheirPolygons) {
  Random random(33);
  PortalScene round = scene_with(ellipse_input(entrance, 1.2, 0.8)), edged = round;
  const Frame here{{2, 0.5, 3}, {0.8, 0, -0.6}, {0, 1, 0}, {0.6, 0, 0.8}};
  const Frame there{{-3, 0, 1}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
  const auto add = [&](PortalScene& scene, const FaceInput& face) {
    std::vector<Portal> pair = pair_with(face, here, there);
    for (Portal& portal : pair) portal.pair += 2;
    scene.portals.insert(scene.portals.end(), pair.begin(), pair.end());
  };
  add(round, ellipse_input(entrance, 0.9, 0.9));
  edged.portals = pair_with(many_edges(1.2, 0.8, 48), entrance, outlet);
  add(edged, many_edges(0.9, 0.9, 48));
  const ShortestPathCoupling a(round.input(2)), b(edged.input(2));
  ASSERT_EQ(a.images().size(), b.images().size());
  int compared = 0;
  for (int i = 0; i < scaled(12); ++i) {
    const Vec3d x = random.point(3.0);
    for (std::size_t k = 0; k < a.images().size(); ++k) {
      const double first = a.way(a.images()[k], x).length, second = b.way(b.images()[k], x).length;
      if (std::isinf(first) || std::isinf(second)) continue;
      ++compared;
      // The polygon lies within: 48 edges leave out .002 of the radius.
      ASSERT_LT(std::fabs(first - second), 8e-3) << k;
    }
  }
  EXPECT_GT(compared, scaled(12));
}

}  // namespace
}  // namespace portalens::test
