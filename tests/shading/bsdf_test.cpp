// Laws that every BSDF of the list keeps. The list drives them: a newcomer is tried unasked.
#include "shading/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/list_types.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/shading.h"

namespace portalens::test {
namespace {

using std::numbers::pi;

[[maybe_unused]] std::shared_ptr<const Image> no_image(const std::string&, const Location&) {
  return nullptr;
}

/// Some of a type, none of which gives back more than it gets.
template <class Type>
struct Samples {
  static std::vector<Type> all() {
    Table table{"material", {}, {}};
    table.set("diffuse", value_of({0.3, 0.2, 0.4}));
    table.set("reflective", value_of({0.5, 0.6, 0.2}));
    table.set("base_color", value_of({0.8, 0.6, 0.9}));
    for (const char* key : {"roughness", "metallic"}) table.set(key, value_of(0.5));
    return from_common_keys<Type>(table, no_image);
  }
};
template <>
struct Samples<DiffuseMirror> {
  static std::vector<DiffuseMirror> all() {
    const Texture grey = Constant{{0.3, 0.2, 0.4}}, silver = Constant{{0.5, 0.6, 0.2}};
    const Texture tiles = Checker{{0.9, 0, 0}, {0, 0.8, 0.1}, 0.25};
    const Texture gaps = Checker{{0.1, 0, 0}, {1, 0.2, 0.9}, 0.25};
    return {DiffuseMirror(grey),
            DiffuseMirror(grey, silver),
            DiffuseMirror(grey, silver, 0.5),
            DiffuseMirror(Constant{{}}, Constant{{1, 1, 1}}, 0.8),
            DiffuseMirror(tiles, gaps),
            DiffuseMirror(tiles, gaps, 0.6)};
  }
};

template <>
struct Samples<MetallicRoughness> {
  static std::vector<MetallicRoughness> all() {
    const Texture white = Constant{{1, 1, 1}}, gold = Constant{{1, 0.77, 0.34}};
    const Texture tiles = Checker{{0.9, 0, 0}, {0, 0.8, 0.1}, 0.25};
    return {MetallicRoughness(white),
            MetallicRoughness(gold, 1.0, 0.3),
            MetallicRoughness(gold, 1.0, 1.0),
            MetallicRoughness(tiles, 0.5, 0.7),
            MetallicRoughness(Constant{{}}, 0.0, 0.2, 2.4),
            MetallicRoughness(tiles, 0.3, 0.0)};
  }
};

template <class Type>
class EachBsdf : public testing::Test {};
TYPED_TEST_SUITE(EachBsdf, TypesOf<Bsdf>::type);

constexpr Vec3d normal{0, 0, 1};

/// Of tables that a BSDF keeps energy by (docs/shading.md).
template <class Type>
constexpr double energy_error = HasGlossy<typename Type::Here> ? 3e-3 : 1e-12;

SurfacePoint some_place(Random& random) {
  SurfacePoint point;
  point.u = random.uniform(0, 1);
  point.v = random.uniform(0, 1);
  return point;
}

/// On the normal's side.
Vec3d some_direction(Random& random) {
  const Vec3d w = random.direction();
  return {w.x, w.y, std::fabs(w.z) + 1e-3};
}

/// In proportion to its cosine.
Vec3d lambert_direction(double u1, double u2) {
  const double r = std::sqrt(u1), turn = 2 * pi * u2;
  return {r * std::cos(turn), r * std::sin(turn), std::sqrt(1 - u1)};
}

/// Calls `use(bsdf, its Here, out)` for places on each sample.
template <class Type, class Use>
void for_places(std::uint64_t seed, int count, const Use& use) {
  for (const Type& bsdf : Samples<Type>::all()) {
    Random random(seed);
    for (int i = 0; i < count; ++i) {
      const auto here = bsdf.at(some_place(random));
      use(bsdf, here, normalize(some_direction(random)));
    }
  }
}

template <class Here>
Rgb sampled_weight(const Here& here, Vec3d out, std::uint64_t key) {
  const auto sample = here.sample(normal, out, random_number(key, 0), random_number(key, 1));
  return sample ? sample->color * sample->weight : Rgb{};
}

TYPED_TEST(EachBsdf, GivesBackNoMoreThanItGets) {
  for_places<TypeParam>(1, scaled(20), [](const auto& bsdf, const auto& here, Vec3d out) {
    const Rgb most = bsdf.max_reflected();
    for (const Vec3d channel : {Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
      const auto sent = estimate(
          500, [&](std::uint64_t key) { return dot(channel, sampled_weight(here, out, key)); });
      const double back = dot(channel, here.albedo(normal, out)) + sent.mean - 4 * sent.error;
      EXPECT_LE(back, 1 + energy_error<TypeParam>);
      EXPECT_LE(back, dot(channel, most) + energy_error<TypeParam>);
    }
  });
}

TYPED_TEST(EachBsdf, ItsAlbedoIsTheMeanOfItsValue) {
  for_places<TypeParam>(2, scaled(20), [](const auto&, const auto& here, Vec3d out) {
    const auto mean = estimate(2000, [&](std::uint64_t key) {
      const Vec3d in = lambert_direction(random_number(key, 0), random_number(key, 1));
      const Rgb value = here.value(normal, out, in);
      EXPECT_GE(std::min({value.x, value.y, value.z}), 0.0);
      return value.x + value.y + value.z;
    });
    const Rgb albedo = here.albedo(normal, out);
    EXPECT_NEAR(mean.mean, albedo.x + albedo.y + albedo.z,
                4 * mean.error + energy_error<TypeParam>);
  });
}

TYPED_TEST(EachBsdf, ValuesAreReciprocal) {
  Random random(3);
  for_places<TypeParam>(3, scaled(200), [&](const auto&, const auto& here, Vec3d out) {
    const Vec3d in = normalize(some_direction(random));
    EXPECT_LT(length(here.value(normal, out, in) - here.value(normal, in, out)), 1e-12);
  });
}

/// Light of the pattern g that is looked for in the pattern h, and the other way round: that holds
/// for exact mirrors, too, which have no value.
TYPED_TEST(EachBsdf, SamplesAreReciprocal) {
  const auto g = [](Vec3d w) { return w.x > 0.1 ? w.z : 0.0; };
  const auto h = [](Vec3d w) { return 1.0 + w.y - 0.5 * w.x; };
  for (const TypeParam& bsdf : Samples<TypeParam>::all()) {
    Random random(4);
    const auto here = bsdf.at(some_place(random));
    const auto carried = [&](const auto& from, const auto& to) {
      return estimate(scaled(20000), [&](std::uint64_t key) {
        const Vec3d out = lambert_direction(random_number(key, 2), random_number(key, 3));
        const auto sample = here.sample(normal, out, random_number(key, 0), random_number(key, 1));
        return sample ? to(out) * sample->color.x * sample->weight * from(sample->direction) : 0.0;
      });
    };
    const Estimate one = carried(g, h), other = carried(h, g);
    EXPECT_NEAR(one.mean, other.mean, 4 * (one.error + other.error) + 1e-12);
  }
}

TYPED_TEST(EachBsdf, SamplesLieOnTheNormalsSide) {
  Random random(5);
  for_places<TypeParam>(5, scaled(200), [&](const auto&, const auto& here, Vec3d out) {
    const auto sample = here.sample(normal, out, random.uniform(0, 1), random.uniform(0, 1));
    if (!sample) return;
    EXPECT_NEAR(length(sample->direction), 1.0, 1e-12);
    EXPECT_GT(dot(sample->direction, normal), 0.0);
    EXPECT_GE(sample->weight, 0.0);
  });
}

TYPED_TEST(EachBsdf, ItsGlossyPartIsWhatItsSamplesGive) {
  if constexpr (HasGlossy<typename TypeParam::Here>) {
    Random random(8);
    for_places<TypeParam>(8, scaled(200), [&](const auto&, const auto& here, Vec3d out) {
      const auto sample = here.sample(normal, out, random.uniform(0, 1), random.uniform(0, 1));
      if (!sample || !(sample->density > 0.0)) return;
      const Vec3d in = sample->direction;
      const Glossy told = here.glossy(normal, out, in), back = here.glossy(normal, in, out);
      EXPECT_NEAR(told.density, sample->density, 1e-9 * told.density);
      const Rgb given = told.value * (dot(normal, in) / (pi * told.density));
      EXPECT_LT(length(sample->color * sample->weight - given), 1e-9 * (1 + length(given)));
      EXPECT_LT(length(told.value - back.value), 1e-9 * (1 + length(told.value)));
    });
  }
}

/// Chi squared of where samples lie, against the density integrated over fields of the hemisphere;
/// and the same of a field for all that are nowhere.
TYPED_TEST(EachBsdf, ItsSamplesLieAsDenseAsItSays) {
  if constexpr (HasGlossy<typename TypeParam::Here>) {
    constexpr int heights = 8, turns = 12, fine = 100;
    const int count = scaled(20000);
    for_places<TypeParam>(9, 3, [&](const auto&, const auto& here, Vec3d out) {
      const auto one = here.sample(normal, out, 0.4, 0.6);
      if (!one || !(one->density > 0.0)) return;  // polished
      std::vector<double> expected(heights * turns + 1), found(expected.size());
      double all = 0.0;
      for (int h = 0; h < heights * fine; ++h)
        for (int t = 0; t < turns * fine; ++t) {
          const double z = (h + 0.5) / (heights * fine), r = std::sqrt(1 - z * z);
          const double turn = 2 * pi * (t + 0.5) / (turns * fine);
          const double part =
              2 * pi / (heights * fine * turns * fine) *
              here.glossy(normal, out, {r * std::cos(turn), r * std::sin(turn), z}).density;
          expected[static_cast<std::size_t>(h / fine * turns + t / fine)] += part * count;
          all += part;
        }
      EXPECT_LT(all, 1.002);
      expected.back() = std::fmax(0.0, 1.0 - all) * count;
      for (int i = 0; i < count; ++i) {
        const auto key = static_cast<std::uint64_t>(i);
        const auto sample = here.sample(normal, out, random_number(key, 0), random_number(key, 1));
        const Vec3d in = sample ? sample->direction : Vec3d{};
        const double turn = std::atan2(in.y, in.x) / (2 * pi);
        const int h = std::min(heights - 1, static_cast<int>(in.z * heights));
        const int t = std::min(turns - 1, static_cast<int>((turn < 0 ? turn + 1 : turn) * turns));
        ++found[sample ? static_cast<std::size_t>(h * turns + t) : found.size() - 1];
      }
      double chi2 = 0.0, few = 0.0, few_found = 0.0;
      int fields = 0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (expected[i] < 20) {
          few += expected[i], few_found += found[i];
          continue;
        }
        const double off = found[i] - expected[i];
        chi2 += off * off / (expected[i] + std::pow(2e-3 * expected[i], 2));
        ++fields;
      }
      EXPECT_LT(chi2, fields + 4.5 * std::sqrt(2.0 * fields)) << fields;
      EXPECT_NEAR(few_found, few, 4.5 * std::sqrt(few) + 5 + 2e-3 * count);
    });
  }
}

TYPED_TEST(EachBsdf, ItsGlossyAlbedoIsTheMeanOfItsSamples) {
  if constexpr (HasGlossy<typename TypeParam::Here>)
    for_places<TypeParam>(10, scaled(20), [&](const auto&, const auto& here, Vec3d out) {
      const auto sent = estimate(4000, [&](std::uint64_t key) {
        return dot(Vec3d{1, 1, 1}, sampled_weight(here, out, key)) / 3.0;
      });
      const Rgb told = here.glossy_albedo(normal, out);
      EXPECT_NEAR(sent.mean, (told.x + told.y + told.z) / 3.0, 4 * sent.error + 3e-3);
    });
}

TYPED_TEST(EachBsdf, SaysWhatIsBlack) {
  Random random(7);
  for_places<TypeParam>(7, scaled(200), [&](const auto& bsdf, const auto& here, Vec3d out) {
    const Vec3d in = normalize(some_direction(random));
    if (is_black(here.albedo(normal, out))) {
      EXPECT_TRUE(is_black(here.value(normal, out, in)));
    }
    if (!bsdf.answers()) {
      EXPECT_TRUE(is_black(here.albedo(normal, out)));
    }
    if (!bsdf.sends()) {
      EXPECT_FALSE(here.sample(normal, out, random.uniform(0, 1), random.uniform(0, 1)));
    }
    EXPECT_FALSE(bsdf.textures().empty());
  });
}

}  // namespace
}  // namespace portalens::test
