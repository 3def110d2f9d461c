/// \file
/// Everything in a scene that gives light.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "shading/light.h"
#include "world/object_reader.h"

namespace portalens {

struct NamedLight {
  std::string name;
  Light light;
};

/// The `[[light]]` tables.
[[nodiscard]] std::vector<NamedLight> read_lights(const std::vector<Table>& tables, Names& names,
                                                  Faults& faults);

/// A light for each body and each portal's back that emits, in their order. Bodies are told how
/// large they are as lamps.
[[nodiscard]] std::vector<NamedLight> emitters(Objects& objects,
                                               const std::vector<Material>& materials);

/// The environment, if it shall light what is there, is not black, and something there answers.
[[nodiscard]] std::optional<NamedLight> sky_light(const Environment& sky, const Objects& objects,
                                                  const std::vector<Material>& materials);

/// Adds what is seen of lamps, each with a material of its own.
void add_lamp_bodies(const std::vector<NamedLight>& lights, Objects& objects,
                     std::vector<Material>& materials);

}  // namespace portalens
