// Radiance pictures, as their own format has them: every orientation, coding, kind of colours and
// exposure, byte by byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/image.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/temporary_folder.h"

namespace portalens::test {
namespace {

using Bytes = std::string;

const Bytes rgb_header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

class Radiance : public ::testing::Test {
 protected:
  std::optional<Image> read(const Bytes& bytes) {
    Faults faults;
    auto image = read_image(folder_.write("a.hdr", bytes), {}, faults);
    EXPECT_EQ(image.has_value(), faults.empty());
    told_.clear();
    try {
      faults.raise();
    } catch (const SceneError& error) {
      told_ = error.what();
    }
    return image;
  }
  /// Of each pixel the first value.
  std::vector<float> reds(const Bytes& bytes) {
    std::vector<float> values;
    const auto image = read(bytes);
    EXPECT_TRUE(image) << told_;
    if (image)
      for (std::size_t i = 0; i < image->pixels.size(); i += 3) values.push_back(image->pixels[i]);
    return values;
  }
  void expect_refused(const Bytes& bytes, const char* words) {
    EXPECT_FALSE(read(bytes));
    EXPECT_NE(told_.find(words), std::string::npos) << told_;
  }

  TemporaryFolder folder_;
  std::string told_;
};

/// Gray, of mantissa/256.
Bytes pixel(int mantissa) { return Bytes(3, static_cast<char>(mantissa)) + '\x80'; }
Bytes repeat(int count) { return {1, 1, 1, static_cast<char>(count)}; }

TEST_F(Radiance, EachOfTheEightOrientationsGivesTheSamePicture) {
  constexpr int width = 3, height = 2;
  std::vector<float> expected;
  for (int i = 0; i < width * height; ++i) expected.push_back(static_cast<float>(1 + i) / 256);
  for (const bool by_columns : {false, true})
    for (const bool right_to_left : {false, true})
      for (const bool bottom_up : {false, true}) {
        const std::string across = std::string(right_to_left ? "-X " : "+X ") + "3";
        const std::string down = std::string(bottom_up ? "+Y " : "-Y ") + "2";
        const std::string size = by_columns ? across + ' ' + down : down + ' ' + across;
        Bytes bytes = rgb_header + '\n' + size + '\n';
        for (int line = 0; line < (by_columns ? width : height); ++line)
          for (int along = 0; along < (by_columns ? height : width); ++along) {
            int x = by_columns ? line : along, y = by_columns ? along : line;
            if (right_to_left) x = width - 1 - x;
            if (bottom_up) y = height - 1 - y;
            const Bytes mantissa = {static_cast<char>(1 + y * width + x), 2, 2};
            bytes += mantissa + '\x80';
          }
        const auto image = read(bytes);
        ASSERT_TRUE(image) << size << told_;
        EXPECT_EQ(image->width, width) << size;
        EXPECT_EQ(image->height, height) << size;
        EXPECT_EQ(reds(bytes), expected) << size;
      }
}

TEST_F(Radiance, AllCodingsGiveTheSamePixels) {
  // 300 pixels: 200 and 50 equal ones, then 50 of which none is like its neighbour.
  std::vector<int> line(200, 128);
  line.insert(line.end(), 50, 192);
  for (int i = 0; i < 50; ++i) line.push_back(128 + i);
  Bytes flat, first, second{2, 2, 1, 44};
  std::vector<float> expected;
  for (const int mantissa : line) flat += pixel(mantissa);
  for (const int mantissa : line) expected.push_back(static_cast<float>(mantissa) / 256);
  first = pixel(128) + repeat(199) + pixel(192) + repeat(49) + flat.substr(std::size_t{4} * 250);
  for (int component = 0; component < 4; ++component) {
    const bool exponent = component == 3;
    const auto run = [&](int count, int value) {
      second += static_cast<char>(128 + count);
      second += static_cast<char>(exponent ? 128 : value);
    };
    run(127, 128);
    run(73, 128);
    run(50, 192);
    second += '\x32';
    for (int i = 0; i < 50; ++i) second += static_cast<char>(exponent ? 128 : 128 + i);
  }
  const Bytes header = rgb_header + "\n-Y 1 +X 300\n";
  EXPECT_EQ(reds(header + flat), expected);
  EXPECT_EQ(reds(header + first), expected);
  EXPECT_EQ(reds(header + second), expected);
  // Each line says for itself how it is coded, a column too.
  std::vector<float> thrice;
  for (int i = 0; i < 3; ++i) thrice.insert(thrice.end(), expected.begin(), expected.end());
  EXPECT_EQ(reds(rgb_header + "\n-Y 3 +X 300\n" + second + flat + first), thrice);
  EXPECT_EQ(reds(rgb_header + "\n+X 1 -Y 300\n" + second), expected);
}

TEST_F(Radiance, RunsOfTheFirstCodingGrowByEightBitsEach) {
  const Bytes header = rgb_header + "\n-Y 1 +X 16384\n";
  std::vector<float> expected(16384, 0.5F);
  EXPECT_EQ(reds(header + pixel(128) + repeat(255) + repeat(63)), expected);
  expected.back() = 0.25F;
  EXPECT_EQ(reds(header + pixel(128) + repeat(254) + repeat(63) + pixel(64)), expected);
  // A pixel between two runs ends the first number.
  expected.assign(16384, 0.25F);
  std::fill_n(expected.begin(), 3, 0.5F);
  EXPECT_EQ(reds(header + pixel(128) + repeat(2) + pixel(64) + repeat(252) + repeat(63)), expected);
  expect_refused(header + pixel(128) + repeat(0) + repeat(0) + repeat(1), "longer than its line");
  expect_refused(header + pixel(128) + repeat(0) + repeat(0) + repeat(0) + repeat(0) + repeat(0),
                 "cut off");
}

TEST_F(Radiance, ExposuresAndColorCorrectionsAreDividedOut) {
  const Bytes end = "\n-Y 1 +X 1\n" + pixel(128);
  EXPECT_EQ(reds(rgb_header + end).at(0), 0.5F);
  EXPECT_EQ(reds(rgb_header + "EXPOSURE= 4\n" + end).at(0), 0.125F);
  EXPECT_EQ(reds(rgb_header + "EXPOSURE=4.0e+00\nEXPOSURE=0.5\n" + end).at(0), 0.25F);
  EXPECT_EQ(reds(rgb_header + "\tEXPOSURE=4\n" + end).at(0), 0.5F);  // of a picture before this one
  const auto image = read(rgb_header + "COLORCORR=2 1 0.5\nEXPOSURE=2\nCOLORCORR=1 4 1\n" + end);
  ASSERT_TRUE(image) << told_;
  EXPECT_EQ(image->pixels, (std::vector<float>{0.125F, 0.0625F, 0.5F}));
  for (const char* line : {"EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=", "EXPOSURE=much",
                           "EXPOSURE=nan", "COLORCORR=1 1", "COLORCORR=1 0 1"})
    expect_refused(rgb_header + line + "\n" + end, line);
  expect_refused(rgb_header + "EXPOSURE=1e-200\nEXPOSURE=1e-200\n" + end, "beyond all bounds");
  expect_refused(rgb_header + "EXPOSURE=1e-200\n" + end, "not finite");
}

TEST_F(Radiance, XyzBecomesTheRgbOfRec709) {
  const Bytes header = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n";
  struct Known {
    std::array<double, 3> xyz, rgb;
  };
  // The primaries and the white of IEC 61966-2-1, halved.
  const Known known[] = {{{0.2062, 0.1063, 0.0097}, {0.5, 0.0, 0.0}},
                         {{0.1788, 0.3576, 0.0596}, {0.0, 0.5, 0.0}},
                         {{0.0902, 0.0361, 0.4752}, {0.0, 0.0, 0.5}},
                         {{0.4752, 0.5000, 0.5445}, {0.5, 0.5, 0.5}}};
  for (const Known& one : known)
    for (const double exposure : {1.0, 0.25}) {
      Bytes bytes = header + "EXPOSURE=" + std::to_string(exposure) + "\n\n-Y 1 +X 1\n";
      for (const double value : one.xyz) bytes += static_cast<char>(std::lround(256.0 * value));
      const auto image = read(bytes + '\x80');
      ASSERT_TRUE(image) << told_;
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(image->pixels[c] * exposure, one.rgb[c], 5.1 * 0.5 / 256.0) << c;
    }
}

TEST_F(Radiance, WhatCannotBeReadIsToldByItsReason) {
  const Bytes size = "\n-Y 1 +X 4\n", some = pixel(128);
  expect_refused("#?RADIANCE\n" + size + some, "no header line FORMAT");
  expect_refused("#?RADIANCE\nFORMAT=ascii\n" + size + some, "'FORMAT=ascii'");
  expect_refused(rgb_header, "header is cut off");
  expect_refused(rgb_header + "\n-Y 1 +X 4", "header is cut off");
  for (const char* line : {"", "-Y 1", "-Y 1 X 4", "-Y 1 +Z 4", "-Y one +X 4", "Y1 X4"})
    expect_refused(rgb_header + "\n" + line + "\n" + some, "tells no size");
  for (const char* line : {"-Y 1 +Y 4", "-Y 0 +X 4", "-Y 1 +X -4"})
    expect_refused(rgb_header + "\n" + line + "\n" + some, "no flat picture");
  expect_refused(rgb_header + size + some, "pixels are cut off");
  expect_refused(rgb_header + size + repeat(4), "no pixel before it");
  expect_refused(rgb_header + size + some + repeat(4), "longer than its line");
  expect_refused(rgb_header + "\n-Y 1 +X 9\n" + Bytes{2, 2, 0, 8}, "another length");
  expect_refused(rgb_header + "\n-Y 1 +X 9\n" + Bytes{2, 2, 0, 9, '\x8a', 1}, "longer than its");
}

TEST_F(Radiance, ItClaimsNoMoreThanItsBytesCanHold) {
  expect_refused(rgb_header + "\n-Y 16384 +X 8192\n" + pixel(128), "can hold");
  expect_refused(rgb_header + "\n+X 8192 +Y 16384\n" + pixel(128), "can hold");
  expect_refused(rgb_header + "\n+X 16385 +Y 1\n" + pixel(128), "16384");
}

TEST_F(Radiance, DamageNeverCrashesTheReader) {
  Random random(5);
  const Bytes whole = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\nEXPOSURE=2\n\n+X 2 -Y 9\n" + pixel(128) +
                      repeat(8) + Bytes{2, 2, 0, 9} +
                      "\x89\x01\x89\x02\x89\x03\x09"
                      "abcdefghi";
  ASSERT_TRUE(read(whole)) << told_;
  for (int trial = 0; trial < scaled(1000); ++trial) {
    Bytes damaged = whole;
    for (int i = 0; i < 1 + trial % 3; ++i)
      damaged[random.bits() % damaged.size()] = static_cast<char>(random.bits());
    if (trial % 4 == 0) damaged.resize(random.bits() % damaged.size());
    static_cast<void>(read(damaged));
  }
}

TEST_F(Radiance, ItsChannelsAreItsColors) {
  Faults faults;
  const auto file = folder_.write("a.hdr", rgb_header + "\n-Y 1 +X 2\n" + pixel(128) + pixel(64));
  const auto picture = read_channels(file, {}, faults);
  ASSERT_TRUE(picture);
  ASSERT_EQ(picture->channels.size(), 3u);
  EXPECT_EQ(picture->channels[2].name, "B");
  EXPECT_EQ(picture->channels[2].values, (std::vector<float>{0.5F, 0.25F}));
}

}  // namespace
}  // namespace portalens::test
