#include "world/mesh_store.h"

#include <utility>

#include "core/words.h"
#include "math/smooth_normals.h"

namespace portalens {

std::optional<LoadedMesh> MeshStore::load(const Mesh& mesh, const MeshWanted& wanted,
                                          const Location& asked_at) {
  if (mesh.file().empty()) return std::nullopt;  // already told
  const auto path = resolve_file(scene_file_, mesh.file(), containment_, asked_at, *faults_);
  if (!path) return std::nullopt;
  const Stored& found = stored(*path, wanted.materials, asked_at);
  if (found.file.triangles.corners.empty()) return std::nullopt;
  triangles_ += found.file.triangles.corners.size();
  if (triangles_ > max_triangles) {
    faults_->add(asked_at, "the scene has more than 10 million triangles",
                 "use fewer or coarser meshes");
    return std::nullopt;
  }
  Triangles triangles = found.file.triangles;
  if (wanted.crease) smooth_normals(triangles, *wanted.crease);
  LoadedMesh loaded{mesh.loaded(std::move(triangles)), found.first_material};
  if (loaded.mesh.triangle_count() == 0) {
    faults_->add(asked_at, "no triangle of " + in_quotes(mesh.file()) + " has an area within 1e12",
                 "check 'scale' and 'translate'");
    return std::nullopt;
  }
  return loaded;
}

const MeshStore::Stored& MeshStore::stored(const std::filesystem::path& path,
                                           FileMaterials materials, const Location& asked_at) {
  const auto [place, is_new] = files_.try_emplace({path, materials});
  Stored& entry = place->second;
  if (!is_new) return entry;
  const std::size_t before = faults_->size();
  entry.file = read_mesh(path, asked_at, materials, *faults_, digests_);
  for (const Fault& warning : entry.file.warnings) warnings_.push_back(to_string(warning));
  if (entry.file.triangles.corners.empty()) {
    if (faults_->size() == before)
      faults_->add(asked_at, "the mesh has no faces", "name a file with at least one");
    return entry;
  }
  entry.first_material = add_materials(path, entry.file.materials);
  return entry;
}

std::optional<std::uint32_t> MeshStore::add_materials(const std::filesystem::path& path,
                                                      const std::vector<Table>& tables) {
  std::optional<std::uint32_t> first;
  const ImageLoader load = images_->loader(path);
  for (const Table& table : tables) {
    Parameters parameters(table, *faults_);
    const std::string name = parameters.text("name", "material");
    Material material = Material::from(parameters, load);
    material.name = path.filename().string() + "/" + name;
    parameters.finish();
    const std::uint32_t index = materials_->add(std::move(material));
    if (!first) first = index;
  }
  return first;
}

}  // namespace portalens
