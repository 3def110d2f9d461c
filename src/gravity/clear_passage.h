/// \file
/// How far a place may move before the shortest path from there through a face jumps.
#pragma once

#include "gravity/portal_face.h"
#include "math/vec3.h"

namespace portalens {

/// Within this distance of `from` the shortest path does not jump: it passes one face as it does
/// there, but that it may slide from an edge onto a vertex of it, or back.
[[nodiscard]] double clear_passage(Vec3d from, Vec3d to, const PortalFace& face);

}  // namespace portalens
