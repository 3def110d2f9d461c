/// \file
/// The path of one photon in words, for `portalens trace`.
#pragma once

#include <optional>
#include <string>

#include "app/json.h"
#include "render/trace.h"

namespace portalens {

enum class PathOutput { omitted, included };

/// The fields of scene-format.md, section 3. `bounces` is there if any were asked for, or if it is
/// a camera's photon, which also has `ray`, `light` and `layers`.
/// @param missing  what the end of influences took from the turning, where that is known
[[nodiscard]] Json trace_json(const World& world, const Trace& trace, std::optional<double> missing,
                              int max_bounces, PathOutput path);

/// The same for people: a line, one more for each bounce, and the path if it is included.
[[nodiscard]] std::string trace_text(const World& world, const Trace& trace,
                                     std::optional<double> missing, PathOutput path);

}  // namespace portalens
