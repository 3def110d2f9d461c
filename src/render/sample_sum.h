/// \file
/// The sum of a pixel's samples. It is added up along a binary tree: the sum of the samples from
/// j·2^k to (j+1)·2^k is that of their first half plus that of their second half; what lies beyond
/// the last sample is left out. So it does not depend on where the samples were cut into ranges,
/// and its rounding errors grow with the logarithm of their number only (Higham, "The Accuracy of
/// Floating Point Summation", SIAM J. Sci. Comput. 14(4), 1993).
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/vec3.h"

namespace portalens {

/// The samples begin <= s < end of a pixel.
struct SampleRange {
  std::uint32_t begin = 0, end = 0;

  [[nodiscard]] std::uint32_t count() const { return end - begin; }
  [[nodiscard]] bool empty() const { return begin == end; }
  friend bool operator==(const SampleRange&, const SampleRange&) = default;
};

/// The sums of the tree's largest nodes that lie in the range of the samples so far.
class SampleSum {
 public:
  /// The first sample will be `begin`.
  explicit SampleSum(std::uint32_t begin = 0) : next_(begin) {}

  /// The samples of a range, from the sums that `nodes` once gave for it.
  /// @pre sums.size() == node_count(range)
  SampleSum(const SampleRange& range, std::span<const Rgb> sums) : next_(range.begin) {
    add(range, sums);
  }

  /// As newly made, without a look at what stood.
  void restart(std::uint32_t begin) {
    size_ = 0;
    next_ = begin;
  }

  /// The next sample's light.
  void add(Rgb light) { push(0, light); }

  /// The light of the next samples, those of a range.
  /// @pre range.begin is the next sample, and sums.size() == node_count(range)
  void add(const SampleRange& range, std::span<const Rgb> sums) {
    assert(range.begin == next_);
    for (const Rgb& sum : sums) push(level_at(next_, range.end), sum);
  }

  [[nodiscard]] std::span<const Rgb> nodes() const { return {sums_.data(), size_}; }

  /// The sum of all samples so far.
  [[nodiscard]] Rgb total() const {
    if (size_ == 0) return {};
    Rgb sum = sums_[size_ - 1];
    for (std::size_t i = size_ - 1; i-- > 0;) sum = sums_[i] + sum;
    return sum;
  }

  /// How many sums stand for a range.
  [[nodiscard]] static std::size_t node_count(const SampleRange& range) {
    std::size_t count = 0;
    for (std::uint64_t at = range.begin; at < range.end; ++count)
      at += std::uint64_t{1} << level_at(at, range.end);
    return count;
  }

 private:
  /// The largest node that begins at a sample and does not go beyond `end`.
  [[nodiscard]] static int level_at(std::uint64_t at, std::uint64_t end) {
    int level = 0;
    while (at % (std::uint64_t{2} << level) == 0 && at + (std::uint64_t{2} << level) <= end)
      ++level;
    return level;
  }

  void push(int level, Rgb sum) {
    next_ += std::uint64_t{1} << level;
    while (size_ > 0 && levels_[size_ - 1] == level && next_ % (std::uint64_t{2} << level) == 0) {
      sum = sums_[--size_] + sum;
      ++level;
    }
    sums_[size_] = sum;
    levels_[size_++] = level;
  }

  static constexpr std::size_t max_nodes = 64;  // two for each bit of a sample's number
  std::array<Rgb, max_nodes> sums_;
  std::array<int, max_nodes> levels_{};
  std::size_t size_ = 0;
  std::uint64_t next_;
};

}  // namespace portalens
