/// \file
/// The OBJ dialect of Rensselaer's teaching ray tracer, which the paper extends, into a `Scene`.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace portalens {

/// Fills `scene` with what `text` says, and its faults with every mistake and its line. An ordinary
/// OBJ (one that says `mtllib`, `usemtl`, `o`, `g` or `vn`, or has more than 1000 faces, and says
/// nothing that only the dialect does) becomes a scene of one mesh.
/// @param name  how messages call the file
void read_obj(std::string_view text, const std::shared_ptr<const std::string>& name, Scene& scene);

}  // namespace portalens
