#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/random.h"
#include "support/scale.h"
#include "support/shading.h"

namespace portalens {
namespace {

using test::appearance_with;
using test::diffuse_material;
using test::hit_at;
using test::light_from;
using test::mirror_material;
using test::plain_space;
using test::shade_one;

using std::numbers::pi;

/// The square of half-width `half` around the origin, in the plane y = `height`, facing up.
Quad floor_quad(double half, double height = 0.0) {
  return Quad(std::array<Vec3d, 4>{{{-half, height, half},
                                    {half, height, half},
                                    {half, height, -half},
                                    {-half, height, -half}}});
}

Arrival fate_of(Fate fate) {
  Arrival arrival;
  arrival.fate = fate;
  arrival.direction = {0, 0, -1};
  return arrival;
}

TEST(Shade, APointLightLeavesTheRadianceOfLambertsLaw) {
  const PlannedSpace space = plain_space({floor_quad(5)});
  const Rgb rho{0.2, 0.5, 0.8};
  const Appearance look =
      appearance_with({diffuse_material(rho)}, {PointLight{{0, 3, 4}, {7, 8, 9}}});
  const Rgb light = light_from(space, shade_one(space, look, hit_at({0, 0, 0}, {1, -1, 0})));
  const double geometry = 0.6 / 25 / pi;
  EXPECT_NEAR(light.x, 0.2 * 7 * geometry, 1e-14);
  EXPECT_NEAR(light.y, 0.5 * 8 * geometry, 1e-14);
  EXPECT_NEAR(light.z, 0.8 * 9 * geometry, 1e-14);
}

TEST(Shade, ASurfaceSeenFromBelowIsLitFromBelow) {
  const PlannedSpace space = plain_space({floor_quad(5)});
  const Material grey = diffuse_material({0.5, 0.5, 0.5});
  const Appearance above = appearance_with({grey}, {PointLight{{0, 2, 0}, {1, 1, 1}}});
  const Appearance below = appearance_with({grey}, {PointLight{{0, -2, 0}, {1, 1, 1}}});
  const Arrival up = hit_at({0, 0, 0}, {0, 1, 0.1}), down = hit_at({0, 0, 0}, {0, -1, 0.1});
  EXPECT_EQ(light_from(space, shade_one(space, above, up)), Rgb{});
  EXPECT_EQ(light_from(space, shade_one(space, below, up)),
            light_from(space, shade_one(space, above, down)));
  EXPECT_GT(light_from(space, shade_one(space, below, up)).x, 0.0);
}

TEST(Shade, AmbientLightLeavesItsShareAndEmissionItself) {
  const PlannedSpace space = plain_space({floor_quad(5)});
  Appearance look = appearance_with({diffuse_material({0.2, 0.5, 0.8}, {1, 2, 3})}, {});
  look.limits.ambient = {0.1, 0.2, 0.3};
  for (const double side : {-1.0, 1.0}) {
    const Rgb light = light_from(space, shade_one(space, look, hit_at({0, 0, 0}, {0, side, 0.1})));
    EXPECT_LT(length(light - Rgb{1.02, 2.1, 3.24}), 1e-14);
  }
}

TEST(Shade, InAFurnaceAWhiteSurfaceShowsTheRadianceOfTheWalls) {
  // A diffuse square inside an emitting cube, or ball: E = pi L on either side of it.
  const Shape walls[] = {Cube({0, 0, 0}, {4, 4, 4}, {0, 0, 0}), Sphere({0, 0, 0}, 2.5)};
  for (const Shape& wall : walls) {
    const PlannedSpace space = plain_space({floor_quad(0.1), wall});
    Appearance look = appearance_with({diffuse_material({0.5, 1.0, 0.25})},
                                      {ShapeLight(wall, Constant{{2, 2, 2}})}, 2);
    look.limits.shadow_samples = 4;
    for (const double side : {-1.0, 1.0}) {
      const Arrival arrival = hit_at({0.02, 0, 0.01}, {0.2, side, 0.1});
      const auto light = test::estimate(test::scaled(5000), [&](std::uint64_t key) {
        return light_from(space, shade_one(space, look, arrival, key)).x;
      });
      EXPECT_NEAR(light.mean, 0.5 * 2, 4 * light.error);
      EXPECT_LT(light.error, 0.03);
    }
  }
}

TEST(Shade, StrataReduceTheNoiseOfAnAreaLight) {
  const Quad panel = floor_quad(1, 1);
  const PlannedSpace space = plain_space({floor_quad(5), panel});
  Appearance look =
      appearance_with({diffuse_material({1, 1, 1})}, {ShapeLight(panel, Constant{{1, 1, 1}})}, 2);
  const Arrival arrival = hit_at({0.5, 0, 0.2}, {0.2, -1, 0.1});
  const auto noise = [&](std::uint32_t samples) {
    look.limits.shadow_samples = samples;
    return test::estimate(test::scaled(2000), [&](std::uint64_t key) {
      return light_from(space, shade_one(space, look, arrival, key)).x;
    });
  };
  const auto one = noise(1), sixteen = noise(16);
  EXPECT_NEAR(one.mean, sixteen.mean, 4 * (one.error + sixteen.error));
  EXPECT_LT(sixteen.error, one.error / 6);  // independent samples would reach a quarter
}

TEST(Shade, TheSkyTheDarkAndTheLostHaveTheirColours) {
  const PlannedSpace space = plain_space({});
  Appearance look = appearance_with({}, {}, 0);
  look.environment.color = {1, 2, 3};
  look.limits.lost_color = {1, 0, 1};
  Photon photon;
  photon.throughput = {0.5, 0.5, 0.5};
  Arrival escaped = fate_of(Fate::escaped), lost = fate_of(Fate::lost);
  escaped.tint = lost.tint = {0, 1, 1};
  EXPECT_EQ(light_from(space, shade_one(space, look, escaped, 1, photon)), (Rgb{0, 1, 1.5}));
  EXPECT_EQ(light_from(space, shade_one(space, look, lost, 1, photon)), (Rgb{0.5, 0, 0.5}));
  // At the end of a corridor of portals: what would be seen there, if nothing else is asked for.
  lost.out_of_crossings = true;
  EXPECT_EQ(light_from(space, shade_one(space, look, lost, 1, photon)),
            light_from(space, shade_one(space, look, escaped, 1, photon)));
  look.limits.lost_color_given = true;
  EXPECT_EQ(light_from(space, shade_one(space, look, lost, 1, photon)), (Rgb{0.5, 0, 0.5}));
  for (const Fate fate : {Fate::absorbed, Fate::trapped}) {
    const ShadeOutput output = shade_one(space, look, fate_of(fate));
    EXPECT_TRUE(output.light.empty() && output.secondary.empty() && output.shadows.empty());
  }
}

TEST(Shade, AMirrorSendsItsShareOnUpToTheLimit) {
  const PlannedSpace space = plain_space({floor_quad(5)});
  const Material mirror = mirror_material({0, 0, 0}, {0.9, 0.5, 0.1});
  Appearance look = appearance_with({mirror}, {});
  look.limits.max_bounces = 2;
  Photon photon;
  photon.throughput = {1, 0.5, 1};
  photon.sample = 7;
  photon.slot = 3;
  photon.bounces = 1;
  Arrival arrival = hit_at({1, 0, 1}, {1, -1, 0});
  arrival.tint = {0.5, 1, 1};
  const ShadeOutput output = shade_one(space, look, arrival, 99, photon);
  ASSERT_EQ(output.secondary.size(), 1u);
  const Photon& next = output.secondary[0];
  EXPECT_LT(length(next.direction - normalize(Vec3d{1, 1, 0})), 1e-15);
  EXPECT_LT(length(next.throughput - Rgb{0.45, 0.25, 0.1}), 1e-15);
  EXPECT_EQ(next.position, arrival.position);
  EXPECT_EQ(next.sample, 7u);
  EXPECT_EQ(next.slot, 3u);
  EXPECT_EQ(next.bounces, 2u);
  EXPECT_NE(next.random_key, 99u);
  EXPECT_EQ(next.guard.shape, 0u);
  EXPECT_EQ(next.guard.side, 1.0);
  EXPECT_GT(next.guard.reach, 0.0);
  EXPECT_TRUE(shade_one(space, look, arrival, 99, next).secondary.empty());
}

TEST(Shade, ATexturedMirrorReflectsWhatItsTextureSays) {
  const PlannedSpace space = plain_space({floor_quad(2)});  // its first vertex is (-2, 0, 2)
  const Texture tiles = Checker{{0.9, 0.5, 0.1}, {}, 1.0};
  const Appearance look = appearance_with({Material(DiffuseMirror(Constant{{}}, tiles, 0.0))}, {});
  const ShadeOutput bright = shade_one(space, look, hit_at({-1.5, 0, 1.5}, {1, -1, 0}));
  ASSERT_EQ(bright.secondary.size(), 1u);
  EXPECT_EQ(bright.secondary[0].throughput, (Rgb{0.9, 0.5, 0.1}));
  EXPECT_TRUE(shade_one(space, look, hit_at({-0.5, 0, 1.5}, {1, -1, 0})).secondary.empty());
}

TEST(Shade, ATexturedLampShowsItsTexture) {
  for (const bool picture : {false, true}) {
    auto image = std::make_shared<Image>(2, 1, 3);
    for (int c = 0; c < 3; ++c) image->at(1, 0)[c] = 3.0f;
    const Texture emitted = picture ? Texture(Picture{image}) : Checker{{}, {3, 3, 3}, 2.0};
    const PlannedSpace space = plain_space({floor_quad(2)});
    const Appearance look = appearance_with({Material(DiffuseMirror(Constant{{}}), emitted)}, {});
    const auto seen = [&](double x) {
      return light_from(space, shade_one(space, look, hit_at({x, 0, 1}, {0.1, -1, 0})));
    };
    EXPECT_EQ(seen(-1), Rgb{});
    EXPECT_EQ(seen(1), (Rgb{3, 3, 3}));
  }
}

/// A lamp is seen with its texture, and lights with it: a grey square in a ball of dark and bright
/// tiles shows the mean of what it sees of them.
TEST(Shade, ATexturedLampLightsAsItIsSeen) {
  const Sphere wall({0, 0, 0}, 2.5);
  const Texture tiles = Checker{{4, 4, 4}, {0.5, 0.5, 0.5}, 0.125};
  const PlannedSpace space = plain_space({floor_quad(0.1), wall});
  Appearance look =
      appearance_with({diffuse_material({0.5, 0.5, 0.5})}, {ShapeLight(wall, tiles)}, 2);
  look.limits.shadow_samples = 4;
  const Arrival arrival = hit_at({0.02, 0, 0.01}, {0.2, -1, 0.1});
  const auto light = test::estimate(test::scaled(10000), [&](std::uint64_t key) {
    return light_from(space, shade_one(space, look, arrival, key)).x;
  });
  const auto seen = test::estimate(test::scaled(40000), [&](std::uint64_t key) {
    const double r = std::sqrt(random_number(key, 0)), turn = 2 * pi * random_number(key, 1);
    const Ray ray{arrival.position, {r * std::cos(turn), std::sqrt(1 - r * r), r * std::sin(turn)}};
    const Vec3d x = ray.at(wall.intersect(ray, 0.0, 1e9)->distance);
    return 0.5 * color_at(tiles, wall.surface_at(x, 0)).x;
  });
  EXPECT_NEAR(light.mean, seen.mean, 4 * (light.error + seen.error));
}

TEST(Shade, WhatIsBlackIsNotSentOn) {
  const PlannedSpace space = plain_space({floor_quad(5)});
  const Appearance look =
      appearance_with({diffuse_material({0, 0, 0})}, {PointLight{{0, 1, 0}, {1, 1, 1}}});
  const ShadeOutput output = shade_one(space, look, hit_at({0, 0, 0}, {0, -1, 0}));
  EXPECT_TRUE(output.light.empty() && output.secondary.empty() && output.shadows.empty());
}

TEST(Shade, APhotonsLightDoesNotDependOnItsCompany) {
  const PlannedSpace space = plain_space({floor_quad(5)});
  const Material material = mirror_material({0.5, 0.5, 0.5}, {0.3, 0.3, 0.3}, 0.5);
  const Quad panel = floor_quad(1, 3);
  const Appearance look = appearance_with({material}, {ShapeLight(panel, Constant{{1, 1, 1}})});
  std::vector<Photon> photons(5);
  std::vector<Arrival> arrivals;
  for (std::uint32_t i = 0; i < 5; ++i) {
    photons[i].random_key = i;
    photons[i].sample = i;
    arrivals.push_back(hit_at({0.1 * i, 0, 0}, {0.3, -1, 0.2}));
  }
  ShadeOutput together, apart;
  shade(space, look, photons, arrivals, together);
  for (std::size_t i = 0; i < 5; ++i)
    shade(space, look, std::span(photons).subspan(i, 1), std::span(arrivals).subspan(i, 1), apart);
  ASSERT_EQ(together.shadows.size(), apart.shadows.size());
  for (std::size_t i = 0; i < apart.shadows.size(); ++i) {
    EXPECT_EQ(together.shadows[i].contribution, apart.shadows[i].contribution);
    EXPECT_EQ(together.shadows[i].to, apart.shadows[i].to);
  }
  ASSERT_EQ(together.secondary.size(), apart.secondary.size());
  for (std::size_t i = 0; i < apart.secondary.size(); ++i)
    EXPECT_EQ(together.secondary[i].direction, apart.secondary[i].direction);
  EXPECT_LE(together.shadows.size(), 5 * max_shadow_queries(space, look));
}

TEST(Shade, RandomNumbersAreUsedOnlyWhereItIsSaid) {
  const PlannedSpace space = plain_space({floor_quad(5)});
  const Material plain = diffuse_material({0.5, 0.5, 0.5});
  const Material rough = mirror_material({0.5, 0.5, 0.5}, {0.3, 0.3, 0.3}, 0.5);
  const Light point = PointLight{{1, 2, 3}, {4, 4, 4}};
  const Light panel = ShapeLight(floor_quad(1, 3), Constant{{1, 1, 1}});
  const auto differs = [&](const Appearance& look) {
    const Arrival arrival = hit_at({0, 0, 0}, {0.3, -1, 0.2});
    const ShadeOutput a = shade_one(space, look, arrival, 1),
                      b = shade_one(space, look, arrival, 2);
    const auto direction = [](const ShadeOutput& output) {
      return output.secondary.empty() ? Vec3d{} : output.secondary[0].direction;
    };
    return a.shadows.at(0).to != b.shadows.at(0).to || direction(a) != direction(b);
  };
  for (const Material& material : {plain, rough})
    for (const Light& light : {point, panel}) {
      const Appearance look = appearance_with({material}, {light});
      EXPECT_EQ(uses_random_numbers(look), differs(look));
    }
}

TEST(Shade, ARoughFurnaceGivesBackLessThanItGets) {
  const PlannedSpace space = plain_space({floor_quad(5)});
  for (const double roughness : {0.1, 0.5, 1.0}) {
    const Appearance look = appearance_with({mirror_material({}, {1, 1, 1}, roughness)}, {});
    const auto share = test::estimate(test::scaled(2000), [&](std::uint64_t key) {
      const auto output = shade_one(space, look, hit_at({0, 0, 0}, {1, -0.5, 0}), key);
      return output.secondary.empty() ? 0.0 : output.secondary[0].throughput.x;
    });
    EXPECT_LE(share.mean, 1.0);
    EXPECT_GT(share.mean, 0.4);
    if (roughness < 0.2) {
      EXPECT_GT(share.mean, 0.99);
    }
  }
}

}  // namespace
}  // namespace portalens
