/// \file
/// The materials that an ordinary OBJ names, from its MTL files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameters.h"
#include "io/digest.h"
#include "io/mesh_warnings.h"

namespace portalens {

/// What `mtllib` and `usemtl` mean. What is amiss with them, but leaves the shape as it is, is a
/// warning, and the default material stands in.
class MeshMaterials {
 public:
  /// @param file     of the mesh: names are relative to its folder
  /// @param digests  if given, gets those of the MTL files
  MeshMaterials(std::filesystem::path file, Faults& faults, MeshWarnings& warnings,
                Digests* digests);

  /// `mtllib`: one file whose name has spaces, or several.
  /// @param words  of the line; @param rest  all after the first of them
  void read(const std::vector<std::string_view>& words, const std::string& rest,
            const Location& where);
  /// `usemtl`: for the faces that follow. The empty name is one.
  void use(const std::string& name, const Location& where);

  /// Of the faces that follow: an index into `take`, or `left_out`.
  [[nodiscard]] std::uint32_t current() const { return current_; }
  [[nodiscard]] std::vector<Table> take() && { return std::move(tables_); }

 private:
  void read_file(const std::string& name, const Location& where);

  std::filesystem::path file_;
  Faults* faults_;
  MeshWarnings* warnings_;
  Digests* digests_;
  std::vector<Table> tables_;
  std::map<std::string, std::uint32_t> by_name_;
  std::set<std::string> names_;  ///< of MTL files that have been asked for
  std::set<std::filesystem::path> read_;
  std::set<std::string> unknown_;  ///< names that have been warned of
  bool any_missing_ = false;       ///< an MTL file is: what it would say is not known
  std::uint32_t current_;
};

}  // namespace portalens
