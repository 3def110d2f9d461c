// Things in the planes of others: doors, mirrors and pictures on walls, doors with two sides.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "render/camera_photon.h"
#include "shading/shade.h"
#include "support/flush_scenes.h"
#include "support/scene_text.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

constexpr Engine both_engines[] = {Engine::scalar, Engine::automatic};

std::vector<Photon> photons_of(const World& world) {
  std::vector<Photon> photons;
  for (int y = 0; y < world.film.height; ++y)
    for (int x = 0; x < world.film.width; ++x) photons.push_back(central_photon(world, x, y));
  return photons;
}

std::vector<Arrival> arrivals_of(const PlannedSpace& space, const std::vector<Photon>& photons,
                                 Engine engine) {
  std::vector<Arrival> arrivals(photons.size());
  advance(space, photons, arrivals, engine);
  return arrivals;
}

/// Of the photons of its camera.
std::vector<Arrival> arrivals_of(const World& world, Engine engine) {
  return arrivals_of(world.space, photons_of(world), engine);
}

template <class Which>
long count(const std::vector<Arrival>& arrivals, const Which& which) {
  return std::count_if(arrivals.begin(), arrivals.end(), which);
}

bool is_lost(const Arrival& arrival) { return arrival.fate == Fate::lost; }
bool has_crossed(const Arrival& arrival) { return arrival.crossings > 0; }

TEST(Flush, ADoorShowsWhatLiesBeforeItsExitAndNeverTheWallThatItHangsOn) {
  for (const std::string& scene : {door_on_a_wall, door_on_an_oblique_wall})
    for (const Engine engine : both_engines) {
      const auto arrivals = arrivals_of(compiled(scene), engine);
      EXPECT_GT(count(arrivals, has_crossed), 1000);
      for (const Arrival& arrival : arrivals) {
        EXPECT_LE(arrival.crossings, 1u);
        if (arrival.crossings > 0) {
          EXPECT_EQ(arrival.fate, Fate::escaped);
        }
        if (arrival.fate == Fate::hit) {
          EXPECT_EQ(arrival.object, 0u);
        }
      }
    }
}

TEST(Flush, DoorsOfABentRoomShowTheSameInBothEngines) {
  const World world = compiled(room_with_doors);
  ASSERT_TRUE(world.space.lanes);
  const auto scalar = arrivals_of(world, Engine::scalar);
  const auto lanes = arrivals_of(world, Engine::automatic);
  EXPECT_GT(count(scalar, has_crossed), 1000);
  int differ = 0;
  for (std::size_t i = 0; i < scalar.size(); ++i)
    differ += scalar[i].object != lanes[i].object || scalar[i].crossings != lanes[i].crossings;
  EXPECT_LT(differ, 20);  // of 16,000, along edges
}

TEST(Flush, AMirrorShowsWhatItMirrorsAndNotItsWall) {
  const World world = compiled(mirror_on_a_wall);
  const std::vector<Photon> photons = photons_of(world);
  for (const Engine engine : both_engines) {
    const auto arrivals = arrivals_of(world.space, photons, engine);
    for (const Arrival& arrival : arrivals) ASSERT_EQ(arrival.object, 0u);
    ShadeOutput output;
    shade(world.space, world.appearance, photons, arrivals, output);
    ASSERT_EQ(output.secondary.size(), photons.size());
    for (const Arrival& mirrored : arrivals_of(world.space, output.secondary, engine))
      ASSERT_EQ(mirrored.fate, Fate::escaped);
  }
}

/// Whether the path of a photon leads through a quad.
bool lies_before(const Quad& quad, const Photon& photon) {
  const auto v = quad.vertices();
  const double height = dot(v[0] - photon.position, quad.normal());
  const Vec3d place =
      photon.position + photon.direction * (height / dot(photon.direction, quad.normal()));
  for (std::size_t k = 0; k < v.size(); ++k)
    if (dot(cross(v[(k + 1) % v.size()] - v[k], place - v[k]), quad.normal()) < 0.0) return false;
  return true;
}

