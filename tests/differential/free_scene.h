/// \file
/// Random scenes in which things hang anywhere.
#pragma once

#include "differential/draft.h"
#include "differential/lot.h"

namespace portalens::differential {

[[nodiscard]] Draft free_scene(Lot& lot);

}  // namespace portalens::differential
