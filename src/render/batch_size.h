/// \file
/// How much work to do between two looks at the clock.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace portalens {

/// Finds how many pieces of work take about a tenth of a second, as any of the threads has seen
/// last. What is computed must not depend on it.
class BatchSize {
 public:
  /// @param most  pieces at once, >= `first` >= 1
  BatchSize(std::uint64_t first, std::uint64_t most) : size_(first), most_(most) {}

  /// How many pieces to do next.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// So many were done in so many seconds.
  void took(std::uint64_t count, double seconds) {
    constexpr double aim = 0.1, slow = 0.2, quick = 0.05;
    const std::uint64_t size = size_;
    if (seconds > slow)
      size_ = std::max<std::uint64_t>(
          1, static_cast<std::uint64_t>(static_cast<double>(count) * aim / seconds));
    else if (seconds < quick && count >= size)
      size_ = std::min(most_, 2 * size);
  }

 private:
  std::atomic<std::uint64_t> size_;
  std::uint64_t most_;
};

}  // namespace portalens
