// Faces of all kinds in both engines: an ellipse is its polygon of many edges, a concave polygon
// what triangles put together.
#include "support/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "math/triangulate.h"
#include "support/lanes.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

const Frame entrance{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Frame outlet{{7, 0.5, -2}, {0.6, 0, 0.8}, {0, 1, 0}, {-0.8, 0, 0.6}};

PlannedSpace space_of(std::vector<Portal> portals, const char* coupling, double tolerance = 1e-4) {
  Physics physics = physics_with(tolerance, 1.0);
  physics.portal_gravity = coupling;
  physics.max_steps = 20000;
  return space_with(physics,
                    {mass_at({0.4, 0.3, 1.7}, 60, physics), mass_at({6, 1, -0.5}, 40, physics)}, {},
                    std::move(portals));
}

/// From a shell about the entrance towards it, most of them.
std::vector<Photon> photons_at_the_entrance(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vec3d from = random.direction() * 9.0;
    const Vec3d to{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-1, 1)};
    photons.push_back(photon_at(from, to - from));
  }
  return photons;
}

struct Difference {
  std::size_t unlike = 0;
  std::vector<double> apart;  ///< of directions, ascending

  [[nodiscard]] double quantile(double share) const {
    return apart[static_cast<std::size_t>(share * static_cast<double>(apart.size() - 1))];
  }
};

Difference difference(const std::vector<Arrival>& a, const std::vector<Arrival>& b) {
  Difference found;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].fate != b[i].fate || a[i].object != b[i].object || a[i].crossings != b[i].crossings)
      ++found.unlike;
    else if (a[i].fate == Fate::escaped)
      found.apart.push_back(length(a[i].direction - b[i].direction));
  }
  std::sort(found.apart.begin(), found.apart.end());
  return found;
}

std::vector<Arrival> by_the_scalar_engine(const PlannedSpace& space,
                                          const std::vector<Photon>& photons) {
  std::vector<Arrival> arrivals(photons.size());
  advance(space, photons, arrivals, Engine::scalar);
  return arrivals;
}

class FacesOfCoupling : public testing::TestWithParam<const char*> {};

TEST_P(FacesOfCoupling, AnEllipseIsThePolygonOfManyEdges) {
  const auto photons = photons_at_the_entrance(scaled(60), 21);
  // Every edge is looked at wherever gravity is asked for.
  const int edges = std::string_view(GetParam()) == "none" ? 512 : 192;
  for (const double along : {1.2, 0.6}) {
    const PlannedSpace round =
        space_of(pair_with(ellipse_input(entrance, 1.2, along), entrance, outlet), GetParam());
    const PlannedSpace edged =
        space_of(pair_with(many_edges(1.2, along, edges), entrance, outlet), GetParam());
    const Difference found =
        difference(by_the_scalar_engine(round, photons), by_the_scalar_engine(edged, photons));
    EXPECT_LE(found.unlike, photons.size() / 50 + 1) << along;
    EXPECT_LT(found.quantile(0.5), 3e-5) << along;
    EXPECT_LT(found.quantile(0.97), 1e-4) << along;
  }
}

INSTANTIATE_TEST_SUITE_P(Couplings, FacesOfCoupling,
                         testing::Values("none", "closest-point", "shortest-path", "graviton-map",
                                         "portal-mass"),
                         [](const auto& kind) {
                           std::string name = kind.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Faces, AConcaveOneIsWhatTrianglesPutTogether) {
  for (const std::vector<Vec3d>& corners : {letter_l(), star(1.5, 0.4), comb()}) {
    const FaceInput whole = polygon_input(corners);
    std::vector<Portal> triangles;
    const std::vector<Portal> one = pair_with(whole, entrance, outlet);
    for (const auto& [a, b, c] : triangulate(corners)) {
      const auto first = static_cast<std::uint32_t>(triangles.size());
      const auto corner = [&](std::size_t i) { return one[0].vertices[i]; };
      Portal front, back;
      give_face(front, polygon_input({corner(a), corner(b), corner(c)}));
      give_face(back,
                polygon_input({one[0].motion()->move(corner(b)), one[0].motion()->move(corner(a)),
                               one[0].motion()->move(corner(c))}));
      front.pair = first + 1, back.pair = first;
      front.passage = RigidPassage(motion_through(front.frame, back.frame));
      back.passage = RigidPassage(motion_through(back.frame, front.frame));
      triangles.push_back(front);
      triangles.push_back(back);
    }
    Physics physics = physics_with(1e-4, 1.0);
    const PlannedSpace a = space_with(physics, {}, {}, one),
                       b = space_with(physics, {}, {}, triangles);
    const auto photons = photons_at_the_entrance(scaled(3000), 22);
    const auto in_one = by_the_scalar_engine(a, photons),
               in_many = by_the_scalar_engine(b, photons);
    std::size_t crossed = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
      crossed += in_one[i].crossings > 0;
      ASSERT_EQ(in_one[i].crossings, in_many[i].crossings) << i;
      ASSERT_LT(length(in_one[i].direction - in_many[i].direction), 1e-12);
    }
    EXPECT_GT(crossed, photons.size() / 20);
  }
}

