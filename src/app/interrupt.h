/// \file
/// What a running render is told by signals.
#pragma once

#include "render/render.h"

namespace portalens {

/// Catches signals while it lives; at most one lives at a time. SIGUSR1 asks for a look at what
/// stands. Once `hold_ends` was called, the first SIGINT, SIGTERM or SIGHUP is a request to stop,
/// and a second one ends the program at once. A hang-up that was ignored (nohup) stays so.
class Signals : public Cancellation {
 public:
  Signals();
  ~Signals() override;
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// Until now an interrupt ended the program; from now on it is a request.
  void hold_ends();
  /// Whether to stop.
  [[nodiscard]] bool requested() const override { return ended_by() != 0; }
  /// The signal that asked to stop, or 0.
  [[nodiscard]] int ended_by() const;
  /// Whether a look was asked for since the last call.
  [[nodiscard]] bool take_look();
};

}  // namespace portalens
