/// \file
/// The path of one photon in words, for `portalens trace`.
#pragma once

#include <string>

#include "app/json.h"
#include "render/trace.h"

namespace portalens {

enum class PathOutput { omitted, included };

/// The fields of scene-format.md, section 3. `bounces` is there if any were asked for, or if it is
/// a camera's photon, which also has `ray`, `light` and `layers`.
[[nodiscard]] Json trace_json(const World& world, const Trace& trace, int max_bounces,
                              PathOutput path);

/// The same for people: a line, one more for each bounce, and the path if it is included.
[[nodiscard]] std::string trace_text(const World& world, const Trace& trace, PathOutput path);

}  // namespace portalens
