/// \file
/// What a scene's portals show that was probably not meant.
#pragma once

#include <string>
#include <vector>

namespace portalens {

struct World;

/// Adds sentences: where the camera sees nothing but open backs, and where a pair turns what stands
/// upright.
void warn_about_portals(const World& world, std::vector<std::string>& warnings);

}  // namespace portalens
