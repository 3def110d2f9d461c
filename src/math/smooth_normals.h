/// \file
/// Normals by vertex for a mesh that has none.
#pragma once

#include "math/triangles.h"

namespace portalens {

/// Gives every corner the mean normal of the triangles round its vertex that hang together over
/// smooth edges, weighted by their angles there (Thürmer and Wüthrich 1998). An edge is smooth if
/// it has two triangles, which run along it in opposite directions, and their normals are at most
/// `crease` degrees apart. Equal positions count as one vertex. A triangle with three sharp edges
/// stays flat: its normals are zero, as `Mesh` takes them. A mesh that has normals keeps them.
/// @pre each corner's position is one of the mesh
void smooth_normals(Triangles& mesh, double crease);

}  // namespace portalens
