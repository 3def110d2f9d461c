#include "shading/texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"

namespace portalens {
namespace {

SurfacePoint flat_point(double along, double across) {
  SurfacePoint point;
  point.flat = true;
  point.along = along;
  point.across = across;
  point.u = 0.1;
  point.v = 0.1;
  return point;
}

SurfacePoint curved_point(double u, double v) {
  SurfacePoint point;
  point.u = u;
  point.v = v;
  return point;
}

std::shared_ptr<const Image> two_by_two() {
  auto image = std::make_shared<Image>(2, 2, 3);
  const float values[4] = {1, 2, 3, 4};  // top left, top right, bottom left, bottom right
  for (int i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) image->at(i % 2, i / 2)[c] = values[i];
  return image;
}

const Checker checker{{1, 0, 0}, {0, 1, 0}, 0.5};

TEST(Checker, FlatFacesGoByLengthsFromTheFirstVertex) {
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double a = random.uniform(-5, 5), b = random.uniform(-5, 5);
    const auto cell = static_cast<long>(std::floor(a / 0.5) + std::floor(b / 0.5));
    EXPECT_EQ(checker.at(flat_point(a, b)), cell % 2 == 0 ? checker.first : checker.second);
  }
}

TEST(Checker, CurvedSurfacesGoByTheirCoordinates) {
  EXPECT_EQ(checker.at(curved_point(0.1, 0.1)), checker.first);
  EXPECT_EQ(checker.at(curved_point(0.6, 0.1)), checker.second);
  EXPECT_EQ(checker.at(curved_point(0.6, 0.6)), checker.first);
}

TEST(Checker, StaysACheckerFarFromTheFirstVertex) {
  EXPECT_NE(checker.at(flat_point(1e12, 0.1)), checker.at(flat_point(1e12 + 0.5, 0.1)));
  EXPECT_TRUE(is_finite(checker.at(flat_point(1e300, -1e300))));
}

TEST(Picture, HasItsBottomRowAtVZero) {
  const Picture picture{two_by_two()};
  EXPECT_DOUBLE_EQ(picture.at(curved_point(0.25, 0.25)).x, 3);
  EXPECT_DOUBLE_EQ(picture.at(curved_point(0.75, 0.25)).x, 4);
  EXPECT_DOUBLE_EQ(picture.at(curved_point(0.25, 0.75)).x, 1);
  EXPECT_DOUBLE_EQ(picture.at(curved_point(0.75, 0.75)).x, 2);
}

TEST(Picture, IsLinearBetweenPixelCentres) {
  const Picture picture{two_by_two()};
  EXPECT_DOUBLE_EQ(picture.at(curved_point(0.5, 0.25)).x, 3.5);
  EXPECT_DOUBLE_EQ(picture.at(curved_point(0.25, 0.5)).x, 2);
  EXPECT_DOUBLE_EQ(picture.at(curved_point(0.5, 0.5)).x, 2.5);
}

TEST(Picture, RepeatsInBothDirections) {
  const Picture picture{two_by_two()};
  test::Random random(2);
  for (int i = 0; i < 200; ++i) {
    const double u = random.uniform(0, 1), v = random.uniform(0, 1);
    const Rgb here = picture.at(curved_point(u, v));
    EXPECT_NEAR(picture.at(curved_point(u + 3, v)).x, here.x, 1e-12);
    EXPECT_NEAR(picture.at(curved_point(u, v - 2)).x, here.x, 1e-12);
  }
  // At the seam the last column runs into the first one.
  EXPECT_NEAR(picture.at(curved_point(0.0, 0.25)).x, 3.5, 1e-12);
}

Picture placed(const Placement& placement) {
  Picture picture{two_by_two()};
  picture.placement = placement;
  return picture;
}

TEST(Picture, OfASizeLiesInLengthsOnFlatFaces) {
  Placement at;
  at.size = {4.0, 2.0};
  at.offset = {1.0, -1.0};
  const Picture picture = placed(at), plain{two_by_two()};
  EXPECT_FALSE(picture.uses_coordinates());
  test::Random random(4);
  for (int i = 0; i < 200; ++i) {
    const double u = random.uniform(-3, 3), v = random.uniform(-3, 3);
    const Rgb expected = plain.at(curved_point(u, v));
    EXPECT_NEAR(picture.at(flat_point(1 + 4 * u, -1 + 2 * v)).x, expected.x, 1e-9);
    EXPECT_NEAR(picture.at(curved_point(1 + 4 * u, -1 + 2 * v)).x, expected.x, 1e-9);
  }
}

TEST(Picture, WithoutASizeLiesInItsCoordinates) {
  Placement at;
  at.offset = {0.25, 0.0};
  EXPECT_TRUE(placed(at).uses_coordinates());
  EXPECT_DOUBLE_EQ(placed(at).at(curved_point(0.5, 0.25)).x, 3);
  EXPECT_DOUBLE_EQ(placed(at).at(flat_point(7, 8)).x,
                   (Picture{two_by_two()}.at(curved_point(0.1 - 0.25, 0.1)).x));
}

/// By a right angle to the left: its bottom edge goes up.
TEST(Picture, TurnsToTheLeft) {
  Placement at;
  at.size = {2.0, 2.0};
  at.cosine = 0.0, at.sine = 1.0;
  EXPECT_NEAR(placed(at).at(flat_point(-0.5, 0.5)).x, 3, 1e-12);  // lower left
  EXPECT_NEAR(placed(at).at(flat_point(-0.5, 1.5)).x, 4, 1e-12);  // lower right
  EXPECT_NEAR(placed(at).at(flat_point(-1.5, 0.5)).x, 1, 1e-12);  // upper left
}

TEST(Picture, GoesOnAsItsWrapSays) {
  Placement at;
  at.wrap = Wrap::clamp;
  EXPECT_DOUBLE_EQ(placed(at).at(curved_point(0.0, 0.0)).x, 3);
  EXPECT_DOUBLE_EQ(placed(at).at(curved_point(-5, 0.25)).x, 3);
  EXPECT_DOUBLE_EQ(placed(at).at(curved_point(9, 0.25)).x, 4);
  EXPECT_DOUBLE_EQ(placed(at).at(curved_point(0.25, 9)).x, 1);
  at.wrap = Wrap::mirror;
  test::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const double u = random.uniform(0.25, 0.75), v = random.uniform(0.25, 0.75);
    const double here = placed(at).at(curved_point(u, v)).x;
    for (const double other : {-u, 2 - u, 2 + u, u - 4})
      EXPECT_NEAR(placed(at).at(curved_point(other, v)).x, here, 1e-9);
    EXPECT_NEAR(placed(at).at(curved_point(u, -v)).x, here, 1e-9);
  }
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
    at.wrap = wrap;
    for (const double far : {1e300, -1e300, std::nan("")})
      EXPECT_TRUE(is_finite(placed(at).at(curved_point(far, 0.3))));
  }
}

