/// \file
/// Scenes drawn at random: what people build, and what has been hard for the engines.
#pragma once

#include <cstdint>

#include "differential/draft.h"

namespace portalens::differential {

inline constexpr const char* room_kind = "room";

/// The scene of that number among those of a seed: it depends on nothing else. Its `kind` is a room
/// ("room"), where portals, pictures and mirrors lie flush in walls, or a free one, named by the
/// gravity through its portals ("bare": it has none).
[[nodiscard]] Draft random_scene(std::uint64_t seed, std::uint64_t index);

/// Whether it is a room.
[[nodiscard]] inline bool is_room(const Draft& draft) { return draft.kind == room_kind; }

}  // namespace portalens::differential
