/// \file
/// Camera samples are where a (0,2)-net has them, and depend on nothing but their place.
#include "render/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace portalens {
namespace {

TEST(Sampler, EveryElementaryBoxOfAPowerOfTwoHoldsOneSample) {
  for (const std::uint64_t seed : {0u, 1u, 77u})
    for (std::uint32_t pixel = 0; pixel < 20; ++pixel) {
      const PixelSampler sampler(pixel * 7, pixel, seed);
      for (int k = 0; k <= 8; ++k) {
        const std::uint32_t count = 1u << k;
        for (const std::uint32_t begin : {0u, count, 5 * count})
          for (int across = 0; across <= k; ++across) {
            std::set<std::pair<int, int>> boxes;
            for (std::uint32_t i = 0; i < count; ++i) {
              const auto [u, v] = sampler.position(begin + i);
              boxes.insert({static_cast<int>(std::ldexp(u, across)),
                            static_cast<int>(std::ldexp(v, k - across))});
            }
            ASSERT_EQ(boxes.size(), count) << "pixel " << pixel << ", 2^" << k;
          }
      }
    }
}

TEST(Sampler, PositionsLieInTheUnitSquare) {
  const PixelSampler sampler(3, 5, 9);
  for (std::uint32_t i = 0; i < 10000; ++i) {
    const auto [u, v] = sampler.position(i);
    ASSERT_TRUE(u >= 0.0 && u < 1.0 && v >= 0.0 && v < 1.0);
  }
}

/// Correlation of what neighbouring pixels draw, over many pixels: 0 within 5 standard errors.
TEST(Sampler, NeighbouringPixelsAreNotCorrelated) {
  for (const int dimension : {0, 1})
    for (const std::uint32_t sample : {0u, 3u}) {
      double sum = 0.0;
      const int size = 100;
      for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x < size; ++x) {
          const double a = PixelSampler(x, y, 0).position(sample)[dimension] - 0.5;
          const double b = PixelSampler(x + 1, y, 0).position(sample)[dimension] - 0.5;
          sum += 12.0 * a * b;
        }
      EXPECT_LT(std::fabs(sum / (size * size)), 5.0 / size);
    }
}

/// The mean over pixels of each sample is that of the uniform distribution: none is biased.
TEST(Sampler, EverySampleIsUniformOverPixels) {
  for (std::uint32_t sample = 0; sample < 8; ++sample)
    for (const int dimension : {0, 1}) {
      std::vector<int> cells(16);
      const int size = 64;
      for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x < size; ++x)
          ++cells[static_cast<int>(16 * PixelSampler(x, y, 4).position(sample)[dimension])];
      double chi2 = 0.0;
      for (const int count : cells) chi2 += (count - 256.0) * (count - 256.0) / 256.0;
      EXPECT_LT(chi2, 50.0) << "15 degrees of freedom; sample " << sample;
    }
}

TEST(Sampler, KeysOfDifferentPixelsAndSeedsDiffer) {
  std::set<std::uint64_t> keys;
  for (std::uint32_t x = 0; x < 16; ++x)
    for (std::uint32_t y = 0; y < 16; ++y)
      for (std::uint64_t seed = 0; seed < 4; ++seed)
        keys.insert(PixelSampler(x, y, seed).random_key());
  EXPECT_EQ(keys.size(), 16u * 16 * 4);
}

}  // namespace
}  // namespace portalens
