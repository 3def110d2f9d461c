/// \file
/// Ending well on Ctrl-C.
#pragma once

#include "render/render.h"

namespace portalens {

/// While one lives, the first interrupt (SIGINT, SIGTERM) is a request to stop; a second one ends
/// the program at once. At most one lives at a time.
class InterruptRequest : public Cancellation {
 public:
  InterruptRequest();
  ~InterruptRequest() override;
  InterruptRequest(const InterruptRequest&) = delete;
  InterruptRequest& operator=(const InterruptRequest&) = delete;

  [[nodiscard]] bool requested() const override;
};

}  // namespace portalens
