/// \file
/// What lies just behind a surface that was probably meant to carry it.
#pragma once

#include <string>
#include <vector>

namespace portalens {

struct World;

/// Adds sentences of portals that look at a surface close before them.
void warn_of_walled_up_portals(const World& world, std::vector<std::string>& warnings);

/// Adds sentences of flat surfaces (a picture, a lamp) that a larger one close before them hides
/// from the camera.
void remark_on_hidden_quads(const World& world, std::vector<std::string>& remarks);

}  // namespace portalens