TEST(Texture, ItsBrightestIsNowhereSurpassed) {
  const Texture texture = Picture{two_by_two()};
  test::Random random(3);
  for (int i = 0; i < 200; ++i) {
    const SurfacePoint point = curved_point(random.uniform(0, 1), random.uniform(0, 1));
    EXPECT_LE(color_at(texture, point).x, brightest(texture).x);
  }
}

TEST(Texture, TheBrightestOfASumIsWhereTheSumIs) {
  const Checker other{{0, 0.5, 0}, {0.25, 0, 0}, 0.5}, finer{{0, 0.5, 0}, {0.25, 0, 0}, 0.25};
  EXPECT_EQ(brightest_sum(checker, other), (Rgb{1, 1, 0}));
  EXPECT_EQ(brightest_sum(checker, finer), (Rgb{1.25, 1.5, 0}));
  EXPECT_EQ(brightest_sum(checker, Constant{{0.5, 0, 0}}), (Rgb{1.5, 1, 0}));
  auto dark = std::make_shared<Image>(2, 2, 3);
  for (int c = 0; c < 3; ++c) dark->at(0, 0)[c] = 3.5f;
  EXPECT_EQ(brightest_sum(Picture{two_by_two()}, Picture{dark}).x, 4.5);
}

}  // namespace
}  // namespace portalens
