/// \file
/// JSON as the subcommands print it: keys in the order in which they were set, one object a line.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "math/vec3.h"

namespace portalens {

using Json = nlohmann::ordered_json;

[[nodiscard]] inline Json to_json(Vec3d v) { return Json::array({v.x, v.y, v.z}); }

/// A number, or null where it is infinite, for which JSON has no word.
[[nodiscard]] inline Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(); }

/// On one line. Bytes that are no UTF-8 (names, paths) become U+FFFD.
[[nodiscard]] inline std::string json_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace portalens
