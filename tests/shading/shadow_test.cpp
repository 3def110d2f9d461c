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

using test::plain_space;

ShadowQuery between(Vec3d from, Vec3d to) {
  ShadowQuery query;
  query.from = from;
  query.to = to;
  return query;
}

/// A front that faces +z at z = 0, and its pair, turned and far away.
std::vector<Portal> window_pair() {
  const std::vector<Vec3d> a{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const Rigid motion = rotation_about({0, 0, 0}, {20, 70, -30});
  std::vector<Vec3d> b;
  for (const int i : {1, 0, 3, 2}) b.push_back(motion.rotate(a[i]) + Vec3d{30, 10, -20});
  return test::portal_pair(a, b);
}

TEST(Shadow, IsCastBySurfacesBetween) {
  const PlannedSpace space = plain_space({Sphere({0, 0, 0}, 1)});
  EXPECT_FALSE(visible(space, between({0, 0, -3}, {0, 0, 3})));
  EXPECT_FALSE(visible(space, between({0, 0, 0}, {0, 0, 3})));
  EXPECT_TRUE(visible(space, between({0, 1.01, -3}, {0, 1.01, 3})));
  EXPECT_TRUE(visible(space, between({0, 0, 2}, {0, 0, 3})));
  EXPECT_TRUE(visible(space, between({0, 0, 3}, {0, 0, 2})));
}

TEST(Shadow, ALightOnASurfaceIsNotHiddenByIt) {
  const PlannedSpace space = plain_space({Sphere({0, 0, 0}, 1)});
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d on = random.direction(), from = random.direction() * random.uniform(1.1, 5);
    const double facing = dot(from - on, on);
    if (std::fabs(facing) < 1e-3) continue;
    EXPECT_EQ(visible(space, between(from, on)), facing > 0) << facing;
  }
}

TEST(Shadow, ASurfaceDoesNotHideItselfFromTheSideOnWhichTheRayLeaves) {
  const PlannedSpace space = plain_space({Sphere({100, 0, 0}, 1)});
  test::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d n = random.direction(), to = random.direction();
    const double cosine = dot(n, to);
    if (std::fabs(cosine) < 1e-3) continue;
    ShadowQuery query = between(Vec3d{100, 0, 0} + n, Vec3d{100, 0, 0} + n + to * 5.0);
    query.guard = {0, 0, cosine > 0 ? 1.0 : -1.0, 1e-4};
    EXPECT_EQ(visible(space, query), cosine > 0);
  }
}

TEST(Shadow, IsCastByHorizonsAndNotByOtherMasses) {
  Mass hole;
  hole.gm = 1.0;
  hole.horizon_radius = 1.0;
  hole.influence = 100.0;
  Mass cluster = hole;
  cluster.horizon = false;
  const PlannedSpace with_hole = plain_space({}, {}, {hole}),
                     with_cluster = plain_space({}, {}, {cluster});
  EXPECT_FALSE(visible(with_hole, between({0, 0.99, -3}, {0, 0.99, 3})));
  EXPECT_TRUE(visible(with_hole, between({0, 1.01, -3}, {0, 1.01, 3})));
  EXPECT_TRUE(visible(with_hole, between({0, 0, 2}, {0, 0, 3})));
  EXPECT_TRUE(visible(with_cluster, between({0, 0.5, -3}, {0, 0.5, 3})));
}

TEST(Shadow, IsCastByFrontsAndMaterialBacksButNotByOpenBacks) {
  std::vector<Portal> portals = window_pair();
  const Vec3d front{0.2, 0.1, 2}, back{0.2, 0.1, -2};
  const PlannedSpace open = plain_space({}, portals);
  EXPECT_FALSE(visible(open, between(front, back)));
  EXPECT_TRUE(visible(open, between(back, front)));
  EXPECT_TRUE(visible(open, between({2, 0, 2}, {2, 0, -2})));
  portals[0].back_material = 0;
  EXPECT_FALSE(visible(plain_space({}, portals), between(back, front)));
}

/// Light through a portal is the light of the scene unfolded at it: what lies before the pair is
/// moved behind the portal, and only what passes the window counts.
TEST(Shadow, ThroughAPortalEqualsTheUnfoldedSceneWithoutPortals) {
  const std::vector<Portal> portals = window_pair();
  const Rigid& through = *portals[0].motion();
  const Sphere here({0.3, 0.2, 0.8}, 0.3);
  const Sphere image({-0.2, 0.1, -1.0}, 0.4);
  const Sphere there(through.move(image.center()), image.radius());
  Mass hole;
  hole.gm = 1.0;
  hole.center = through.move({0.5, -0.5, -1.5});
  hole.horizon_radius = 0.2;
  Mass hole_image = hole;
  hole_image.center = through.move_back(hole.center);
  const PlannedSpace folded = plain_space({here, there}, portals, {hole});
  const PlannedSpace unfolded = plain_space({here, image}, {}, {hole_image});

  test::Random random(3);
  int seen = 0, hidden = 0, outside = 0;
  for (int i = 0; i < test::scaled(20000); ++i) {
    const Vec3d from{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(0.01, 3)};
    const Vec3d to{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-3, -0.01)};
    if (length(from - here.center()) < 0.31 || length(to - image.center()) < 0.41) continue;
    const Vec3d y = from + (to - from) * (from.z / (from.z - to.z));
    const double rim = std::fmax(std::fabs(y.x), std::fabs(y.y));
    if (std::fabs(rim - 1) < 1e-9) continue;
    ShadowQuery query = between(from, to);
    query.portal = 0;
    const bool expected = rim < 1 && visible(unfolded, between(from, to));
    EXPECT_EQ(visible(folded, query), expected);
    ++(rim > 1 ? outside : expected ? seen : hidden);
  }
  EXPECT_GT(std::min({seen, hidden, outside}), test::scaled(1000));
}

