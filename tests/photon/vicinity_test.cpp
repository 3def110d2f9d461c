// Which masses a photon asks, out of many.
#include "photon/vicinity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

std::vector<Mass> strewn_masses(int count, Random& random) {
  const Physics physics = physics_with(1e-4, 20.0);
  std::vector<Mass> masses;
  for (int i = 0; i < count; ++i)
    masses.push_back(mass_at(random.point(10.0), random.uniform(1.0, 20.0), physics));
  return masses;
}

TEST(Vicinity, HoldsAllThatMattersWhereverAPhotonGoes) {
  Random random(31);
  const std::vector<Mass> masses = strewn_masses(300, random);
  const MassTree tree(masses);
  Vicinity vicinity(tree);
  Vec3d x = random.point(12.0);
  std::size_t held = 0;
  const int steps = scaled(2000);
  for (int step = 0; step < steps; ++step) {
    // Mostly small strides, now and then a leap or a long look ahead.
    x = step % 50 == 0 ? random.point(12.0) : x + random.direction() * random.uniform(0.0, 0.3);
    const double reach = step % 70 == 0 ? random.uniform(0.0, 30.0) : random.uniform(0.0, 0.2);
    vicinity.cover(x, reach);
    const auto near = vicinity.near();
    EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
    for (std::uint32_t i = 0; i < masses.size(); ++i) {
      const double far = std::max(masses[i].influence, masses[i].horizon_radius) + reach;
      if (length(masses[i].center - x) <= far) {
        EXPECT_TRUE(std::binary_search(near.begin(), near.end(), i)) << "mass " << i;
      }
    }
    held += near.size();
  }
  EXPECT_LT(held, masses.size() * static_cast<std::size_t>(steps) / 4) << "it chooses";
}

TEST(Vicinity, HoldsFewMassesAndEndlessInfluencesAlways) {
  Random random(32);
  const std::vector<Mass> few = strewn_masses(5, random);
  const MassTree few_tree(few);
  Vicinity all(few_tree);
  all.cover({1e6, 0, 0}, 0.0);
  EXPECT_EQ(all.near().size(), few.size());

  std::vector<Mass> many = strewn_masses(100, random);
  many[70].influence = std::numeric_limits<double>::infinity();
  const MassTree tree(many);
  Vicinity some(tree);
  some.cover({1e6, 0, 0}, 1.0);
  ASSERT_EQ(some.near().size(), 1u);
  EXPECT_EQ(some.near()[0], 70u);
}

}  // namespace
}  // namespace portalens::test
