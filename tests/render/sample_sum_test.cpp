/// \file
/// Where samples are cut into ranges leaves no trace in their sum.
#include "render/sample_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "math/random.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

/// Light of very different magnitudes, so that the order of additions shows.
Rgb light(std::uint32_t sample) {
  const double x = random_number(7, sample), y = random_number(8, sample);
  return {x * (sample % 7 == 0 ? 1e12 : 1.0), y, x * y * 1e-9};
}

/// As the file's first lines define it.
Rgb tree_sum(std::uint32_t begin, std::uint32_t size, std::uint32_t count) {
  if (size == 1) return light(begin);
  const Rgb first = tree_sum(begin, size / 2, count);
  return begin + size / 2 < count ? first + tree_sum(begin + size / 2, size / 2, count) : first;
}

Rgb sum_of(std::uint32_t count) {
  SampleSum sum;
  for (std::uint32_t i = 0; i < count; ++i) sum.add(light(i));
  return sum.total();
}

std::vector<Rgb> part(const SampleRange& range) {
  SampleSum sum(range.begin);
  for (std::uint32_t i = range.begin; i < range.end; ++i) sum.add(light(i));
  EXPECT_EQ(sum.nodes().size(), SampleSum::node_count(range));
  return {sum.nodes().begin(), sum.nodes().end()};
}

TEST(SampleSum, IsThatOfTheTree) {
  for (std::uint32_t count = 1; count < 200; ++count) {
    std::uint32_t size = 1;
    while (size < count) size *= 2;
    ASSERT_EQ(sum_of(count), tree_sum(0, size, count)) << count;
  }
  EXPECT_EQ(SampleSum().total(), Rgb{});
}

TEST(SampleSum, IsTheSameBitsWhereverTheSamplesAreCut) {
  for (int trial = 0; trial < scaled(2000); ++trial) {
    const auto random = [&](std::uint64_t dimension) { return random_number(trial, dimension); };
    const auto count = static_cast<std::uint32_t>(1 + random(0) * random(1) * 3000);
    const int cuts = static_cast<int>(random(2) * 6);
    std::vector<std::uint32_t> ends;
    for (int i = 0; i < cuts; ++i)
      ends.push_back(static_cast<std::uint32_t>(random(3 + i) * (count + 1)));
    ends.push_back(count);
    std::sort(ends.begin(), ends.end());
    SampleSum sum;
    std::uint32_t begin = 0;
    for (const std::uint32_t end : ends) {
      sum.add({begin, end}, part({begin, end}));
      begin = end;
    }
    ASSERT_EQ(sum.total(), sum_of(count)) << trial;
  }
}

TEST(SampleSum, GoesOnFromWhatItGave) {
  for (int trial = 0; trial < scaled(500); ++trial) {
    const auto begin = static_cast<std::uint32_t>(random_number(trial, 0) * 100);
    const auto middle = begin + static_cast<std::uint32_t>(random_number(trial, 1) * 100);
    const auto end = middle + static_cast<std::uint32_t>(random_number(trial, 2) * 100);
    SampleSum sum({begin, middle}, part({begin, middle}));
    for (std::uint32_t i = middle; i < end; ++i) sum.add(light(i));
    ASSERT_EQ((std::vector<Rgb>{sum.nodes().begin(), sum.nodes().end()}), part({begin, end}));
  }
}

TEST(SampleSum, NeedsFewNodes) {
  for (const SampleRange& range :
       {SampleRange{0, 1'000'000}, SampleRange{1, 999'999}, SampleRange{524'287, 524'289}})
    EXPECT_LE(SampleSum::node_count(range), 40u);
  EXPECT_EQ(SampleSum::node_count({0, 64}), 1u);
  EXPECT_EQ(SampleSum::node_count({64, 128}), 1u);
  EXPECT_EQ(SampleSum::node_count({5, 5}), 0u);
}

}  // namespace
}  // namespace portalens::test
