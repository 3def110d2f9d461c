/// \file
/// What a model is seen by that is rendered without a scene: a camera and lamps that suit it.
#pragma once

#include <string>
#include <vector>

#include "world/camera.h"
#include "world/light_list.h"
#include "world/world.h"

namespace portalens {

/// Whether the scene is an ordinary OBJ: then its one object is a mesh, of the scene's own file.
[[nodiscard]] bool is_model_alone(const Scene& scene);

/// The table of the camera, with what it does not say: it sees all of the model from the front, a
/// little from the right and from above; of a flat model it sees the face, from above if that lies.
/// Models stand along +y, and their front is at +z.
/// @param objects  at least one mesh, or the table is left as it is
[[nodiscard]] Table staged_camera(const Table& camera, const Objects& objects, const Film& film);

/// A key light above the camera and to its left, and a weaker one behind the camera, which leaves
/// nothing that is seen quite dark. They stand far off, so that all of the model gets the same: the
/// irradiance is such that with the ambient light no white face is brighter than white.
[[nodiscard]] std::vector<NamedLight> stage_lights(const Camera& camera, const Objects& objects);

/// Says so to a person.
[[nodiscard]] std::string stage_remark(const Camera& camera);

}  // namespace portalens
