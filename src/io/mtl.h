/// \file
/// The materials of an ordinary OBJ mesh: MTL, as far as it says what ours can.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameters.h"
#include "io/mesh_warnings.h"

namespace portalens {

inline constexpr std::size_t max_materials = 10000;  ///< of one file

/// One table of kind "material" for each `newmtl`, in our own keys: `Kd` (or the picture of
/// `map_Kd`, which then replaces it) is `diffuse`, `Ke` `emitted`, `Pr` `roughness`, and `Ks`
/// `reflective` where `illum` is 3 or more (MTL mirrors only then). Other statements have no
/// counterpart here and are passed over. Statements may be in letters of any size; a name may be
/// empty.
/// @param name      how messages call the file
/// @param warnings  gets what is passed over though it was meant
[[nodiscard]] std::vector<Table> read_mtl(std::string_view text,
                                          const std::shared_ptr<const std::string>& name,
                                          Faults& faults, MeshWarnings& warnings);

}  // namespace portalens
