/// \file
/// The tables a scene file may have.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace portalens {

/// More would be slow as objects of their own: they belong in a mesh.
inline constexpr std::size_t max_objects = 100000;

/// The scene's `[name]`, or null.
[[nodiscard]] Table* find_section(Scene& scene, std::string_view name);

/// Whether `[[name]]` is one: material, light, a primitive, a portal or a mass.
[[nodiscard]] bool is_list(std::string_view name);

/// Every table's name: the sections, then the lists.
[[nodiscard]] std::vector<std::string> tables_known();
[[nodiscard]] std::vector<std::string> sections_known();

}  // namespace portalens
