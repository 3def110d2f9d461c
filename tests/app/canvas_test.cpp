/// \file
/// Marks become pixels and SVG: what they cover, and what of a text is written.
#include "app/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/drawing_svg.h"

namespace portalens {
namespace {

TEST(Canvas, LinesCoverTheirLengthTimesTheirWidth) {
  const Color black{0, 0, 0};
  for (const auto& [a, b] : {std::pair(Point{20, 20.5}, Point{80, 20.5}),
                             {Point{20.3, 10.1}, Point{71, 62}},
                             {Point{40, 80}, Point{45, 10}}}) {
    const Drawing drawing{100, 100, {1, 1, 1}, {Lines{{{a, b}}, {black, 3.0}, ""}}};
    const Image image = rasterized(drawing);
    double ink = 0.0;
    for (const float value : image.pixels) ink += (1.0 - value) / 3.0;
    const double area = 3.0 * std::hypot(b.x - a.x, b.y - a.y) + 2.25 * 3.14159;
    EXPECT_NEAR(ink, area, 0.02 * area);
  }
}

TEST(Canvas, DiscsAndAreasCoverWhatTheyShould) {
  const Color black{0, 0, 0};
  const auto ink = [](const Mark& mark) {
    double sum = 0.0;
    for (const float value : rasterized({80, 60, {1, 1, 1}, {mark}}).pixels)
      sum += (1.0 - value) / 3.0;
    return sum;
  };
  EXPECT_NEAR(ink(Disc{{30.2, 29.7}, 10.0, black, {}, ""}), 314.2, 3.0);
  EXPECT_NEAR(ink(Area{{{10, 10}, {50, 10}, {50, 40}, {10, 40}}, black, ""}), 1200.0, 1e-3);
  EXPECT_NEAR(ink(Area{{{10, 10}, {50, 30}, {10, 50}}, black, ""}), 800.0, 8.0);
  EXPECT_NEAR(ink(Area{{{-90, -90}, {500, -90}, {500, 500}, {-90, 500}}, black, ""}), 4800.0, 1e-2)
      << "what lies outside is cut off";
  EXPECT_NEAR(ink(Area{{{10, 10}, {50, 10}, {50, 40}, {10, 40}}, black.with_alpha(0.25), ""}),
              300.0, 1e-3);
}

TEST(Canvas, EveryCharacterOfAsciiHasAShapeOfItsOwn) {
  std::vector<std::vector<float>> seen;
  for (char c = '!'; c <= '~'; ++c)
    seen.push_back(
        rasterized({40, 40, {1, 1, 1}, {Label{{10, 30}, std::string(1, c), 20, {0, 0, 0}, {}, ""}}})
            .pixels);
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

TEST(Svg, TextThatXmlCantHoldIsReplaced) {
  const std::string svg = svg_text(
      {10, 10, {1, 1, 1}, {Label{{0, 0}, "a<b&c\x01\xff\xc3\xa9\xed\xa0\x80", 9, {}, {}, ""}}});
  EXPECT_NE(svg.find("a&lt;b&amp;c\ufffd\ufffdé\ufffd\ufffd\ufffd<"), std::string::npos) << svg;
}

}  // namespace
}  // namespace portalens
