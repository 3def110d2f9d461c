// Laws that every coupling keeps. The list drives them: a newcomer is tried unasked.
#include <gtest/gtest.h>

#include <algorithm>
#include <concepts>

#include "gravity/coupling.h"
#include "gravity/portal_scenes.h"
#include "support/list_types.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

template <class C>
class Couplings : public testing::Test {};

TYPED_TEST_SUITE(Couplings, TypesOf<Coupling>::type);

/// Scenes of one or two pairs and three or four masses, depths 0 to 3.
template <class F>
void for_scenes(std::uint64_t seed, int rounds, F visit) {
  Random random(seed);
  for (int round = 0; round < rounds; ++round) {
    const int pairs = 1 + round % 2;
    const PortalScene scene = random_scene(random, pairs, 3, 2.5, 0.03);
    visit(scene, scene.input(round % (5 - pairs), 12), random);
  }
}

bool same(const Pull& a, const Pull& b, double tolerance) {
  const double size = std::max(length(a.acceleration), length(b.acceleration));
  return length(a.acceleration - b.acceleration) <= tolerance * size;
}

TYPED_TEST(Couplings, DecideNothingAfreshWhereTheSignatureIsTheSame) {
  int compared = 0;
  for_scenes(51, scaled(60), [&](const PortalScene&, const CouplingInput& input, Random& random) {
    const TypeParam coupling(input);
    for (int i = 0; i < 30; ++i) {
      const Vec3d anchor = random.point(4.0);
      const Vec3d x = anchor + random.direction() * random.uniform(0.0, 0.5);
      if (coupling.signature(x) != coupling.signature(anchor)) continue;
      const Pull frozen = coupling.pull(x, anchor), fresh = coupling.pull(x, x);
      ASSERT_TRUE(same(frozen, fresh, 1e-9));
      ASSERT_NEAR(frozen.stiffness, fresh.stiffness, 1e-6 * fresh.stiffness);
      ++compared;
    }
  });
  EXPECT_GT(compared, scaled(60) * 5);
}

/// Of a portal that acts as a mass.
double core2_of(const PortalScene& scene, const PullPart& part) {
  const PortalMassCoupling coupling(scene.input(1));
  for (const PortalMassCoupling::Image& image : coupling.images())
    if (image.portal == part.portals.front()) return image.core2;
  return 0.0;
}

TYPED_TEST(Couplings, AreTheSumOfTheirParts) {
  int acting = 0;
  for_scenes(57, scaled(60),
             [&](const PortalScene& scene, const CouplingInput& input, Random& random) {
               const TypeParam coupling(input);
               for (int i = 0; i < 10; ++i) {
                 const Vec3d x = random.point(4.0);
                 const Vec3d pull = coupling.pull(x, x).acceleration;
                 Vec3d sum;
                 for (const PullPart& part : coupling.parts(x)) {
                   sum += part.acceleration;
                   ASSERT_FALSE(part.portals.empty());
                   EXPECT_GE(part.distance, 0.0);
                   // The path sets out towards the first face.
                   const PortalFace face(scene.portals[part.portals.front()]);
                   EXPECT_LE(face.distance(part.entrance), 1e-9);
                 }
                 ASSERT_LE(length(sum - pull), 1e-12 * (length(sum) + length(pull)));
                 acting += length(pull) > 0.0;
               }
             });
  EXPECT_TRUE(acting > scaled(60) || TypeParam::name == "none");
}

TYPED_TEST(Couplings, TellThePotentialOfTheWaysThatPull) {
  Random random(58);
  int acting = 0;
  for (int round = 0; round < std::max(scaled(40), 40); ++round) {
    PortalScene scene = random_scene(random, 1, 1, 2.5, 0.03);
    scene.masses.resize(1);  // without a core
    const TypeParam coupling(scene.input(1, 200));
    for (int i = 0; i < 10; ++i) {
      const Vec3d x = random.point(4.0);
      double expected = 0.0;
      for (const PullPart& part : coupling.parts(x)) {
        const double square = part.distance * part.distance;
        expected +=
            std::same_as<TypeParam, PortalMassCoupling>
                ? length(part.acceleration) * (square + core2_of(scene, part)) / part.distance
                : std::sqrt(length(part.acceleration) * scene.masses[0].gm);
      }
      const double found = coupling.pull(x, x).potential;
      // Where a map lies between its nodes it is not exact.
      const bool map = std::same_as<TypeParam, GravitonMapCoupling>;
      ASSERT_NEAR(found, expected, (map ? 2e-2 : 1e-9) * expected);
      acting += found > 0.0;
    }
  }
  EXPECT_TRUE(acting > 0 || TypeParam::name == "none");
}

