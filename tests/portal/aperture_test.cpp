// Laws that every aperture of the list keeps.
#include "portal/aperture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/faces.h"
#include "support/list_types.h"
#include "support/random.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

template <class Type>
class EachAperture : public testing::Test {
 protected:
  /// All of the faces that are of this kind.
  static std::vector<Type> samples() {
    std::vector<Type> found;
    for (const FaceInput& face : faces_of_all_kinds())
      if (auto aperture = Type::from(face)) found.push_back(*std::move(aperture));
    return found;
  }
};

TYPED_TEST_SUITE(EachAperture, TypesOf<Aperture>::type);

/// How much the outline of a curved aperture lies outside of it, as a share of its size.
constexpr double outline_share = 2e-4;

/// Whether a polygon goes round a point: by the sum of angles.
bool goes_round(const std::vector<Vec3d>& polygon, double x, double y) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d a = polygon[i] - Vec3d{x, y, 0},
                b = polygon[(i + 1) % polygon.size()] - Vec3d{x, y, 0};
    sum += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
  }
  return sum > 3.0;
}

/// Whether a point lies within the convex hull: no half-plane from it is free of them.
bool lies_between(const std::vector<Vec3d>& points, Vec3d x) {
  std::vector<double> angles;
  for (const Vec3d& point : points) angles.push_back(std::atan2(point.y - x.y, point.x - x.x));
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2.0 * M_PI - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    widest = std::max(widest, angles[i] - angles[i - 1]);
  return widest < M_PI;
}

Vec3d nearest_on_rim(const std::vector<Vec3d>& polygon, Vec3d x) {
  Vec3d best;
  double least = 1e300;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d a = polygon[i], edge = polygon[(i + 1) % polygon.size()] - a;
    const Vec3d y = a + edge * std::clamp(dot(x - a, edge) / dot(edge, edge), 0.0, 1.0);
    if (length(x - y) < least) least = length(x - y), best = y;
  }
  return best;
}

Vec3d flat_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), 0.0};
}

TYPED_TEST(EachAperture, HasSamples) { EXPECT_GE(this->samples().size(), 2u); }

TYPED_TEST(EachAperture, HoldsWhatItsOutlineGoesRound) {
  Random random(1);
  for (const TypeParam& aperture : this->samples()) {
    const std::vector<Vec3d> outline = aperture.outline();
    const double close = TypeParam::curved ? outline_share * aperture.size() : 1e-12;
    const PlaneBox box = box_of(outline);
    const double width = box.high_x - box.low_x, height = box.high_y - box.low_y;
    int inside = 0;
    for (int i = 0; i < scaled(2000); ++i) {
      const Vec3d x{box.low_x + random.uniform(-0.1, 1.1) * width,
                    box.low_y + random.uniform(-0.1, 1.1) * height, 0.0};
      if (length(x - nearest_on_rim(outline, x)) <= close) continue;
      const bool round = goes_round(outline, x.x, x.y);
      inside += round;
      ASSERT_EQ(aperture.covers(x.x, x.y), round) << x.x << ' ' << x.y;
      ASSERT_EQ(aperture.within(x.x, x.y, 0.0), round);
    }
    EXPECT_GT(inside, scaled(2000) / 20);
  }
}

TYPED_TEST(EachAperture, HoldsALittleMoreWithSlack) {
  Random random(2);
  for (const TypeParam& aperture : this->samples())
    for (int i = 0; i < scaled(500); ++i) {
      const Vec3d x = flat_point(random, 2.2);
      const Vec3d rim = aperture.place(aperture.nearest({x.x, x.y, -1.0}, 1e-9), x);
      if (aperture.covers(x.x, x.y)) continue;
      const Vec3d out = rim + normalize(x - rim) * 1e-6;
      EXPECT_FALSE(aperture.within(out.x, out.y, 1e-8));
      EXPECT_TRUE(aperture.within(out.x, out.y, 5e-6)) << x.x << ' ' << x.y;
      EXPECT_TRUE(aperture.within(rim.x, rim.y, 1e-12));
    }
}

TYPED_TEST(EachAperture, IsJustHeldByItsBox) {
  for (const TypeParam& aperture : this->samples()) {
    const PlaneBox box = aperture.box(), around = box_of(aperture.outline());
    const double close = TypeParam::curved ? outline_share * aperture.size() : 1e-15;
    EXPECT_NEAR(box.low_x, around.low_x, close);
    EXPECT_NEAR(box.low_y, around.low_y, close);
    EXPECT_NEAR(box.high_x, around.high_x, close);
    EXPECT_NEAR(box.high_y, around.high_y, close);
    EXPECT_LE(around.low_x, box.low_x + 1e-15);
    EXPECT_GE(around.high_y, box.high_y - 1e-15);
  }
}

