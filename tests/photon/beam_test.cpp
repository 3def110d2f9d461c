// The light between four photons: nothing that a photon among them meets may be overlooked.
#include "photon/beam.h"

#include <gtest/gtest.h>

#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

constexpr double cell = 0.011;  // radians: four pixels of a picture of 256
const Vec3d eye{0, 2, 12};

std::vector<Portal> gates() {
  return portal_pair({{-4, 0.5, -2}, {-2, 0.5, -2}, {-2, 2.5, -2}, {-4, 2.5, -2}},
                     {{2, 0.5, -3}, {4, 0.5, -3}, {4, 2.5, -3}, {2, 2.5, -3}});
}

/// A ground, a mass, and a pair of portals that carry its pull; and what a test adds.
PlannedSpace space_of(std::vector<Shape> more_shapes = {}, std::vector<Mass> more_masses = {},
                      std::vector<Portal> more_portals = {}) {
  Physics physics = physics_with(1e-4, 0.5);
  physics.portal_gravity = "closest-point";
  physics.portal_gravity_depth = 1;
  const std::array<Vec3d, 4> ground = {{{-30, 0, 30}, {30, 0, 30}, {30, 0, -30}, {-30, 0, -30}}};
  std::vector<Shape> shapes{Quad(ground)};
  for (Shape& shape : more_shapes) shapes.push_back(std::move(shape));
  std::vector<Mass> masses{mass_at({-2, 2, 0.5}, 300, physics)};
  for (Mass& mass : more_masses) masses.push_back(std::move(mass));
  std::vector<Portal> portals = gates();
  for (Portal& portal : more_portals) {
    portal.pair += 2;
    portals.push_back(std::move(portal));
  }
  return space_with(physics, std::move(masses), std::move(shapes), std::move(portals));
}

/// Four photons through the corners of a cell of the picture, and one between them.
struct Beam {
  std::array<Arrival, 4> arrivals;
  std::array<PathRecord, 4> records;
  Photon between;

  Beam(const PlannedSpace& space, Random& random) {
    const double x = random.uniform(-0.5, 0.5), y = random.uniform(-0.3, 0.3);
    std::array<Photon, 4> photons;
    for (std::size_t i = 0; i < 4; ++i)
      photons[i] = at(x + (i % 2 == 0 ? 0 : cell), y + (i < 2 ? 0 : cell));
    advance_with_records(space, photons, arrivals, records);
    between = at(x + random.uniform(0, cell), y + random.uniform(0, cell));
  }
  static Photon at(double x, double y) { return photon_at(eye, {x, y, -1.0}); }

  /// Whether the four met the same.
  [[nodiscard]] bool agrees() const {
    for (std::size_t i = 0; i < 4; ++i)
      if (!records[i].known() || records[i].portals() != records[0].portals() ||
          arrivals[i].fate != arrivals[0].fate || arrivals[i].object != arrivals[0].object ||
          arrivals[i].met != arrivals[0].met)
        return false;
    return arrivals[0].fate == Fate::hit || arrivals[0].fate == Fate::escaped;
  }
  [[nodiscard]] bool clear(const PlannedSpace& space) const {
    return BeamGuard::over(space)->clear({&records[0], &records[1], &records[2], &records[3]},
                                         arrivals[0]);
  }
};

/// Some place on the path of the photon between, and how far that is along its path; never the
/// first or the last.
std::optional<std::pair<Vec3d, double>> place_between(const PlannedSpace& space,
                                                      const Photon& photon, Random& random) {
  PathTrace path_trace;
  (void)advance_recorded(space, photon, path_trace);
  std::vector<std::pair<Vec3d, double>> places;
  double way = 0.0;
  for (const auto& stretch : path_trace.stretches)
    for (std::size_t i = 1; i < stretch.size(); ++i) {
      way += length(stretch[i] - stretch[i - 1]);
      if (i + 1 < stretch.size() && way < 30.0) places.emplace_back(stretch[i], way);
    }
  if (places.empty()) return std::nullopt;
  return places[random.bits() % places.size()];
}

/// Puts small things on the path of photons between four others.
/// @param with  the space with the thing at that place, a tenth of a pixel large
template <class With>
void expect_seen(const With& with) {
  const PlannedSpace space = space_of();
  Random random(21);
  int tried = 0, through_portals = 0;
  for (int i = 0; i < scaled(400); ++i) {
    const Beam beam(space, random);
    if (!beam.agrees()) continue;
    const auto place = place_between(space, beam.between, random);
    if (!place) continue;
    ++tried;
    if (beam.arrivals[0].crossings > 0) ++through_portals;
    const double size = 0.1 * 0.25 * cell * place->second;
    EXPECT_FALSE(beam.clear(with(place->first, size)))
        << "at " << place->first.x << ' ' << place->first.y << ' ' << place->first.z;
  }
  EXPECT_GT(tried, scaled(400) / 4);
  EXPECT_GT(through_portals, 0);
}

