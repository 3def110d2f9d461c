#include "io/mesh_materials.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/words.h"
#include "io/files.h"
#include "io/lines.h"
#include "io/mesh_gaps.h"
#include "io/mtl.h"
#include "io/paths.h"

namespace portalens {
namespace {

constexpr std::uint64_t max_mtl_bytes = std::uint64_t{16} << 20;
constexpr std::size_t max_warned = 20, max_files = 1000;

/// As it is written where folders end with a slash.
std::string with_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

}  // namespace

MeshMaterials::MeshMaterials(std::filesystem::path file, Faults& faults, MeshWarnings& warnings,
                             Digests* digests)
    : file_(std::move(file)),
      faults_(&faults),
      warnings_(&warnings),
      digests_(digests),
      current_(left_out) {}

void MeshMaterials::read(const std::vector<std::string_view>& words, const std::string& rest,
                         const Location& where) {
  const std::string whole = with_slashes(rest);
  if (words.size() <= 2 || !is_missing(file_, whole)) return read_file(whole, where);
  for (std::size_t i = 1; i < words.size(); ++i)
    read_file(with_slashes(std::string(words[i])), where);
}

void MeshMaterials::read_file(const std::string& name, const Location& where) {
  if (names_.size() > max_files || !names_.insert(name).second) return;
  if (names_.size() > max_files)
    return faults_->add(where, "more than 1000 MTL files", "name fewer");
  if (is_missing(file_, name)) {
    any_missing_ = true;
    warnings_->add(where, "there is no file " + in_quotes(name),
                   "its materials are the default grey; put it beside the mesh, or give the "
                   "mesh a material of the scene");
    return;
  }
  const auto file = resolve_file(file_, name, Containment::scene_folder, where, *faults_);
  if (!file || !read_.insert(*file).second) return;
  const auto text = portalens::read_file(*file, max_mtl_bytes, where, *faults_, digests_);
  if (!text) return;
  const auto shown = std::make_shared<const std::string>((file_.parent_path() / name).string());
  for (Table& table : read_mtl(*text, shown, *faults_, *warnings_)) {
    const auto index = static_cast<std::uint32_t>(tables_.size());
    const auto& key = std::get<std::string>(table.find("name")->data);
    if (by_name_.emplace(key, index).second)
      tables_.push_back(std::move(table));
    else
      warnings_->add(table.where, "a second material " + in_quotes(key),
                     "the first one counts; give this one another name");
  }
}

void MeshMaterials::use(const std::string& name, const Location& where) {
  const auto found = by_name_.find(name);
  current_ = found == by_name_.end() ? left_out : found->second;
  if (found != by_name_.end() || any_missing_ || unknown_.size() >= max_warned ||
      !unknown_.insert(name).second)
    return;
  std::vector<std::string> known;
  for (const auto& [other, unused] : by_name_) known.push_back(other);
  warnings_->add(
      where, "unknown material " + in_quotes(name),
      "the default grey stands in; " +
          (known.empty() ? "no mtllib above names an MTL file" : suggestion_or_list(name, known)));
}

}  // namespace portalens