class LanesOfFaces : public testing::TestWithParam<std::pair<const char*, bool>> {};

TEST_P(LanesOfFaces, AgreeWithTheScalarEngineAndEachOther) {
  const auto [coupling, round] = GetParam();
  const auto photons = photons_at_the_entrance(scaled(600), 23);
  for (int k = 0; k < 2; ++k) {
    const FaceInput face = round ? ellipse_input(entrance, 1.2, k ? 0.7 : 1.2)
                                 : polygon_input(k ? letter_l() : star(1.5, 0.45));
    const PlannedSpace space = space_of(pair_with(face, entrance, outlet), coupling);
    ASSERT_TRUE(space.lanes) << space.no_lanes_because;
    const auto scalar = by_the_scalar_engine(space, photons);
    std::vector<Arrival> lanes(photons.size());
    advance(space, photons, lanes);
    const Difference found = difference(lanes, scalar);
    EXPECT_LE(found.unlike, photons.size() / 500 + 2);
    EXPECT_LT(found.quantile(0.5), 3e-5);
    EXPECT_LT(found.quantile(0.99), 1e-4);
    expect_same_bits_with_every_set(space, {photons.begin(), photons.begin() + 32});
  }
}

INSTANTIATE_TEST_SUITE_P(Couplings, LanesOfFaces,
                         testing::Values(std::pair("none", true), std::pair("portal-mass", true),
                                         std::pair("none", false), std::pair("portal-mass", false),
                                         std::pair("closest-point", false)));

/// There the nearest point of the rim swings round, and what acts through it with that.
TEST(Faces, PathsBehindTheMiddleOfACircleKeepTheTolerance) {
  Random random(21);
  std::vector<Photon> photons;
  for (int i = 0; i < scaled(2000); ++i) {
    const double aside = std::pow(10.0, random.uniform(-3, 0)), turn = random.uniform(0, 6.3);
    const Vec3d way{std::cos(turn), std::sin(turn), random.uniform(-0.1, 0.1)};
    const Vec3d middle{-std::sin(turn) * aside, std::cos(turn) * aside, random.uniform(-1.0, -0.2)};
    photons.push_back(photon_at(middle - way * random.uniform(2, 6), way));
  }
  for (const char* coupling : {"closest-point", "graviton-map"}) {
    const auto found_to = [&](double tolerance) {
      return space_of(pair_with(ellipse_input(entrance, 1.2, 1.2), entrance, outlet), coupling,
                      tolerance);
    };
    const PlannedSpace space = found_to(1e-4);
    ASSERT_TRUE(space.lanes) << space.no_lanes_because;
    const auto exact = by_the_scalar_engine(found_to(1e-8), photons);
    std::vector<Arrival> lanes(photons.size());
    advance(space, photons, lanes);
    for (const auto& arrivals : {lanes, by_the_scalar_engine(space, photons)}) {
      const Difference found = difference(arrivals, exact);
      EXPECT_LE(found.unlike, photons.size() / 500);
      EXPECT_LT(found.quantile(0.99), 1e-4) << coupling;
      EXPECT_LT(found.apart.back(), 5e-4) << coupling;
    }
  }
}

TEST(Faces, LanesSayWhatTheyLeaveToTheScalarEngine) {
  const auto why = [](const FaceInput& face, const char* coupling) {
    const PlannedSpace space = space_of(pair_with(face, entrance, outlet), coupling);
    return space.lanes ? std::string("nothing") : space.no_lanes_because;
  };
  const FaceInput round = ellipse_input(entrance, 1.2, 0.7), notched = polygon_input(letter_l());
  for (const char* coupling : {"closest-point", "graviton-map"})
    EXPECT_EQ(why(round, coupling), "nothing");
  EXPECT_EQ(why(notched, "shortest-path"), "nothing");
  EXPECT_NE(why(round, "shortest-path").find("is an ellipse"), std::string::npos);
}

}  // namespace
}  // namespace portalens::test
