/// \file
/// The materials of a scene, found by name.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shading/material.h"
#include "world/names.h"

namespace portalens {

class MaterialList {
 public:
  /// Reads `[[material]]` tables.
  MaterialList(const std::vector<Table>& tables, Names& names, const ImageLoader& load,
               Faults& faults);

  /// The material that `key` names; the plain one if the key is absent. An unknown name is a fault.
  [[nodiscard]] std::uint32_t named_by(Parameters& parameters, std::string_view key);
  /// Adds a material that no name leads to.
  std::uint32_t add(Material material);

  [[nodiscard]] std::vector<Material> take() && { return std::move(materials_); }

 private:
  std::uint32_t plain();

  std::vector<Material> materials_;
  std::map<std::string, std::uint32_t> by_name_;
  std::optional<std::uint32_t> plain_;
};

}  // namespace portalens
