// Lamps of [[light]] tables that are no points.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "geometry/sphere.h"
#include "math/black_body.h"
#include "support/list_types.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/shading.h"

namespace portalens::test {
namespace {

using std::numbers::pi;
constexpr double degree = pi / 180.0;

template <class Lamp>
Lamp lamp(const std::vector<std::pair<std::string, Value>>& entries) {
  Table table{"light", {}, {}};
  for (const auto& [key, value] : entries) table.set(key, value);
  Faults faults;
  Parameters parameters(table, faults);
  Lamp made = Lamp::from(parameters);
  parameters.finish();
  faults.raise();
  return made;
}

SunLight sun(Vec3d direction, double irradiance, double angle, bool visible = true) {
  return lamp<SunLight>({{"direction", value_of({direction.x, direction.y, direction.z})},
                         {"intensity", value_of(irradiance)},
                         {"angle", value_of(angle)},
                         {"visible", {visible, {}}}});
}

SpotLight spot(double angle, double blend) {
  return lamp<SpotLight>({{"position", value_of({0, 4, 0})},
                          {"direction", value_of({0, -2, 0})},
                          {"intensity", value_of({8, 16, 32})},
                          {"angle", value_of(angle)},
                          {"blend", value_of(blend)}});
}

Quad floor_quad(double half) {
  return Quad(std::array<Vec3d, 4>{
      {{-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}}});
}

TEST(SpotLight, ShinesAlongItsAxisAsAPointAndNotBesideItsCone) {
  const SpotLight light = spot(60, 0.5);
  EXPECT_LT(length(light.sample({0, 0, 0}, 0, 0).facing - Rgb{0.5, 1, 2}), 1e-15);
  const auto at = [&](double degrees) {
    return light
        .sample(Vec3d{0, 4, 0} + Vec3d{std::sin(degrees * degree), -std::cos(degrees * degree), 0},
                0, 0)
        .facing.x;
  };
  EXPECT_DOUBLE_EQ(at(14.9), 8.0);
  EXPECT_EQ(at(30.1), 0.0);
  EXPECT_EQ(at(180.0), 0.0);
  const double half = std::acos(0.5 * (std::cos(15 * degree) + std::cos(30 * degree))) / degree;
  EXPECT_NEAR(at(half), 4.0, 1e-12);
  EXPECT_DOUBLE_EQ(spot(60, 0).sample({1, 3, 0}, 0, 0).facing.x, 0.0);
  EXPECT_DOUBLE_EQ(spot(90.1, 0).sample({1, 3, 0}, 0, 0).facing.x, 4.0);
}

TEST(SunLight, LightsEveryPlaceAlike) {
  const PlannedSpace space = plain_space({floor_quad(1000)});
  const Appearance look =
      appearance_with({diffuse_material({0.5, 0.5, 0.5})}, {sun({3, -4, 0}, 10, 0)});
  for (const Vec3d x : {Vec3d{0, 0, 0}, {900, 0, -700}}) {
    const Rgb light = light_from(space, shade_one(space, look, hit_at(x, {0, -1, 0.1})));
    EXPECT_NEAR(light.x, 0.5 / pi * 10 * 0.8, 1e-12);
  }
}

TEST(SunLight, HasTheShadowOfWhatIsFarAway) {
  const PlannedSpace space = plain_space({floor_quad(5), Sphere({300, 400, 0}, 1)});
  const Appearance look =
      appearance_with({diffuse_material({0.5, 0.5, 0.5})}, {sun({-3, -4, 0}, 10, 0)}, 2);
  const auto light_at = [&](double x) {
    return light_from(space, shade_one(space, look, hit_at({x, 0, 0}, {0, -1, 0.1}))).x;
  };
  EXPECT_EQ(light_at(0.0), 0.0);
  EXPECT_EQ(light_at(1.2), 0.0);
  EXPECT_GT(light_at(1.3), 0.0);
}

/// Half of the disc stands over the edge of what hides it.
TEST(SunLight, HasAPenumbraAsWideAsItsDisc) {
  const Quad roof(std::array<Vec3d, 4>{{{0, 10, 50}, {50, 10, 50}, {50, 10, -50}, {0, 10, -50}}});
  const PlannedSpace space = plain_space({floor_quad(5), roof});
  const Appearance look =
      appearance_with({diffuse_material({1, 1, 1})}, {sun({0, -1, 0}, pi, 10)}, 2);
  const double edge = 10 * std::tan(5 * degree);
  const auto light_at = [&](double x) {
    return estimate(2000,
                    [&](std::uint64_t key) {
                      return light_from(space, shade_one(space, look,
                                                         hit_at({x, 0, 0}, {0, -1, 0.1}), key))
                          .x;
                    })
        .mean;
  };
  EXPECT_NEAR(light_at(-1.01 * edge), 1.0, 0.01);
  EXPECT_NEAR(light_at(0.0), 0.5, 0.05);
  EXPECT_EQ(light_at(1.01 * edge), 0.0);
}

/// What is seen of it gives as much light as it is said to.
TEST(SunLight, ItsDiscInTheSkyShinesAsItLights) {
  Environment sky;
  sky.color = {};
  sky.discs = {*sun({1, -2, 3}, 7, 30).disc()};
  const Vec3d towards = normalize(Vec3d{-1, 2, -3});
  Random random(5);
  const auto arrived = estimate(200000, [&](std::uint64_t) {
    const Vec3d direction = random.direction();
    return 4 * pi * sky.radiance(direction).x * std::fmax(0.0, dot(direction, towards));
  });
  EXPECT_NEAR(arrived.mean, 7.0, 4 * arrived.error);
  EXPECT_FALSE(sun({0, -1, 0}, 1, 30, false).disc());
  EXPECT_FALSE(sun({0, -1, 0}, 1, 0).disc());
}

/// From behind the pair's face the sun shines out of the portal, turned as the view is.
TEST(SunLight, ShinesThroughAPortalToo) {
  std::vector<Portal> portals = portal_pair({{-2, 1, 0}, {2, 1, 0}, {2, 5, 0}, {-2, 5, 0}},
                                            {{50, 1, -2}, {50, 1, 2}, {50, 5, 2}, {50, 5, -2}});
  const Vec3d out_of_pair = portals[1].frame.normal;
  const PlannedSpace space = plain_space({floor_quad(20)}, portals);
  // Towards the sun it goes up and away from the pair's front.
  const Vec3d towards = normalize(out_of_pair + Vec3d{0, 1, 0});
  const Appearance look =
      appearance_with({diffuse_material({0.5, 0.5, 0.5})}, {sun(-towards, 10, 0)});
  const Vec3d through = portals[0].motion()->rotate_back(towards);
  EXPECT_NEAR(through.y, std::sqrt(0.5), 1e-12);
  EXPECT_LT(through.z, -0.7);
  const Arrival before = hit_at({0, 0, 3}, {0, -1, 0.1});
  double contribution = 0.0;
  const ShadeOutput output = shade_one(space, look, before);
  for (const ShadowQuery& query : output.shadows)
    if (query.portal != no_portal && visible(space, query)) contribution += query.contribution.x;
  EXPECT_NEAR(contribution, 0.5 / pi * 10 * std::sqrt(0.5), 1e-12);
}

/// On a floor among balls and a pair of doors: as a point does that is very far and very bright.
TEST(SunLight, InRandomPlacesItIsAPointVeryFarAway) {
  Random random(8);
  int lit = 0, through_portals = 0;
  for (int i = 0; i < scaled(300); ++i) {
    std::vector<Shape> shapes{floor_quad(20)};
    for (int k = 0; k < 5; ++k) {
      const Vec3d center = random.point(5);
      const double radius = random.uniform(0.2, 1.0);
      shapes.emplace_back(Sphere(center, radius));
    }
    const double z = random.uniform(-3, -1), width = random.uniform(1, 4);
    const PlannedSpace space = plain_space(
        shapes, portal_pair({{-width, 0.1, z}, {width, 0.1, z}, {width, 4, z}, {-width, 4, z}},
                            {{8, 0.1, -width}, {8, 0.1, width}, {8, 4, width}, {8, 4, -width}}));
    Vec3d towards = random.direction();
    towards.y = std::fabs(towards.y);
    constexpr double far = 1e8;
    const Vec3d place = towards * far;
    const double intensity = 3 * far * far;
    const Material grey = diffuse_material({0.5, 0.5, 0.5});
    const Appearance sunny = appearance_with({grey}, {sun(-towards, 3, 0)}, 6);
    const Appearance pointed =
        appearance_with({grey}, {PointLight{place, {intensity, intensity, intensity}}}, 6);
    const double x = random.uniform(-4, 4), depth = random.uniform(-1, 4);
    const Arrival arrival = hit_at({x, 0, depth}, {0, -1, 0.1});
    const ShadeOutput output = shade_one(space, sunny, arrival);
    const double found = light_from(space, output).x;
    EXPECT_NEAR(found, light_from(space, shade_one(space, pointed, arrival)).x, 1e-5) << i;
    lit += found > 0.0 ? 1 : 0;
    for (const ShadowQuery& query : output.shadows)
      through_portals += query.portal != no_portal && visible(space, query) ? 1 : 0;
  }
  EXPECT_GT(lit, scaled(100));
  EXPECT_GT(through_portals, scaled(300) / 50);
}

TEST(Lamps, TakeANumberAndAColourOrATemperature) {
  const auto point = [](const std::vector<std::pair<std::string, Value>>& more) {
    std::vector<std::pair<std::string, Value>> entries = more;
    entries.emplace_back("position", value_of({0, 1, 0}));
    return lamp<PointLight>(entries).intensity;
  };
  EXPECT_EQ(point({{"intensity", value_of(3)}}), (Rgb{3, 3, 3}));
  EXPECT_EQ(point({{"intensity", value_of(3)}, {"color", value_of({1, 0.5, 0})}}),
            (Rgb{3, 1.5, 0}));
  EXPECT_EQ(point({{"intensity", value_of(2)}, {"temperature", value_of(3000)}}),
            black_body_color(3000) * 2.0);
  EXPECT_THROW(point({{"intensity", value_of(2)},
                      {"temperature", value_of(3000)},
                      {"color", value_of({1, 1, 1})}}),
               SceneError);
  EXPECT_THROW(spot(0, 0), SceneError);
  EXPECT_THROW(sun({0, 0, 0}, 1, 1), SceneError);
}

}  // namespace
}  // namespace portalens::test
