// The surface of glTF 2.0, against what it is defined by.
#include "shading/metallic_roughness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/random.h"
#include "support/scale.h"
#include "support/shading.h"

namespace portalens::test {
namespace {

constexpr Vec3d upward{0, 0, 1};

Vec3d at_cosine(double cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

/// What comes back of light that is the same from all round.
double given_back(const MetallicRoughness& surface, double cosine) {
  const auto here = surface.at({});
  const Vec3d out = at_cosine(cosine);
  const auto sent = estimate(scaled(20000), [&](std::uint64_t key) {
    const auto sample = here.sample(upward, out, random_number(key, 0), random_number(key, 1));
    return sample ? sample->color.x * sample->weight : 0.0;
  });
  return here.albedo(upward, out).x + sent.mean;
}

TEST(MetallicRoughness, WhiteGivesBackAllThatItGets) {
  for (const double metallic : {0.0, 0.4, 1.0})
    for (const double roughness : {0.0, 0.05, 0.2, 0.45, 0.7, 1.0})
      for (const double cosine : {0.05, 0.3, 0.7, 1.0})
        EXPECT_NEAR(given_back(MetallicRoughness(Constant{{1, 1, 1}}, metallic, roughness), cosine),
                    1.0, 0.01)
            << metallic << ' ' << roughness << ' ' << cosine;
}

/// Schlick's factor, as glTF gives it.
TEST(MetallicRoughness, MirrorsWhatItsIndexOfRefractionSays) {
  for (const double ior : {1.0, 1.33, 1.5, 2.4})
    for (const double cosine : {0.1, 0.5, 1.0}) {
      const auto here = MetallicRoughness(Constant{{0.2, 0.4, 0.6}}, 0.0, 0.0, ior).at({});
      const auto sample = here.sample(upward, at_cosine(cosine), 0.3, 0.4);
      ASSERT_TRUE(sample);
      const double f0 = std::pow((ior - 1) / (ior + 1), 2);
      const double expected = f0 + (1 - f0) * std::pow(1 - cosine, 5);
      EXPECT_NEAR(sample->color.x, expected, 1e-12);
      EXPECT_NEAR(sample->color.z, expected, 1e-12);
      EXPECT_NEAR(length(sample->direction - Vec3d{-at_cosine(cosine).x, 0, cosine}), 0, 1e-12);
    }
}

TEST(MetallicRoughness, MetalIsBlackButForWhatItMirrors) {
  const Rgb gold{1, 0.77, 0.34};
  const auto here = MetallicRoughness(Constant{gold}, 1.0, 0.0).at({});
  EXPECT_EQ(here.albedo(upward, upward), Rgb{});
  EXPECT_LT(length(here.sample(upward, upward, 0.5, 0.5)->color - gold), 1e-12);
}

/// The definition itself, written from glTF 2.0, appendix B: D G F / (4 cos cos); and besides what
/// bounces between the microfacets, by Kulla and Conty.
TEST(MetallicRoughness, ItsHighlightIsThatOfTheDefinition) {
  Random random(1);
  for (const double roughness : {0.1, 0.3}) {
    const double alpha = roughness * roughness, a2 = alpha * alpha;
    const auto here = MetallicRoughness(Constant{{}}, 0.0, roughness, 1.5).at({});
    for (int i = 0; i < scaled(500); ++i) {
      const Vec3d l = at_cosine(random.uniform(0.3, 1)), aside = random.direction() * 0.2;
      const Vec3d v = normalize(Vec3d{-l.x + aside.x, aside.y, l.z + 0.3 * aside.z});
      if (v.z < 0.2) continue;
      const Vec3d h = normalize(l + v);
      const double d = a2 / (std::numbers::pi * std::pow(h.z * h.z * (a2 - 1) + 1, 2));
      const auto half_of_v = [&](double to, double from) {
        return to * std::sqrt(from * from * (1 - a2) + a2);
      };
      const double visibility = 0.5 / (half_of_v(l.z, v.z) + half_of_v(v.z, l.z));
      const double f = 0.04 + 0.96 * std::pow(1 - dot(v, h), 5);
      const double once = std::numbers::pi * visibility * d * f;
      const double mean = ggx_mean_albedo(roughness).facing, mean_f = 0.04 + 0.96 / 21;
      const auto lost = [&](double cosine) { return 1 - ggx_albedo(cosine, roughness).facing; };
      const double again =
          lost(l.z) * lost(v.z) / (1 - mean) * mean_f * mean_f * mean / (1 - mean_f * (1 - mean));
      EXPECT_NEAR(here.glossy(upward, v, l).value.x, once + again, 1e-9 * once + 1e-9);
    }
  }
}

}  // namespace
}  // namespace portalens::test
