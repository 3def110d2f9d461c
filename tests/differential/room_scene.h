/// \file
/// Random rooms: six walls, with doors, pictures and mirrors flush in them.
#pragma once

#include "differential/draft.h"
#include "differential/lot.h"

namespace portalens::differential {

[[nodiscard]] Draft room_scene(Lot& lot);

}  // namespace portalens::differential
