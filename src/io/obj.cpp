#include "io/obj.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "io/obj_reader.h"

namespace portalens {
namespace {

constexpr std::size_t most_dialect = std::size_t{64} << 20;

enum class Kind { dialect, ordinary };

template <std::size_t count>
bool contains(const std::array<std::string_view, count>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Told by the words that begin lines. One word of the dialect's own decides; `f`, `p`, `r`, `s`,
/// `v` and `vt` say nothing, since both kinds have them or might.
Kind kind_of(std::string_view text) {
  constexpr std::array<std::string_view, 7> dialect{
      "material",           "m",    "background_color", "PerspectiveCamera",
      "OrthographicCamera", "mass", "physics"};
  constexpr std::array<std::string_view, 6> ordinary{"mtllib", "usemtl", "o", "g", "vn", "vp"};
  Kind kind = Kind::dialect;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    const std::size_t first = std::min(line.find_first_not_of(" \t\r"), line.size());
    const std::size_t last = std::min(line.find_first_of(" \t\r", first), line.size());
    const std::string_view word = line.substr(first, last - first);
    if (contains(dialect, word)) return Kind::dialect;
    if (contains(ordinary, word)) kind = Kind::ordinary;
    begin = end + 1;
  }
  return kind;
}

void read_as_mesh(const Location& whole, Scene& scene) {
  const Value one{1.0, whole};
  scene.environment.set("color", {Value::List{one, one, one}, whole});
  Table mesh{"mesh", whole, {}};
  mesh.set("file", {scene.file.filename().string(), whole});
  scene.objects.push_back(std::move(mesh));
}

}  // namespace

void read_obj(std::string_view text, const std::shared_ptr<const std::string>& name, Scene& scene) {
  const Location whole{name, 0};
  if (kind_of(text) == Kind::ordinary) {
    read_as_mesh(whole, scene);
  } else if (text.size() > most_dialect) {
    scene.faults.add(whole, "longer than 64 MiB", "put its faces into a mesh");
  } else if (TokenStream(text).peek().at_end()) {
    scene.faults.add(whole, "the file has no statement", "describe a scene in it");
  } else {
    ObjReader(text, name, scene).read();
  }
}

}  // namespace portalens
