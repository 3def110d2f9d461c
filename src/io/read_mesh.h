/// \file
/// Reading an ordinary OBJ mesh, with its MTL materials.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/parameters.h"
#include "io/digest.h"
#include "math/triangles.h"

namespace portalens {

/// Of a mesh, and of all the meshes of a scene together; some 4 GiB with the accelerator.
inline constexpr std::size_t max_triangles = 10'000'000;

/// `triangles.material_of` indexes `materials`, which are tables of kind "material" in our own keys
/// (diffuse, reflective, roughness, emitted); both are empty if the file names no material.
struct MeshFile {
  Triangles triangles;
  std::vector<Table> materials;
  std::vector<Fault> warnings;  ///< what is passed over, or stands in for what is missing
};

/// Whether `mtllib` and `usemtl` count.
enum class FileMaterials { read, passed_over };

/// Polygons are triangulated here, once. Every index and number is checked.
/// @param asked_at  where the scene names the file; faults without a line of their own point there
/// @param digests   if given, gets those of the file and its material file
/// @return an empty mesh if there was any fault
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& file, const Location& asked_at,
                                 FileMaterials wanted, Faults& faults, Digests* digests = nullptr);

}  // namespace portalens
