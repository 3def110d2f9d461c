/// \file
/// How the photons of a picture are sent, and why so: what `check` and `render` say of it.
#pragma once

#include <string>

#include "io/image.h"
#include "render/render.h"
#include "world/world.h"

namespace portalens {

/// Every reason fits behind "because"; it is empty where the faster way is taken.
struct Manner {
  std::string engine;      ///< "lanes" or "scalar"
  std::string why_scalar;  ///< what the scene has, and what lanes would take
  std::string rounding;    ///< of lanes, if other processors get other bits; or empty
  /// Of lanes: near which objects paths are looked along in double ("3 cube, 1 mesh"), or
  /// empty.
  std::string in_double;
  std::string photons;  ///< "fewer" or "all": `Photons`
  std::string why_all;
};

[[nodiscard]] Manner manner_of(const World& world, const RenderOptions& options);

/// What a picture's header keeps of it; nothing of what is empty.
[[nodiscard]] Metadata manner_metadata(const Manner& manner);

}  // namespace portalens
