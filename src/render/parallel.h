/// \file
/// Work on several threads. The only file that knows oneTBB; with PORTALENS_STD_THREADS it is built
/// on std::jthread instead, because the thread sanitizer reports falsely through Debian's oneTBB,
/// and for builds that do without it; with PORTALENS_ONE_THREAD, where there are no threads, on
/// none.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#if !defined(PORTALENS_STD_THREADS) && !defined(PORTALENS_ONE_THREAD)
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace portalens {

/// As many threads as the machine runs at once, at least 1.
[[nodiscard]] inline int available_threads() {
#ifdef PORTALENS_ONE_THREAD
  return 1;
#else
  const unsigned count = std::thread::hardware_concurrency();
  return count == 0 ? 1 : static_cast<int>(count);
#endif
}

/// Runs `worker()` once on each of `threads` threads, and waits for all of them; one after the
/// other where there are no threads.
/// @pre threads >= 1
/// @throws what a worker threw first
template <class Worker>
void on_threads(int threads, const Worker& worker) {
#if defined(PORTALENS_ONE_THREAD)
  for (int i = 0; i < threads; ++i) worker();
#elif defined(PORTALENS_STD_THREADS)
  std::exception_ptr failure;
  std::mutex guard;
  {
    std::vector<std::jthread> team;
    for (int i = 0; i < threads; ++i)
      team.emplace_back([&] {
        try {
          worker();
        } catch (...) {
          const std::lock_guard lock(guard);
          if (!failure) failure = std::current_exception();
        }
      });
  }
  if (failure) std::rethrow_exception(failure);
#else
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        0, threads, [&](int) { worker(); }, tbb::simple_partitioner());
  });
#endif
}

/// Calls `work(i)` for each i < count, in that order of beginning, until `stop()` says so: what has
/// begun by then is finished. A `work` that throws ends the others too.
/// @pre threads >= 1
/// @return whether every one was done
template <class Work, class Stop>
bool parallel_for(std::size_t count, int threads, const Work& work, const Stop& stop) {
  std::atomic<std::size_t> next{0}, done{0};
  std::atomic<bool> failed{false};
  on_threads(threads, [&] {
    while (!failed && !stop()) {
      const std::size_t i = next++;
      if (i >= count) return;
      try {
        work(i);
      } catch (...) {
        failed = true;
        throw;
      }
      ++done;
    }
  });
  return done == count;
}

}  // namespace portalens
