/// \file
/// What the progress line shows.
#include "app/progress_bar.h"

#include <gtest/gtest.h>

namespace portalens {
namespace {

TEST(ProgressBar, ClockTimesHaveMinutesAndSeconds) {
  EXPECT_EQ(clock_text(0), "0:00");
  EXPECT_EQ(clock_text(6.2), "0:07");
  EXPECT_EQ(clock_text(61), "1:01");
  EXPECT_EQ(clock_text(3600 + 120 + 3), "1:02:03");
  EXPECT_EQ(clock_text(1e300), "1000000:00:00");
}

TEST(ProgressBar, CountsHaveThreeDigitsAndAUnit) {
  EXPECT_EQ(rounded_count(0), "0");
  EXPECT_EQ(rounded_count(950), "950");
  EXPECT_EQ(rounded_count(999.6), "1.00 k");
  EXPECT_EQ(rounded_count(1234), "1.23 k");
  EXPECT_EQ(rounded_count(56789), "56.8 k");
  EXPECT_EQ(rounded_count(123456), "123 k");
  EXPECT_EQ(rounded_count(4.56e6), "4.56 M");
  EXPECT_EQ(rounded_count(7e15), "7000 T");
}

TEST(ProgressBar, TheLineTellsShareRateAndTimeLeft) {
  EXPECT_EQ(progress_line(25, 100, 40000, 2.0),
            "[######..................]  25%  20.0 k photons/s  0:06 left");
  EXPECT_EQ(progress_line(100, 100, 10, 1.0).find("100%"), 27u);
  EXPECT_NE(progress_line(999, 1000, 10, 1.0).find(" 99%"), std::string::npos)
      << "all is not said before it is";
}

}  // namespace
}  // namespace portalens
