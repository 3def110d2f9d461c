// Laws that every light of the list keeps. The list drives them: a newcomer is tried unasked.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "shading/light_samples.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/shading.h"

namespace portalens::test {
namespace {

template <class Type>
class EachLight : public testing::Test {};
TYPED_TEST_SUITE(EachLight, TypesOf<Light>::type);

constexpr Vec3d middle{0, 3, 0};

/// Of one that is infinitely far: of a surface that faces it, or, if it is all round, any way.
template <class Type>
void expect_irradiance(const Type& light) {
  Random random(1);
  const auto arrived = estimate(scaled(20000), [&](std::uint64_t) {
    const double u1 = random.uniform(0, 1), u2 = random.uniform(0, 1);
    const Vec3d x = random.point(10);
    Vec3d normal = random.direction();
    if constexpr (Directed<Type>) normal = light.towards();
    return irradiance(light.sample(x, u1, u2), x, normal).y;
  });
  EXPECT_NEAR(arrived.mean, light.power().y, 4 * arrived.error + 1e-9 * light.power().y);
}

TYPED_TEST(EachLight, ItsPowerArrivesOnAnySphereAroundIt) {
  const std::vector<TypeParam> lights = LightSamples<TypeParam>::all();
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const TypeParam& light = lights[i];
    if constexpr (Distant<TypeParam>) {
      expect_irradiance(light);
      continue;
    }
    const Rgb power = light.power() * LightSamples<TypeParam>::share_outside(i);
    for (const double radius : {12.0, 50.0})
      for (const Vec3d channel : {Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
        Random random(1);
        const auto arrived = estimate(scaled(20000), [&](std::uint64_t) {
          const Vec3d way = random.direction(), x = middle + way * radius;
          const double u1 = random.uniform(0, 1), u2 = random.uniform(0, 1);
          return 4 * std::numbers::pi * radius * radius *
                 dot(channel, irradiance(light.sample(x, u1, u2), x, -way));
        });
        const double expected = dot(channel, power);
        EXPECT_NEAR(arrived.mean, expected, 4 * arrived.error + 2e-3 * expected);
      }
  }
}

TYPED_TEST(EachLight, ItsSamplesAreSound) {
  for (const TypeParam& light : LightSamples<TypeParam>::all()) {
    Random random(2);
    for (int i = 0; i < scaled(1000); ++i) {
      const Vec3d x = random.point(10);
      const double u1 = random.uniform(0, 1), u2 = random.uniform(0, 1);
      const LightSample sample = light.sample(x, u1, u2);
      EXPECT_TRUE(is_finite(sample.position) && is_finite(sample.facing));
      EXPECT_GE(std::min({sample.facing.x, sample.facing.y, sample.facing.z}), 0.0);
    }
  }
}

TYPED_TEST(EachLight, HasManyPointsUnlessOneSampleTellsAllOfIt) {
  for (const TypeParam& light : LightSamples<TypeParam>::all()) {
    const auto at = [&](double u1, double u2) { return light.sample({1, 0, 2}, u1, u2); };
    EXPECT_EQ(at(0.1, 0.2).position == at(0.7, 0.6).position, TypeParam::is_delta);
  }
}

/// A place before a large portal, whose pair lies below the lights and faces them: none of their
/// light is cut off, and all of it comes as from where they are seen.
TYPED_TEST(EachLight, ShinesThroughAPortalFromWhereItIsSeen) {
  if constexpr (Distant<TypeParam>) return;  // sun and sky have tests of their own
  const auto portals = portal_pair({{100, -40, 40}, {100, -40, -40}, {100, 40, -40}, {100, 40, 40}},
                                   {{-40, -6, 40}, {40, -6, 40}, {40, -6, -40}, {-40, -6, -40}});
  ASSERT_GT(portals[1].frame.normal.y, 0.99);
  const Rigid motion = *portals[0].motion();
  const Vec3d there{0.5, -9, 1}, normal{0, 1, 0};
  const Vec3d x = motion.move_back(there), n = motion.rotate_back(normal);
  ASSERT_GT(dot(portals[0].frame.normal, x - portals[0].frame.origin), 0.0);
  const Vec3d right = any_perpendicular(n), up = cross(n, right);
  const Quad patch(
      std::array<Vec3d, 4>{{x - right - up, x + right - up, x + right + up, x - right + up}});
  const PlannedSpace space = plain_space({patch}, portals);
  for (const TypeParam& light : LightSamples<TypeParam>::all()) {
    const Appearance look = appearance_with({diffuse_material({1, 1, 1})}, {light});
    const auto found = estimate(scaled(20000), [&](std::uint64_t key) {
      double sum = 0.0;
      const ShadeOutput output = shade_one(space, look, hit_at(x, -n), key);
      for (const ShadowQuery& query : output.shadows)
        if (query.portal == 0 && visible(space, query)) sum += query.contribution.y;
      return sum;
    });
    Random random(3);
    const auto expected = estimate(scaled(20000), [&](std::uint64_t) {
      const double u1 = random.uniform(0, 1), u2 = random.uniform(0, 1);
      return irradiance(light.sample(there, u1, u2), there, normal).y / std::numbers::pi;
    });
    EXPECT_GT(expected.mean, 0.0);
    EXPECT_NEAR(found.mean, expected.mean,
                4.5 * (found.error + expected.error) + 1e-9 * expected.mean);
  }
}

}  // namespace
}  // namespace portalens::test