TEST(BeamGuard, SeesABallOnTheWayOfAnyPhotonBetween) {
  expect_seen([](Vec3d place, double size) { return space_of({Sphere(place, size)}); });
}

TEST(BeamGuard, SeesATriangleOnTheWayOfAnyPhotonBetween) {
  Random random(22);
  expect_seen([&](Vec3d place, double size) {
    const Vec3d a = random.direction() * size, b = any_perpendicular(normalize(a)) * size;
    const std::array<Vec3d, 3> corners = {place - a, place + a, place + b};
    return space_of({Quad(corners)});
  });
}

TEST(BeamGuard, SeesAHorizonOnTheWayOfAnyPhotonBetween) {
  expect_seen([](Vec3d place, double size) {
    Mass hole = mass_at(place, 1e-6, physics_with(1e-4, 0.5));
    hole.horizon_radius = size;
    return space_of({}, {hole});
  });
}

TEST(BeamGuard, SeesAnInfluenceThatHidesBetween) {
  expect_seen([](Vec3d place, double size) {
    Mass light = mass_at(place, 1e-6, physics_with(1e-4, 0.5));
    light.horizon = false;
    light.influence = size;
    return space_of({}, {light});
  });
}

TEST(BeamGuard, SeesAPortalOnTheWayOfAnyPhotonBetween) {
  expect_seen([](Vec3d place, double size) {
    const auto square = [&](Vec3d middle) {
      return std::vector<Vec3d>{middle + Vec3d{-size, -size, 0}, middle + Vec3d{size, -size, 0},
                                middle + Vec3d{size, size, 0}, middle + Vec3d{-size, size, 0}};
    };
    return space_of({}, {}, portal_pair(square(place), square({0, 40, 0})));
  });
}

TEST(BeamGuard, SeesAPortalOfAnyCornersOnTheWayOfAnyPhotonBetween) {
  for (const int count : {3, 7})
    expect_seen([&](Vec3d place, double size) {
      const auto around = [&](Vec3d middle) {
        std::vector<Vec3d> corners;
        for (int i = 0; i < count; ++i) {
          const double angle = 2.0 * M_PI * i / count;
          corners.push_back(middle + Vec3d{std::cos(angle), std::sin(angle), 0} * size);
        }
        return corners;
      };
      return space_of({}, {}, portal_pair(around(place), around({0, 40, 0})));
    });
}

TEST(BeamGuard, SeesANotchOfThePortalThatAllFourEnter) {
  const PlannedSpace space = space_of();
  Random random(22);
  int tried = 0;
  for (int i = 0; i < scaled(400); ++i) {
    Random same = random;
    const Beam beam(space, random);
    const auto place = place_between(space, beam.between, random);
    if (!place) continue;
    // A plate with a slit that ends on the way of the photon between.
    const double large = 2.0 * cell * place->second, slit = 0.001 * large;
    const auto plate = [&](Vec3d middle) {
      std::vector<Vec3d> corners;
      for (const auto& [x, y] : {std::pair{-large, -large},
                                 {large, -large},
                                 {large, -slit},
                                 {-slit, 0.0},
                                 {large, slit},
                                 {large, large},
                                 {-large, large}})
        corners.push_back(middle + Vec3d{x, y, 0});
      return corners;
    };
    auto pair = portal_pair(plate(place->first), plate({0, 40, 0}));
    const PlannedSpace slit_space = space_of({}, {}, std::move(pair));
    const Beam entering(slit_space, same);
    const Arrival between = advance_one(slit_space, entering.between);
    if (!entering.agrees() || entering.arrivals[0].crossings == 0 ||
        between.crossings == entering.arrivals[0].crossings)
      continue;
    ++tried;
    EXPECT_FALSE(entering.clear(slit_space)) << "beam " << i;
  }
  EXPECT_GT(tried, scaled(400) / 10);
}

/// What the guard says of four ways through these places, a tenth aside of each other, that end on
/// the ground.
bool clear_to_ground(const std::vector<Vec3d>& places) {
  const PlannedSpace space = space_of();
  std::array<PathRecord, 4> records;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d aside{0, 0, 0.1 * static_cast<double>(i)};
    double way = 0.0;
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (k > 0) way += length(places[k] - places[k - 1]);
      records[i].pass(places[k] + aside, way, 0.0);
    }
  }
  Arrival ground;
  ground.fate = Fate::hit;
  ground.met = Met::surface;
  ground.object = 0;
  return BeamGuard::over(space)->clear({&records[0], &records[1], &records[2], &records[3]},
                                       ground);
}