TYPED_TEST(EachAperture, HasTheAreaOfItsOutlineAndOfItsPieces) {
  for (const TypeParam& aperture : this->samples()) {
    const double close = (TypeParam::curved ? 1e-3 : 1e-12) * aperture.area();
    EXPECT_NEAR(aperture.area(), area_of(aperture.outline()), close);
    double sum = 0.0;
    for (const std::vector<Vec3d>& piece : aperture.pieces()) {
      EXPECT_EQ(reentrant_corner(piece), piece.size());
      sum += area_of(piece);
    }
    EXPECT_NEAR(aperture.area(), sum, close);
  }
}

TYPED_TEST(EachAperture, LacksItsGapsToBeConvex) {
  Random random(4);
  for (const TypeParam& aperture : this->samples()) {
    const std::vector<Vec3d> outline = aperture.outline();
    for (int i = 0; i < scaled(1000); ++i) {
      const Vec3d x = flat_point(random, 2.2);
      if (length(x - nearest_on_rim(outline, x)) <= outline_share * aperture.size()) continue;
      int gaps = 0;
      for (const std::vector<Vec3d>& gap : aperture.gaps()) {
        EXPECT_EQ(gap.size(), 3u);
        gaps += goes_round(gap, x.x, x.y) || goes_round({gap[2], gap[1], gap[0]}, x.x, x.y);
      }
      const bool lacking = lies_between(outline, x) && !aperture.covers(x.x, x.y);
      ASSERT_EQ(gaps, lacking ? 1 : 0) << x.x << ' ' << x.y;
    }
  }
}

TYPED_TEST(EachAperture, NearestPlaceIsTheNearestOfBruteForce) {
  Random random(3);
  for (const TypeParam& aperture : this->samples()) {
    const std::vector<Vec3d> outline = aperture.outline();
    const double close = TypeParam::curved ? outline_share * aperture.size() : 1e-12;
    for (int i = 0; i < scaled(3000); ++i) {
      Vec3d x = flat_point(random, i % 10 == 0 ? 50.0 : 2.2);
      x.z = random.uniform(-1, 1);
      const Vec3d flat{x.x, x.y, 0.0};
      const Vec3d place = aperture.place(aperture.nearest(x, 1e-9), x);
      if (x.z >= 0.0 && aperture.covers(x.x, x.y)) {
        ASSERT_EQ(place, flat);
        continue;
      }
      ASSERT_NEAR(length(place - flat), length(nearest_on_rim(outline, flat) - flat), close)
          << x.x << ' ' << x.y;
      ASSERT_LT(length(place - nearest_on_rim(outline, place)), close);
    }
  }
}

/// Whether the nearest place goes steadily from one point to another: where it goes quickest, it
/// still does not jump.
template <class Type>
bool goes_steadily(const Type& aperture, Vec3d a, Vec3d b) {
  const auto place = [&](Vec3d x) { return aperture.place(aperture.nearest(x, 1e-9), x); };
  while (length(b - a) > 1e-9) {
    const Vec3d middle = (a + b) * 0.5, there = place(middle);
    const double first = length(place(a) - there), second = length(there - place(b));
    if (std::max(first, second) <= 4.0 * length(b - a) + 1e-9) return true;
    (first > second ? b : a) = middle;
  }
  return length(place(a) - place(b)) < 1e-3;
}

TYPED_TEST(EachAperture, NearestPlaceDoesNotJumpWhereItIsCalm) {
  Random random(4);
  for (const TypeParam& aperture : this->samples()) {
    double sum = 0.0;
    for (int i = 0; i < scaled(3000); ++i) {
      Vec3d x = flat_point(random, 2.2);
      x.z = random.uniform(-0.6, 0.6);
      const double distance_to_discontinuity = aperture.distance_to_discontinuity(x, 1e-9);
      ASSERT_GE(distance_to_discontinuity, 0.0);
      sum += std::min(distance_to_discontinuity, 1.0);
      const Vec3d y = x + random.direction() * (0.999 * std::min(distance_to_discontinuity, 3.0));
      ASSERT_TRUE(goes_steadily(aperture, x, y))
          << x.x << ' ' << x.y << ' ' << x.z << " calm " << distance_to_discontinuity;
    }
    EXPECT_GT(sum / scaled(3000), 0.02);
  }
}

TYPED_TEST(EachAperture, PlaceOfAFeatureIsSmoothAndStillWhereItSaysSo) {
  Random random(5);
  const double h = 1e-4;
  for (const TypeParam& aperture : this->samples())
    for (int i = 0; i < scaled(1000); ++i) {
      Vec3d x = flat_point(random, 2.2);
      x.z = random.uniform(-1, 1);
      const Feature feature = aperture.nearest(x, 1e-9);
      const Vec3d aside = random.direction(), here = aperture.place(feature, x);
      const auto place = [&](Vec3d y) { return aperture.place(aperture.follow(feature, y), y); };
      const Vec3d before = place(x - aside * h), after = place(x + aside * h);
      const double pace = aperture.pace(feature, x).speed;
      // Where it is quick it bends, too.
      if (pace < 10.0) {
        ASSERT_LE(length(after - here), 1.1 * pace * h + 1e-12);
        ASSERT_LT(length(before + after - here * 2.0), 1e-3 * h * std::pow(pace + 1.0, 3));
      }
      const double still =
          std::min(aperture.still(feature, x), aperture.distance_to_discontinuity(x, 1e-9));
      if (still > 0.0) {
        ASSERT_EQ(aperture.place(aperture.nearest(x + aside * (0.99 * still), 1e-9), x), here);
      }
    }
}