TYPED_TEST(Couplings, ChangeTheirSignatureOnlyWhereTheFieldIsNotSmooth) {
  int kinks = 0, idle = 0;
  for_scenes(52, scaled(30), [&](const PortalScene&, const CouplingInput& input, Random& random) {
    const TypeParam coupling(input);
    for (int i = 0; i < 10; ++i) {
      const Vec3d start = random.point(6.0), step = random.direction() * 0.3;
      if (coupling.signature(start) == coupling.signature(start + step)) continue;
      double low = 0.0, high = 1.0;
      for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        const bool changed = coupling.signature(start + step * middle) != coupling.signature(start);
        (changed ? high : low) = middle;
      }
      // On one side of a kink the other side's decisions give another field.
      const Vec3d before = start + step * low, after = start + step * high;
      double apart = 0.0;
      for (double away : {0.0, -0.05, -0.02, 0.02, 0.05}) {
        const Vec3d x = before + normalize(step) * away;
        const Vec3d a = coupling.pull(x, before).acceleration;
        const Vec3d b = coupling.pull(x, after).acceleration;
        apart = std::max(apart, relative_difference(a, b));
      }
      idle += apart <= 1e-9;
      ++kinks;
    }
  });
  if (TypeParam::name != "none") {
    EXPECT_GT(kinks, 0);
  }
  // A change for nothing costs a step, no more: a decision on the path to a vertex, say.
  EXPECT_LE(idle, 0.01 * kinks);
}

TYPED_TEST(Couplings, AreSilentWithinTheirQuiet) {
  int silent_places = 0;
  for_scenes(53, scaled(60), [&](const PortalScene&, const CouplingInput& input, Random& random) {
    const TypeParam coupling(input);
    const std::uint64_t silence = coupling.signature({1e9, 0, 0});
    for (int i = 0; i < 20; ++i) {
      const Vec3d start = random.point(20.0);
      const double distance_to_support = coupling.distance_to_support(start);
      ASSERT_GE(distance_to_support, 0.0);
      if (distance_to_support == 0.0) continue;
      ++silent_places;
      for (int k = 0; k < 20; ++k) {
        const double far =
            std::min(distance_to_support, 50.0) * random.uniform(0.0, 1.0) * (1.0 - 1e-12);
        const Vec3d x = start + random.direction() * far;
        ASSERT_EQ(coupling.pull(x, x).acceleration, Vec3d{});
        ASSERT_EQ(coupling.signature(x), silence);
      }
    }
  });
  EXPECT_GT(silent_places, 0);
}

TYPED_TEST(Couplings, AddNothingAtDepthZeroOrWithoutPortals) {
  Random random(54);
  for (int round = 0; round < 20; ++round) {
    PortalScene scene = random_scene(random, 1, 2, 2.0, 0.01);
    const TypeParam shallow(scene.input(0));
    scene.portals.clear();
    const TypeParam bare(scene.input(3));
    for (int i = 0; i < 10; ++i) {
      const Vec3d x = random.point(2.0);
      EXPECT_EQ(shallow.pull(x, x).acceleration, Vec3d{});
      EXPECT_EQ(bare.pull(x, x).acceleration, Vec3d{});
      EXPECT_TRUE(std::isinf(shallow.distance_to_support(x)));
      EXPECT_TRUE(std::isinf(bare.distance_to_support(x)));
    }
  }
}

TYPED_TEST(Couplings, StayFiniteOnFacesRimsAndMasses) {
  for_scenes(55, scaled(40), [&](const PortalScene& scene, const CouplingInput& input, Random&) {
    const TypeParam coupling(input);
    std::vector<Vec3d> places;
    for (const Portal& portal : scene.portals) {
      places.push_back(portal.frame.origin);
      places.push_back(portal.frame.origin + portal.frame.normal);
      for (std::size_t i = 0; i < portal.vertices.size(); ++i) {
        const Vec3d& a = portal.vertices[i];
        const Vec3d& b = portal.vertices[(i + 1) % portal.vertices.size()];
        places.push_back(a);
        places.push_back((a + b) * 0.5);
        places.push_back(a + (a - b));
      }
    }
    for (const Mass& mass : scene.masses) places.push_back(mass.center);
    for (const Vec3d& x : places) {
      const Pull pull = coupling.pull(x, x);
      EXPECT_TRUE(is_finite(pull.acceleration));
      EXPECT_FALSE(std::isnan(pull.stiffness));
      EXPECT_FALSE(std::isnan(coupling.distance_to_support(x)));
    }
  });
}

TEST(CouplingList, MakesEachCouplingByItsName) {
  Random random(56);
  const PortalScene scene = random_scene(random, 1, 2, 2.0, 0.01);
  for (const std::string_view name : coupling_names()) {
    const Coupling coupling = make_coupling(name, scene.input(1));
    std::visit([&](const auto& made) { EXPECT_EQ(made.name, name); }, coupling);
    EXPECT_LE(estimated_cost(name, scene.input(1)).each_call, coupling_budget.each_call);
  }
}

TEST(CouplingList, EstimatesThatCostGrowsWithThePowerOfTheDepth) {
  Random random(57);
  const PortalScene scene = random_scene(random, 3, 2, 2.0, 0.01);
  for (const std::string_view name : {"closest-point", "shortest-path"}) {
    const double three = estimated_cost(name, scene.input(3)).each_call;
    const double four = estimated_cost(name, scene.input(4)).each_call;
    EXPECT_GE(four, 4.9 * three);
    EXPECT_GT(estimated_cost(name, scene.input(12)).each_call, coupling_budget.each_call);
  }
}

}  // namespace
}  // namespace portalens::test