TEST(Flush, APictureIsSeenWholeInAnyOrderAndFromBothSides) {
  const World world = compiled(picture_on_a_wall);
  const std::vector<Shape>& shapes = world.space.surfaces.shapes();
  const auto& wall = std::get<Quad>(shapes[0]);
  std::vector<Photon> before = photons_of(world), behind = before;
  for (Photon& photon : behind) {
    const double height = dot(photon.position - wall.vertices()[0], wall.normal());
    photon.position = photon.position - wall.normal() * (2.0 * height);
    photon.direction =
        photon.direction - wall.normal() * (2.0 * dot(photon.direction, wall.normal()));
  }
  const PlannedSpace turned(world.space.physics, 16, {shapes[1], shapes[0]}, {}, {});
  const auto expected = arrivals_of(world.space, before, Engine::scalar);
  int amiss = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    amiss += lies_before(std::get<Quad>(shapes[1]), before[i]) != (expected[i].object == 1);
  EXPECT_LE(amiss, 4);
  for (const Engine engine : both_engines)
    for (const auto& photons : {before, behind}) {
      const auto straight = arrivals_of(world.space, photons, engine);
      const auto reversed = arrivals_of(turned, photons, engine);
      int differ = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        differ += straight[i].object != expected[i].object;
        if (expected[i].fate == Fate::hit) differ += reversed[i].object != 1 - expected[i].object;
      }
      EXPECT_LE(differ, 4);  // an edge may run through a pixel's centre
    }
}

TEST(Flush, PairsBackToBackInOnePlaneAreADoorWithTwoSides) {
  World world = compiled(pairs_back_to_back);
  for (const Engine engine : both_engines)
    for (const bool behind : {false, true}) {
      std::vector<Photon> photons = photons_of(world);
      if (behind)
        for (Photon& photon : photons) {
          photon.position.z = -1.0 - photon.position.z;
          photon.direction.z = -photon.direction.z;
        }
      const auto arrivals = arrivals_of(world.space, photons, engine);
      EXPECT_EQ(count(arrivals, is_lost), 0);
      EXPECT_GT(count(arrivals, has_crossed), 1000);
      EXPECT_EQ(count(arrivals, [](const Arrival& a) { return a.crossings > 1; }), 0);
    }
}

TEST(Flush, APairInOnePlaceIsAnOpenWindow) {
  const World world = compiled(pair_in_one_place);
  const std::vector<Photon> photons = photons_of(world);
  const PlannedSpace open(world.space.physics, 16, {}, {}, world.space.masses);
  const auto expected = arrivals_of(open, photons, Engine::scalar);
  for (const Engine engine : both_engines) {
    const auto arrivals = arrivals_of(world.space, photons, engine);
    EXPECT_EQ(count(arrivals, is_lost), 0);
    EXPECT_NEAR(count(arrivals, has_crossed), 258, 4);
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
      ASSERT_LE(arrivals[i].crossings, 1u);
      ASSERT_EQ(arrivals[i].fate, expected[i].fate);
      if (arrivals[i].fate == Fate::escaped) {
        ASSERT_LT(length(arrivals[i].direction - expected[i].direction), 1e-3);
      }
    }
  }
}

/// A square of that half edge across z, its front towards +z (1) or -z (-1).
std::vector<Vec3d> square(double z, double front, double half = 2.0) {
  return {{-front * half, -half, z},
          {front * half, -half, z},
          {front * half, half, z},
          {-front * half, half, z}};
}

/// Photons that fall onto a square about the origin, some aslant.
std::vector<Photon> shower() {
  std::vector<Photon> photons;
  for (int i = 0; i < 14; ++i)
    for (int j = 0; j < 14; ++j)
      photons.push_back(photon_at({-1.2 + 0.18 * i, -1.2 + 0.18 * j, 5.0},
                                  {0.02 * (j - 7), 0.01 * (i - 7), -1.0}));
  return photons;
}

TEST(Flush, FacingPairsAreAnEndlessCorridorHoweverCloseTheyAre) {
  for (const double gap : {1e-2, 1e-5, 1e-6, 1e-7})
    for (const Engine engine : both_engines) {
      // What enters A, which looks up, leaves B, which looks down on A from right above it.
      std::vector<Portal> portals = portal_pair(square(0.0, 1.0), square(gap, -1.0));
      const PlannedSpace space = space_with(physics_with(1e-4), {}, {}, portals);
      const auto arrivals = arrivals_of(space, shower(), engine);
      EXPECT_EQ(count(arrivals, is_lost), 196) << gap;
    }
}

TEST(Flush, AnExitCloselyBehindItsEntranceLetsAllLightGo) {
  for (const double gap : {1e-2, 1e-5, 1e-6, 1e-7})
    for (const Engine engine : both_engines) {
      const PlannedSpace space =
          space_with(physics_with(1e-4), {}, {}, portal_pair(square(0.0, 1.0), square(-gap, -1.0)));
      for (const Arrival& arrival : arrivals_of(space, shower(), engine)) {
        EXPECT_EQ(arrival.fate, Fate::escaped) << gap;
        EXPECT_EQ(arrival.crossings, 1u) << gap;
      }
    }
}

