#include "math/black_body.h"

#include <gtest/gtest.h>

namespace portalens {
namespace {

/// CIE's chromaticities of Planck's law at those temperatures, as linear sRGB of luminance 1.
TEST(BlackBody, HasTheColourThatCieGives) {
  struct Known {
    double temperature, x, y;
  };
  for (const auto& [temperature, x, y] : {Known{2856, 0.4476, 0.4074},
                                          {4000, 0.3805, 0.3768},
                                          {6504, 0.3135, 0.3236},
                                          {10000, 0.2807, 0.2884}}) {
    const double X = x / y, Z = (1 - x - y) / y;
    const Rgb found = black_body_color(temperature);
    EXPECT_NEAR(found.x, 3.2406 * X - 1.5372 - 0.4986 * Z, 0.025) << temperature;
    EXPECT_NEAR(found.y, -0.9689 * X + 1.8758 + 0.0415 * Z, 0.025) << temperature;
    EXPECT_NEAR(found.z, 0.0557 * X - 0.2040 + 1.0570 * Z, 0.025) << temperature;
  }
}

TEST(BlackBody, IsFiniteAndNeverNegative) {
  for (double temperature = 500; temperature <= 1e6; temperature *= 1.3) {
    const Rgb color = black_body_color(temperature);
    EXPECT_TRUE(is_finite(color)) << temperature;
    EXPECT_GE(std::min({color.x, color.y, color.z}), 0.0) << temperature;
    EXPECT_NEAR(0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z, 1.0,
                temperature < 1900 ? 0.2 : 1e-3);
  }
}

}  // namespace
}  // namespace portalens
