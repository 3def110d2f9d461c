/// \file
/// What the field at a point consists of, in words, for `portalens field --at`.
#pragma once

#include <string>

#include "app/json.h"
#include "photon/field_parts.h"

namespace portalens {

[[nodiscard]] Json field_json(const Space& space, const FieldReport& report);

/// The same for people: a line for each part.
[[nodiscard]] std::string field_text(const Space& space, const FieldReport& report);

}  // namespace portalens
