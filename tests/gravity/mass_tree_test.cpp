// Masses found through a tree, held against asking all of them.
#include "gravity/mass_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gravity/influence.h"
#include "support/infinity.h"
#include "support/random.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

/// Small and large spheres, some far off, some that act everywhere.
std::vector<Mass> strewn_masses(int count, Random& random) {
  std::vector<Mass> masses;
  for (int i = 0; i < count; ++i) {
    Mass mass;
    mass.gm = 1.0;
    mass.center = random.point(i % 40 == 39 ? 1e14 : 10.0);
    mass.influence = i % 50 == 49 ? infinity : random.uniform(0.0, 1.0);
    mass.horizon_radius = i % 10 == 0 ? 1.5 * random.uniform(0.0, 1.0) : 1e-3;
    masses.push_back(mass);
  }
  return masses;
}

TEST(MassTree, ARayEntersToTheBitWhereAskingEachMassSays) {
  Random random(41);
  for (const int count : {0, 1, 16, 17, 45, 1000}) {
    const std::vector<Mass> masses = strewn_masses(count, random);
    const MassTree tree(masses);
    EXPECT_EQ(tree.few(), count <= 16);
    for (int i = 0; i < scaled(2000); ++i) {
      const Ray ray{random.point(i % 5 == 0 ? 1e5 : 12.0), random.direction()};
      double first = infinity;
      for (const Mass& mass : masses)
        first = std::min(first, entry_into(mass.center, mass.influence, ray));
      ASSERT_EQ(tree.entry(ray), first);
    }
  }
}

TEST(MassTree, HoldsAllWhoseSpheresMeetABall) {
  Random random(42);
  for (const int count : {16, 45, 300}) {
    const std::vector<Mass> masses = strewn_masses(count, random);
    const MassTree tree(masses);
    std::vector<std::uint32_t> found;
    for (int i = 0; i < scaled(2000); ++i) {
      const Vec3d x = random.point(i % 20 == 0 ? 1e9 : 12.0);
      const double radius = i % 30 == 0 ? 1e9 : random.uniform(0.0, 2.0);
      tree.around(x, radius, found);
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
      for (std::uint32_t k = 0; k < masses.size(); ++k) {
        const double reach = std::max(masses[k].influence, masses[k].horizon_radius) + radius;
        if (length(masses[k].center - x) <= reach) {
          EXPECT_TRUE(std::binary_search(found.begin(), found.end(), k)) << "mass " << k;
        }
      }
    }
  }
}

TEST(MassTree, KnowsTheHorizonsThatNoInfluenceHides) {
  Random random(43);
  const std::vector<Mass> masses = strewn_masses(100, random);
  const MassTree tree(masses);
  const auto bare = tree.bare_horizons();
  for (std::uint32_t i = 0; i < masses.size(); ++i)
    EXPECT_EQ(std::count(bare.begin(), bare.end(), i),
              masses[i].horizon_radius >= masses[i].influence ? 1 : 0);
}

}  // namespace
}  // namespace portalens::test
