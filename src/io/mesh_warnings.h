/// \file
/// What the readers of a mesh and its materials pass over, or replace.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"

namespace portalens {

/// Keeps the first warnings and counts the others: a file may give cause for millions.
class MeshWarnings {
 public:
  void add(Location where, std::string problem, std::string remedy) {
    if (kept_.size() < max_kept)
      kept_.push_back({std::move(where), std::move(problem), std::move(remedy)});
    else
      ++more_;
  }

  /// @param file  that the count of the others is told of
  [[nodiscard]] std::vector<Fault> take(const Location& file) && {
    if (more_ > 0)
      kept_.push_back({file, std::to_string(more_) + " more things are passed over or replaced",
                       "mend those above first"});
    return std::move(kept_);
  }

 private:
  static constexpr std::size_t max_kept = 20;

  std::vector<Fault> kept_;
  std::size_t more_ = 0;
};

}  // namespace portalens
