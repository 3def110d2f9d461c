#include "shading/reflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/random.h"
#include "support/scale.h"
#include "support/shading.h"

namespace portalens {
namespace {

using std::numbers::pi;

/// Smith's masking of GGX.
double lambda(double cosine, double alpha) {
  const double tangent2 = (1 - cosine * cosine) / (cosine * cosine);
  return (std::sqrt(1 + alpha * alpha * tangent2) - 1) / 2;
}

/// Light that comes from all round by a pattern, and what of it a rough white mirror gives back, by
/// quadrature over its directions of D G2 / (4 cos): written from Walter et al. 2007, eq. 33, 34,
/// 20.
/// @param pattern  of a direction; the same for y and -y
template <class Pattern>
double reflected(double cosine, double alpha, const Pattern& pattern) {
  const Vec3d out{std::sqrt(1 - cosine * cosine), 0, cosine};
  const int steps = 1000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double theta = (i + 0.5) / steps * pi / 2;
    for (int j = 0; j < steps; ++j) {
      const double phi = (j + 0.5) / steps * pi;  // the other half is the same
      const Vec3d in{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                     std::cos(theta)};
      const double h = normalize(out + in).z;
      const double bracket = h * h * (alpha * alpha - 1) + 1;
      const double d = alpha * alpha / (pi * bracket * bracket);
      const double g = 1 / (1 + lambda(cosine, alpha) + lambda(in.z, alpha));
      sum += pattern(in) * d * g / (4 * cosine) * std::sin(theta);
    }
  }
  return sum * 2 * (pi / 2 / steps) * (pi / steps);
}

TEST(Reflection, WithoutRoughnessIsAnExactMirror) {
  test::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3d n = random.direction();
    Vec3d in = random.direction();
    if (dot(in, n) > 0) in = -in;
    const auto reflection = reflect(in, n, 0.0, random.uniform(0, 1), random.uniform(0, 1));
    ASSERT_TRUE(reflection);
    EXPECT_DOUBLE_EQ(reflection->weight, 1.0);
    EXPECT_NEAR(dot(reflection->direction, n), -dot(in, n), 1e-14);
    EXPECT_LT(length(reflection->direction - in - n * dot(reflection->direction - in, n)), 1e-14);
  }
}

TEST(Reflection, TendsToTheMirrorAsRoughnessVanishes) {
  test::Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vec3d n{0, 0, 1};
    const Vec3d in = normalize(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), -1});
    const Vec3d mirrored = in - n * (2 * dot(in, n));
    const auto reflection = reflect(in, n, 0.01, random.uniform(0, 0.99), random.uniform(0, 1));
    ASSERT_TRUE(reflection);
    EXPECT_LT(length(reflection->direction - mirrored), 0.01);
    EXPECT_NEAR(reflection->weight, 1.0, 1e-3);
  }
}

TEST(Reflection, GivesBackNoMoreThanItGets) {
  test::Random random(3);
  for (int i = 0; i < test::scaled(20000); ++i) {
    const Vec3d n = random.direction();
    Vec3d in = random.direction();
    if (dot(in, n) > 0) in = -in;
    const auto reflection =
        reflect(in, n, random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    if (!reflection) continue;
    EXPECT_GT(dot(reflection->direction, n), 0.0);
    EXPECT_NEAR(length(reflection->direction), 1.0, 1e-12);
    EXPECT_GE(reflection->weight, 0.0);
    EXPECT_LE(reflection->weight, 1.0);
  }
}

TEST(Reflection, GivesBackWhatItsDistributionSays) {
  const auto even = [](Vec3d) { return 1.0; };
  const auto uneven = [](Vec3d w) { return 0.2 + 0.5 * w.x + (w.z > 0.6 ? w.y * w.y : 0.0); };
  const auto expect_share_of = [](const auto& pattern, double roughness, double cosine) {
    const Vec3d out{std::sqrt(1 - cosine * cosine), 0, cosine};
    const auto share = test::estimate(test::scaled(20000), [&](std::uint64_t i) {
      const auto r = reflect(-out, {0, 0, 1}, roughness, random_number(i, 0), random_number(i, 1));
      return r ? r->weight * pattern(r->direction) : 0.0;
    });
    EXPECT_NEAR(share.mean, reflected(cosine, roughness * roughness, pattern),
                4 * share.error + 1e-3)
        << roughness << " " << cosine;
  };
  for (const double roughness : {0.5, 0.8, 1.0}) {
    for (const double cosine : {0.2, 0.6, 0.95}) {
      expect_share_of(even, roughness, cosine);
      expect_share_of(uneven, roughness, cosine);
    }
  }
}

TEST(Reflection, LosesWhatBouncesTwiceAsTheDocumentsSay) {
  for (const auto& [surface, share] :
       {std::pair{0.3, 0.99}, {0.5, 0.92}, {0.8, 0.55}, {1.0, 0.31}}) {
    const double roughness = surface;
    const auto back = test::estimate(test::scaled(20000), [&](std::uint64_t i) {
      const auto r =
          reflect({0, 0, -1}, {0, 0, 1}, roughness, random_number(i, 0), random_number(i, 1));
      return r ? r->weight : 0.0;
    });
    EXPECT_NEAR(back.mean, share, 4 * back.error + 5e-3) << roughness;
  }
}

}  // namespace
}  // namespace portalens
