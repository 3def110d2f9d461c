/// \file
/// The meshes of a scene: each file read once, and all of them within a budget.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/mesh.h"
#include "io/paths.h"
#include "io/read_mesh.h"
#include "world/image_store.h"
#include "world/material_list.h"

namespace portalens {

/// A mesh in its place, and the first of its file's own materials if it brings any.
struct LoadedMesh {
  Mesh mesh;
  std::optional<std::uint32_t> first_material;
};

/// What is wanted of a mesh's file.
struct MeshWanted {
  FileMaterials materials = FileMaterials::read;
  /// If given, a file without normals gets them by vertex (math/smooth_normals.h), degrees.
  std::optional<double> crease;
};

class MeshStore {
 public:
  /// @param scene_file  which the meshes' names are relative to
  /// @param digests     gets those of the files that are read
  MeshStore(std::filesystem::path scene_file, Containment containment, ImageStore& images,
            MaterialList& materials, Faults& faults, Digests& digests)
      : scene_file_(std::move(scene_file)),
        containment_(containment),
        images_(&images),
        materials_(&materials),
        faults_(&faults),
        digests_(&digests) {}

  /// The mesh with the triangles of its file; nothing after a fault.
  [[nodiscard]] std::optional<LoadedMesh> load(const Mesh& mesh, const MeshWanted& wanted,
                                               const Location& asked_at);

  /// What the files' readers have warned of.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Stored {
    MeshFile file;
    std::optional<std::uint32_t> first_material;
  };

  [[nodiscard]] const Stored& stored(const std::filesystem::path& path, FileMaterials materials,
                                     const Location& asked_at);
  [[nodiscard]] std::optional<std::uint32_t> add_materials(const std::filesystem::path& path,
                                                           const std::vector<Table>& tables);

  std::filesystem::path scene_file_;
  Containment containment_;
  ImageStore* images_;
  MaterialList* materials_;
  Faults* faults_;
  Digests* digests_;
  std::map<std::pair<std::filesystem::path, FileMaterials>, Stored> files_;
  std::vector<std::string> warnings_;
  std::size_t triangles_ = 0;
};

}  // namespace portalens
