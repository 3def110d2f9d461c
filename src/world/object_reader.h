/// \file
/// Reading a scene's objects: what has a surface, a mass, or leads elsewhere.
#pragma once

#include <vector>

#include "geometry/shape.h"
#include "scene/scene.h"
#include "shading/appearance.h"
#include "world/mesh_store.h"
#include "world/names.h"
#include "world/portal_reader.h"

namespace portalens {

struct Objects {
  std::vector<Shape> shapes;
  std::vector<Body> bodies;  ///< one a shape
  std::vector<Mass> masses;
  std::vector<Portal> portals;
};

/// What an object's table may refer to.
struct ObjectContext {
  const Physics& physics;
  Names& names;
  MaterialList& materials;
  MeshStore& meshes;
};

/// Every object of the scene that has no fault.
[[nodiscard]] Objects read_objects(const Scene& scene, const ObjectContext& context,
                                   Faults& faults);

}  // namespace portalens
