/// \file
/// Work is done once each, stops when told, and its failures come out.
#include "render/parallel.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace portalens {
namespace {

const auto never = [] { return false; };

TEST(Parallel, EveryPieceIsDoneOnceWhateverTheThreads) {
  for (const int threads : {1, 2, 3, 8}) {
    std::vector<std::atomic<int>> done(1000);
    EXPECT_TRUE(parallel_for(
        done.size(), threads, [&](std::size_t i) { ++done[i]; }, never));
    for (const auto& count : done) ASSERT_EQ(count, 1);
  }
}

TEST(Parallel, NoWorkIsDoneAtOnce) {
  EXPECT_TRUE(parallel_for(
      0, 4, [](std::size_t) { FAIL(); }, never));
}

TEST(Parallel, OneThreadGoesInOrder) {
  std::vector<std::size_t> order;
  parallel_for(
      50, 1, [&](std::size_t i) { order.push_back(i); }, never);
  for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
}

TEST(Parallel, WhatHasBegunIsFinishedWhenStopped) {
  for (const int threads : {1, 4}) {
    std::atomic<int> begun{0}, finished{0};
    const bool all = parallel_for(
        10000, threads,
        [&](std::size_t) {
          ++begun;
          std::this_thread::yield();
          ++finished;
        },
        [&] { return begun > 20; });
    EXPECT_FALSE(all);
    EXPECT_EQ(begun, finished);
    EXPECT_LT(begun, 21 + threads);
  }
}

TEST(Parallel, AFailureComesOutAndEndsTheRest) {
  for (const int threads : {1, 4}) {
    std::atomic<int> begun{0};
    EXPECT_THROW(parallel_for(
                     100000, threads,
                     [&](std::size_t i) {
                       ++begun;
                       if (i == 5) throw std::runtime_error("five");
                     },
                     never),
                 std::runtime_error);
    EXPECT_LT(begun, 100000);
  }
}

}  // namespace
}  // namespace portalens