TEST(Shadow, AWallInThePlaneOfAPortalDoesNotCloseIt) {
  std::vector<Portal> portals = window_pair();
  std::vector<Shape> walls;
  for (const Portal& portal : portals) {
    std::vector<Vec3d> corners;
    for (const Vec3d& v : portal.vertices)
      corners.push_back(portal.frame.origin + (v - portal.frame.origin) * 3.0);
    walls.push_back(Quad(corners));
  }
  const PlannedSpace space = plain_space(walls, portals);
  ShadowQuery query = between({0.1, 0.2, 2}, {-0.3, 0.4, -2});
  query.portal = 0;
  EXPECT_TRUE(visible(space, query));
  query.to = {4, 0.4, -2};
  EXPECT_FALSE(visible(space, query));
}

/// The whole path: shade asks, visible answers, and the light is that of the unfolded scene times
/// the tint.
TEST(Shadow, LightThroughAPortalIsThatOfItsImageTimesTheTint) {
  std::vector<Portal> portals = window_pair();
  portals[0].tint = {0.5, 0.25, 1};
  const Rigid& through = *portals[0].motion();
  const Quad floor(
      std::array<Vec3d, 4>{{{-3, -1.5, 3}, {3, -1.5, 3}, {3, -1.5, 0}, {-3, -1.5, 0}}});
  const Vec3d image{0.2, 0.3, -1};
  PointLight light, light_image;
  light.position = through.move(image);
  light_image.position = image;
  light.intensity = light_image.intensity = {4, 4, 4};
  const Material grey = test::diffuse_material({0.5, 0.5, 0.5});
  const PlannedSpace folded = plain_space({floor}, portals), unfolded = plain_space({floor});
  const Appearance look = test::appearance_with({grey}, {light});
  const Appearance look_unfolded = test::appearance_with({grey}, {light_image});
  test::Random random(4);
  int lit = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3d x{random.uniform(-3, 3), -1.5, random.uniform(0.01, 3)};
    const Arrival arrival = test::hit_at(x, {0.1, -1, 0.2});
    ShadeOutput output = test::shade_one(folded, look, arrival);
    Rgb through_portal;
    for (const ShadowQuery& query : output.shadows)
      if (query.portal == 0 && visible(folded, query)) through_portal += query.contribution;
    const Vec3d y = x + (image - x) * (x.z / (x.z - image.z));
    Rgb expected;
    if (std::fmax(std::fabs(y.x), std::fabs(y.y)) < 1)
      expected = test::light_from(unfolded, test::shade_one(unfolded, look_unfolded, arrival)) *
                 portals[0].tint;
    EXPECT_LT(length(through_portal - expected), 1e-12);
    if (expected != Rgb{}) ++lit;
  }
  EXPECT_GT(lit, 100);
}

TEST(Shadow, AMaterialBackIsShadedFromBehindAndShinesThere) {
  std::vector<Portal> portals = window_pair();
  portals[0].back_material = 0;
  const PlannedSpace space = plain_space({}, portals);
  PointLight light;
  light.position = {0, 0, -2};
  light.intensity = {4, 4, 4};
  const Appearance look =
      test::appearance_with({Material(DiffuseMirror(Constant{{0.5, 0.5, 0.5}}, Constant{{1, 1, 1}}),
                                      Constant{{0, 0, 1}})},
                            {light}, 0);
  Arrival arrival = test::hit_at({0, 0, 0}, {0, 0.2, 1});
  arrival.met = Met::portal_back;
  const ShadeOutput output = test::shade_one(space, look, arrival);
  const double expected = 0.5 * 4 / 4 / std::numbers::pi;
  EXPECT_NEAR(test::light_from(space, output).x, expected, 1e-6);
  EXPECT_NEAR(test::light_from(space, output).z, expected + 1, 1e-6);
  // Its mirrored photon leaves to where it came from, and does not fall through the front.
  ASSERT_EQ(output.secondary.size(), 1u);
  const Photon& next = output.secondary[0];
  EXPECT_LT(next.direction.z, 0.0);
  EXPECT_FALSE(space.portals.nearest({next.position, next.direction}, 0.0, 10.0,
                                     space.surfaces.flush().left_by(next.guard)));
}

}  // namespace
}  // namespace portalens