TEST(BeamGuard, LetsLightSinkSlantwiseOntoAPlane) {
  // A step ends a beam's width above the ground, and several of them before it.
  EXPECT_TRUE(clear_to_ground({{10, 2.1, 8}, {18, 0.1, 8}, {18.4, 0.0, 8}}));
  EXPECT_TRUE(clear_to_ground({{10, 2.1, 8}, {17, 0.2, 8}, {18, 0.1, 8}, {18.8, 0.0, 8}}));
}

TEST(BeamGuard, SeesThatLightSkimsOverThePlaneItEndsOn) {
  EXPECT_FALSE(clear_to_ground({{10, 2.1, 8}, {18, 0.1, 8}, {19, 0.1, 8}, {19.4, 0.0, 8}}));
  EXPECT_FALSE(clear_to_ground({{10, 2.1, 8}, {18, 0.1, 8}, {18.6, 0.12, 8}, {19, 0.0, 8}}));
  EXPECT_FALSE(clear_to_ground({{10, 2.1, 8}, {18, 0.05, 8}, {20, 0.4, 8}, {22, 0.0, 8}}));
}

/// What the guard says of four straight paths, a hundredth aside of each other, that pass through
/// an influence of radius 5 and end there.
/// @param pull  of the mass at that radius, divided by what turns light by a radian a length
bool clear_through_influence(double end, double pull, Fate fate) {
  Physics physics = physics_with(1e-4, 0.5);
  Mass mass = mass_at({0, 0, 0}, pull * 25.0 * physics.c * physics.c, physics);
  mass.influence = 5.0;
  mass.horizon = false;
  const PlannedSpace space = space_with(physics, {mass}, {}, {});
  std::array<PathRecord, 4> records;
  for (std::size_t i = 0; i < 4; ++i)
    for (const double x : {-12.0, 0.0, end})
      records[i].pass({x, 3.0, 0.01 * static_cast<double>(i)}, x + 12.0, 0.0);
  Arrival arrival;
  arrival.fate = fate;
  return BeamGuard::over(space)->clear({&records[0], &records[1], &records[2], &records[3]},
                                       arrival);
}

TEST(BeamGuard, SeesThatLightEndsWhereAnInfluenceDoes) {
  for (const double end : {3.98, 4.0, 4.02})
    EXPECT_FALSE(clear_through_influence(end, 0.01, Fate::hit)) << end;
  for (const double end : {3.8, 4.2})
    EXPECT_TRUE(clear_through_influence(end, 0.01, Fate::hit)) << end;
  EXPECT_TRUE(clear_through_influence(4.0, 0.01, Fate::escaped)) << "it goes on";
}

TEST(BeamGuard, TakesNoNoticeOfABorderThatTurnsNoLight) {
  EXPECT_TRUE(clear_through_influence(4.0, 1e-4, Fate::hit));
}

TEST(BeamGuard, LetsMostBeamsThrough) {
  const PlannedSpace space = space_of();
  Random random(23);
  int agree = 0, clear = 0;
  for (int i = 0; i < scaled(2000); ++i) {
    const Beam beam(space, random);
    if (!beam.agrees()) continue;
    ++agree;
    if (beam.clear(space)) ++clear;
  }
  EXPECT_GT(clear, 0.7 * agree);
}

TEST(BeamGuard, IgnoresWhatLiesBesideTheBeam) {
  const PlannedSpace space = space_of();
  Random random(24);
  int clear = 0, still = 0;
  for (int i = 0; i < scaled(400); ++i) {
    const Beam beam(space, random);
    const auto place = place_between(space, beam.between, random);
    if (!place || !beam.agrees() || !beam.clear(space)) continue;
    ++clear;
    // Six cells aside, and half a cell large.
    const double across = cell * place->second;
    if (beam.clear(space_of({Sphere(place->first + Vec3d{0, 6 * across, 0}, 0.5 * across)})))
      ++still;
  }
  EXPECT_GT(clear, scaled(400) / 4);
  EXPECT_GT(still, 0.8 * clear) << "only where light is sheared may the beam be wider";
}

TEST(BeamGuard, IsNotThereWhereThereIsTooMuchToLookThrough) {
  std::vector<Shape> many(300, Shape(Sphere({0, 50, 0}, 0.1)));
  EXPECT_FALSE(BeamGuard::over(space_of(std::move(many))));
  EXPECT_TRUE(BeamGuard::over(space_of()));
}

}  // namespace
}  // namespace portalens::test