TYPED_TEST(EachAperture, FitsItsPairTurnedAboutUpAndNoOther) {
  Random random(6);
  for (const FaceInput& face : faces_of_all_kinds()) {
    const auto a = TypeParam::from(face);
    if (!a) continue;
    const Vec3d normal = random.direction(), right = any_perpendicular(normal);
    const Frame there{random.point(10.0), right, cross(normal, right), normal};
    FaceInput pair = partner_in(face, there);
    EXPECT_LT(a->mismatch(*TypeParam::from(pair)), 1e-13);
    for (Vec3d& vertex : pair.vertices) vertex = there.origin + (vertex - there.origin) * 1.001;
    for (double& radius : pair.radii) radius *= 1.001;
    EXPECT_GT(a->mismatch(*TypeParam::from(pair)), 1e-5);
  }
}

TYPED_TEST(EachAperture, IsTheSameFromBehindWhenItIsTurnedOver) {
  Random random(7);
  for (const FaceInput& face : faces_of_all_kinds()) {
    if (!TypeParam::from(face)) continue;
    Portal portal;
    give_face(portal, face);
    portal.two_sided = true;
    std::vector<Portal> pair(2, portal);
    pair[0].pair = 1, pair[1].pair = 0;
    const Portal back = one_sided(pair)[2];
    for (int i = 0; i < scaled(500); ++i) {
      const Vec3d x = portal.frame.to_world(flat_point(random, 2.2));
      const Vec3d front = portal.frame.to_local(x), behind = back.frame.to_local(x);
      EXPECT_EQ(within(portal.aperture, front.x, front.y, 0.0),
                within(back.aperture, behind.x, behind.y, 0.0));
    }
  }
}

TEST(Ellipse, NearestPlaceOfTheRimIsStationaryAndNoOtherIsNearer) {
  Random random(8);
  for (const double b : {1.2, 1.1999, 0.8, 0.05, 3.0}) {
    const double a = 1.2;
    const Ellipse ellipse(a, b);
    for (int i = 0; i < scaled(3000); ++i) {
      const Vec3d x{random.uniform(-2, 2), random.uniform(-2, 2) * (i % 2 ? b : 1e-9), -1.0};
      const Feature feature = ellipse.nearest(x, 0.0);
      const Vec3d place = ellipse.place(feature, x), apart{x.x - place.x, x.y - place.y, 0};
      const Vec3d tangent{-a * feature.sine, b * feature.cosine, 0};
      ASSERT_LT(std::fabs(dot(apart, tangent)), 1e-9 * (1.0 + length(apart))) << x.x << ' ' << x.y;
      for (int k = 0; k < 50; ++k) {
        const double angle = random.uniform(0, 2 * std::numbers::pi);
        const Vec3d other{a * std::cos(angle) - x.x, b * std::sin(angle) - x.y, 0};
        ASSERT_GE(length(other), length(apart) - 1e-12);
      }
    }
  }
}

TEST(Ellipse, NearestPlaceSwingsRoundAtTheCentreOfCurvature) {
  Random random(9);
  for (const double b : {1.2, 0.8, 0.05, 3.0}) {
    const double a = 1.2, apart = a * a - b * b;
    const Ellipse ellipse(a, b);
    for (int i = 0; i < scaled(3000); ++i) {
      const Vec3d x{random.uniform(-2, 2), random.uniform(-2, 2) * b, -1.0};
      const Feature feature = ellipse.nearest(x, 0.0);
      const Vec3d center{apart / a * std::pow(feature.cosine, 3),
                         -apart / b * std::pow(feature.sine, 3), x.z};
      ASSERT_NEAR(ellipse.pace(feature, x).pivot, length(x - center), 1e-6) << x.x << ' ' << x.y;
    }
    EXPECT_TRUE(std::isinf(ellipse.pace(ellipse.nearest({0, 0, 1}, 0.0), {0, 0, 1}).pivot));
  }
}

TEST(ConcavePolygon, IsRefusedWhereEdgesMeet) {
  const auto meets = [](std::vector<Vec3d> corners) {
    return edges_that_meet(corners).has_value();
  };
  EXPECT_FALSE(meets(letter_l()));
  EXPECT_FALSE(meets(comb()));
  EXPECT_FALSE(meets(star(1.0, 0.3)));
  EXPECT_TRUE(meets({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2.5, 0}}));           // crosses
  EXPECT_TRUE(meets({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 0, 0}, {0, 2, 0}}));  // touches
  EXPECT_TRUE(meets({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {4, 1, 0}, {0, 3, 0}}));  // goes back
  EXPECT_TRUE(meets({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 1, 0}, {2, -1, 0}, {0, 3, 0}}));
}

}  // namespace
}  // namespace portalens::test