TEST(Flush, WhatMeetsTheBackOfATwoSidedPortalLeavesTheBackOfItsPair) {
  std::vector<Portal> portals = portal_pair({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                                            {{7, -1, 1}, {7, -1, -1}, {7, 1, -1}, {7, 1, 1}});
  for (Portal& portal : portals) portal.two_sided = true;
  const PlannedSpace space = space_with(physics_with(1e-4), {}, {}, portals);
  const Rigid through = *portals[0].motion();
  std::vector<Photon> photons;
  for (const double side : {1.0, -1.0})
    for (int i = 0; i < 20; ++i)
      photons.push_back(photon_at({-0.9 + 0.09 * i, 0.2, 3.0 * side}, {0.0, 0.01 * i, -side}));
  for (const Engine engine : both_engines) {
    const auto arrivals = arrivals_of(space, photons, engine);
    for (std::size_t i = 0; i < photons.size(); ++i) {
      EXPECT_EQ(arrivals[i].fate, Fate::escaped);
      EXPECT_EQ(arrivals[i].crossings, 1u);
      EXPECT_LT(length(arrivals[i].direction - through.rotate(photons[i].direction)), 1e-6);
      // A's front looks towards +z and B's towards -x: over the front one goes, over the back
      // comes.
      EXPECT_EQ(dot(arrivals[i].direction, portals[1].frame.normal) > 0.0,
                photons[i].position.z > 0.0);
    }
  }
}

TEST(Flush, TwoOneSidedPairsBackToBackAreAsGoodAsOneOfTwoSides) {
  const std::vector<Vec3d> a = square(0.0, 1.0);
  const std::vector<Vec3d> b = {{7, -2, 2}, {7, -2, -2}, {7, 2, -2}, {7, 2, 2}};
  std::vector<Portal> two_sided = portal_pair(a, b);
  for (Portal& portal : two_sided) portal.two_sided = true;
  const std::vector<Portal> pairs = one_sided(two_sided);
  ASSERT_EQ(pairs.size(), 4u);
  for (const Portal& portal : pairs) {
    EXPECT_LT(length(polygon_frame(portal.vertices).normal - portal.frame.normal), 1e-15);
    EXPECT_LT(length(polygon_frame(portal.vertices).right - portal.frame.right), 1e-15);
  }
  EXPECT_LT(congruence_error(pairs[2].vertices, pairs[3].vertices), 1e-15);
  for (std::size_t i = 2; i < 4; ++i)
    EXPECT_LT(length(motion_through(pairs[i].frame, pairs[pairs[i].pair].frame).move({1, 2, 3}) -
                     pairs[i].motion()->move({1, 2, 3})),
              1e-14);
  std::vector<Portal> separate = pairs;
  for (Portal& portal : separate) portal.two_sided = false;
  const Physics physics = physics_with(1e-4, 0.5);
  const std::vector<Mass> masses = {mass_at({3, 0.5, 2}, 100, physics)};
  for (const char* coupling :
       {"none", "closest-point", "shortest-path", "graviton-map", "portal-mass"}) {
    Physics with = physics;
    with.portal_gravity = coupling;
    const PlannedSpace one = space_with(with, masses, {}, two_sided);
    const PlannedSpace two = space_with(with, masses, {}, separate);
    std::vector<Photon> photons = shower(), more = photons;
    for (Photon& photon : more) {
      photon.position.z = -photon.position.z;
      photon.direction.z = -photon.direction.z;
    }
    photons.insert(photons.end(), more.begin(), more.end());
    for (const Engine engine : both_engines) {
      const auto expected = arrivals_of(two, photons, engine);
      EXPECT_GT(count(expected, has_crossed), 300) << coupling;
      const auto arrivals = arrivals_of(one, photons, engine);
      for (std::size_t i = 0; i < photons.size(); ++i) {
        ASSERT_EQ(arrivals[i].fate, expected[i].fate) << coupling;
        ASSERT_EQ(arrivals[i].crossings, expected[i].crossings) << coupling;
        ASSERT_LT(length(arrivals[i].direction - expected[i].direction), 1e-5) << coupling;
      }
    }
  }
}

}  // namespace
}  // namespace portalens::test
