// What every law keeps. The list drives it: a newcomer is tried unasked.
#include "gravity/law.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gravity/mass.h"
#include "math/pack.h"
#include "support/list_types.h"
#include "support/random.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

template <class L>
class Laws : public testing::Test {};

TYPED_TEST_SUITE(Laws, TypesOf<Law>::type);

/// The deepest place where light is.
template <class L>
double deepest() {
  if constexpr (requires { L::greatest_potential; }) return L::greatest_potential;
  return 100.0;
}

/// Places from far off to the deepest.
template <class L, class F>
void for_places(F visit) {
  const double most = deepest<L>();
  for (double w = 1e-6; w < 0.99 * most; w = 1.3 * w + 1e-7) visit(w);
}

TYPED_TEST(Laws, WeighThePullByTheSlopeOfTheIndex) {
  for_places<TypeParam>([](double w) {
    const double step = 1e-4 * std::fmin(w, 2.0 - std::fmin(w, 1.98));
    const double slope =
        (TypeParam::log_index(w + step) - TypeParam::log_index(w - step)) / (2.0 * step);
    ASSERT_NEAR(TypeParam::weight(w) / slope, 1.0, 1e-6) << w;
  });
}

TYPED_TEST(Laws, KnowHowTheWeightChanges) {
  if constexpr (!TypeParam::uniform)
    for_places<TypeParam>([](double w) {
      const double step = 1e-3 * std::fmin(w, 2.0 - std::fmin(w, 1.98));
      const double slope =
          (TypeParam::weight(w + step) - TypeParam::weight(w - step)) / (2.0 * step);
      ASSERT_NEAR(TypeParam::weight_slope(w), slope, 1e-4 * TypeParam::weight(w)) << w;
    });
  else
    for_places<TypeParam>(
        [](double w) { ASSERT_EQ(TypeParam::weight(w), TypeParam::weight(0.0)); });
}

TYPED_TEST(Laws, AreFlatSpaceFarFromAllMasses) {
  EXPECT_EQ(TypeParam::log_index(0.0), 0.0);
  EXPECT_EQ(TypeParam::clock(0.0), 1.0);
}

TYPED_TEST(Laws, SlowClocksTowardsMasses) {
  double last = 1.0;
  for_places<TypeParam>([&](double w) {
    ASSERT_LT(TypeParam::clock(w), last);
    ASSERT_GE(TypeParam::clock(w), 0.0);
    last = TypeParam::clock(w);
  });
  // Newton's potential, far off.
  EXPECT_NEAR((1.0 - TypeParam::clock(1e-6)) / 1e-6, 1.0, 1e-5);
}

TYPED_TEST(Laws, SayTheSameOfPacksWithinAFloatsRounding) {
  using Real = Pair<Pack<xsimd::sse2>>;
  for_places<TypeParam>([](double w) {
    if (w > 1.9) return;  // a float's w would differ by more than that
    float found[Real::lanes];
    TypeParam::weight(Real(w)).store(found);
    ASSERT_NEAR(found[0] / TypeParam::weight(w), 1.0, 3e-6) << w;
    if constexpr (!TypeParam::uniform) {
      TypeParam::weight_slope(Real(w)).store(found);
      ASSERT_NEAR(found[0], TypeParam::weight_slope(w), 3e-5 * TypeParam::weight(w)) << w;
    }
  });
}

TYPED_TEST(Laws, EndLightWhereItCouldNotReturn) {
  const LawConstants constants = constants_of(TypeParam{});
  // Nearer than where light circles, it falls.
  EXPECT_LE(TypeParam::horizon_radius(1.0, 0.0), 2.0 * constants.light_sphere);
  EXPECT_GT(TypeParam::horizon_radius(1.0, 0.0), 0.0);
  if constexpr (requires { TypeParam::greatest_potential; }) {
    EXPECT_DOUBLE_EQ(1.0 / TypeParam::horizon_radius(1.0, 0.0), TypeParam::greatest_potential);
  }
}

TYPED_TEST(Laws, AreFoundByTheirNames) {
  const Law law = make_law(TypeParam::name);
  EXPECT_TRUE(std::holds_alternative<TypeParam>(law));
}

TEST(LawList, TellsWhereLightCirclesOneMass) {
  const auto sphere = [](const Law& law) { return constants_of(law).light_sphere; };
  EXPECT_EQ(sphere(NewtonLaw{}), 1.0);
  EXPECT_DOUBLE_EQ(sphere(EinsteinLaw{}), 2.0);
  EXPECT_DOUBLE_EQ(sphere(SchwarzschildLaw{}), 1.0 + std::sqrt(0.75));
  EXPECT_DOUBLE_EQ(sphere(ExtremeLaw{}), 1.0);
}

TEST(LawList, HorizonsOfChargedHolesShrinkBesideOthers) {
  std::vector<Mass> masses(3);
  masses[1].center = masses[2].center = {4, 0, 0};
  for (Mass& mass : masses) mass.gm = 8.0;
  set_horizons(ExtremeLaw{}, masses, 2.0);  // m = 2
  EXPECT_DOUBLE_EQ(masses[0].horizon_radius, 0.02 / (1.0 + 0.5 + 0.5));
  // Two in one place are one: neither makes the other's vanish.
  EXPECT_DOUBLE_EQ(masses[1].horizon_radius, 0.02 / (1.0 + 0.5));
}

}  // namespace
}  // namespace portalens::test
