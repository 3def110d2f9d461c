// Crossing the influence of one mass by table, against its closed forms: equations.md, sec. 3.
#include "gravity/crossing_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/closed_forms.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

class CrossingOfShare : public testing::TestWithParam<double> {};

/// Offsets from just outside capture to the rim, closest near capture.
double passing_offset(const CrossingTable& table, double share) {
  const double capture = table.range().capture;
  return capture + (1.0 - capture) * std::pow(share, 4);
}

TEST_P(CrossingOfShare, IsTurnedByTheClosedForm) {
  const CrossingTable table(GetParam());
  for (int i = 1; i < 60; ++i) {
    const double b = passing_offset(table, i / 60.0);
    EXPECT_NEAR(exact_crossing(GetParam(), b).turning,
                closed_form::total_turning(GetParam(), 1.0, b), 1e-11)
        << "b/R = " << b;
  }
}

TEST_P(CrossingOfShare, ByTableIsWithinItsStatedBound) {
  const CrossingTable table(GetParam());
  const auto compare = [&](double b) {
    const Crossing found = table.at(b), exact = exact_crossing(GetParam(), b);
    ASSERT_NEAR(found.turning, exact.turning, table.angle_error()) << "b/R = " << b;
    ASSERT_NEAR(2.0 * std::atan(found.half_tangent), exact.turning, table.angle_error())
        << "b/R = " << b;
    ASSERT_NEAR(found.length, exact.length, table.length_error()) << "b/R = " << b;
  };
  const int count = scaled(20000);
  const double capture = table.range().capture;
  for (int i = 1; i < count; ++i) {
    const double share = static_cast<double>(i) / count;
    compare(passing_offset(table, share));
    compare(capture * share);
    compare(capture * (1.0 - std::pow(share, 6)));
  }
  for (const double off : {1e-14, 1e-9, 1e-6}) {
    compare(capture * (1.0 + off));
    compare(capture * (1.0 - off));
    compare(1.0 - off);
    compare(off);
  }
}

TEST_P(CrossingOfShare, HasABoundWellBelowAHundredThousandthOfARadian) {
  const CrossingTable table(GetParam());
  EXPECT_LT(table.angle_error(), 6e-7);
  EXPECT_LT(table.length_error(), 1e-6);
}

TEST_P(CrossingOfShare, ThatIsJustCapturedHasTurnedByHalfOfWhatTheNextOneTurns) {
  const double capture = CrossingTable(GetParam()).range().capture;
  const Crossing falls = exact_crossing(GetParam(), capture * (1.0 - 1e-14));
  const Crossing passes = exact_crossing(GetParam(), capture * (1.0 + 1e-14));
  EXPECT_NEAR(passes.turning, 2.0 * falls.turning, 1e-5);
  EXPECT_NEAR(passes.length, 2.0 * falls.length, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(SharesOfTheRadius, CrossingOfShare,
                         testing::Values(1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1.0 / 452.8, 0.01, 0.03, 0.1,
                                         0.2, 0.3, 0.4));

TEST(CrossingTable, IsSmall) {
  EXPECT_LE(CrossingTable(0.01).cells().size() * sizeof(float), 8192u);
}

TEST(CrossingTable, AWayThroughTheMiddleIsNotTurned) {
  const CrossingTable table(0.02);
  EXPECT_EQ(table.at(0.0).turning, 0.0);
  EXPECT_NEAR(table.at(0.0).length, 1.0 - 0.04, table.length_error());
}

}  // namespace
}  // namespace portalens::test
