/// \file
/// The sections that a scene file may have. Every other table is an element of a list: which
/// kinds there are, is judged where objects are read.
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

[[nodiscard]] std::vector<std::string> sections_known();

}  // namespace portalens
