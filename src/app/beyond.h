/// \file
/// Where a camera stands that goes through portals: what it sees from there continues what it sees
/// through them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/json.h"
#include "render/trace.h"
#include "world/world.h"

namespace portalens {

/// The keys of a `[camera]` that say where it stands.
struct CameraPlace {
  Vec3d position, look_at, up;
};

[[nodiscard]] CameraPlace place_of(const Camera& camera);

/// The place moved through a portal as light that meets its front is; nothing where the passage is
/// no rigid motion.
[[nodiscard]] std::optional<CameraPlace> beyond(const Portal& portal, const CameraPlace& place);

/// Beyond all portals that the photon crossed before it met a mirror: of the camera, if the photon
/// is the camera's, else of one that looks along its start. Nothing if there are none.
[[nodiscard]] std::optional<CameraPlace> beyond(const World& world, const Trace& trace);

/// Three lines for `[camera]`, each behind some blanks.
[[nodiscard]] std::string as_toml(const CameraPlace& place, std::string_view blanks);
[[nodiscard]] Json to_json(const CameraPlace& place);

}  // namespace portalens
