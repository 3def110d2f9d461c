#include "gravity/portal_mass_coupling.h"

#include <gtest/gtest.h>

#include "gravity/portal_scenes.h"

namespace portalens::test {
namespace {

TEST(PortalMassCoupling, MakesOneMassOfEachPortal) {
  // A rectangle of area 2 at the origin, its pair 10 away, masses beside both.
  PortalScene scene;
  scene.min_force = 0.04;
  const std::vector<Vec3d> rectangle = {{-1, -0.5, 0}, {1, -0.5, 0}, {1, 0.5, 0}, {-1, 0.5, 0}};
  add_pair(scene, rectangle, {{10, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  add_mass(scene, {10, 3, 0}, 5.0, 0.4);
  add_mass(scene, {0, 0, 2}, 7.0);
  const double core2 = 2.0 / std::numbers::pi;
  const double first = 5.0 * core2 / (core2 + 9.0) + 7.0 * core2 / (core2 + 104.0);
  const double second = 5.0 * core2 / (core2 + 109.0) + 7.0 * core2 / (core2 + 4.0);
  for (int depth = 1; depth <= 3; ++depth) {
    const PortalMassCoupling coupling(scene.input(depth));
    ASSERT_EQ(coupling.images().size(), 2u);
    EXPECT_NEAR(coupling.images()[0].gm, first, 1e-14);
    EXPECT_NEAR(coupling.images()[1].gm, second, 1e-14);
    EXPECT_NEAR(coupling.images()[1].influence, 5.0 * std::sqrt(second), 1e-12);
    const Vec3d x{0.3, 0.4, -1.2};  // 1.3 from the first, out of reach of the second
    const Vec3d expected = x * (-first / std::pow(1.69 + core2, 1.5));
    EXPECT_LE(relative_difference(coupling.pull(x, x).acceleration, expected), 1e-14);
  }
}

TEST(PortalMassCoupling, IsSilentAtDepthZero) {
  Random random(41);
  const PortalScene scene = random_scene(random, 2, 2, 3.0, 0.01);
  EXPECT_TRUE(PortalMassCoupling(scene.input(0)).images().empty());
}

}  // namespace
}  // namespace portalens::test
