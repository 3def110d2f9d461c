/// \file
/// Over lanes: what a step meets first.
#pragma once

#include "lanes/scene.h"

namespace portalens {

/// The earliest event of a step so far.
template <class R>
struct LaneFinding {
  R share{2.0};  ///< of the step; beyond 1: none
  R event{0}, object{-1};

  void offer(typename R::Mask found, R at, LaneEvent kind, R which) {
    const auto earlier = found & (at < share);
    share = select(earlier, at, share);
    event = select(earlier, R(static_cast<int>(kind)), event);
    object = select(earlier, which, object);
  }
};

}  // namespace portalens
