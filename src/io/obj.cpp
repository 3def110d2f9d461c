#include "io/obj.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "io/lines.h"
#include "io/obj_faces.h"
#include "io/obj_reader.h"
#include "io/tokens.h"

namespace portalens {
namespace {

constexpr std::size_t max_dialect = std::size_t{64} << 20;

enum class Kind { dialect, ordinary };

template <std::size_t count>
bool contains(const std::array<std::string_view, count>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// What a line says about the kind of its file.
enum class Hint { nothing, dialect, ordinary, long_vertex, small_face, large_face };

/// Whether every word after the first is a number.
bool only_numbers(const std::vector<std::string_view>& words) {
  return std::all_of(words.begin() + 1, words.end(),
                     [](std::string_view word) { return parse_number(word).has_value(); });
}

/// So many of the words after the first are indices.
std::size_t count_indices(const std::vector<std::string_view>& words) {
  const auto end = std::find_if(words.begin() + 1, words.end(), [](std::string_view word) {
    return word[0] != '-' && (word[0] < '0' || word[0] > '9');
  });
  return static_cast<std::size_t>(end - words.begin()) - 1;
}

Hint hint_of(const std::vector<std::string_view>& words) {
  constexpr std::array<std::string_view, 7> dialect{
      "material",           "m",    "background_color", "PerspectiveCamera",
      "OrthographicCamera", "mass", "physics"};
  constexpr std::array<std::string_view, 7> ordinary{"mtllib", "usemtl", "o", "g", "vn", "vp", "l"};
  const std::string_view word = words[0];
  if (contains(ordinary, word)) return Hint::ordinary;
  for (const std::string_view any : words) {
    if (contains(dialect, any)) return Hint::dialect;
  }
  if (word == "v" && words.size() > 4 && only_numbers(words)) return Hint::long_vertex;
  const std::size_t values = count_indices(words);
  if (word == "s") return words.size() == 2 ? Hint::ordinary : Hint::dialect;  // or a sphere
  if (word == "r" || (word == "p" && values >= 5)) return Hint::dialect;
  if (word != "f") return Hint::nothing;
  return values > 4 || (values > 0 && words[1][0] == '-') ? Hint::large_face : Hint::small_face;
}

/// One word of the dialect's own decides, and so does else one of ordinary OBJ, or a face that the
/// dialect cannot have: of vertices with weights or colours, or not flat. Where there is neither, a
/// few small faces are a scene of quads; anything more is a mesh.
Kind kind_of(std::string_view text) {
  constexpr std::size_t few = 1000;
  bool ordinary = false, long_vertices = false;
  std::size_t faces = 0;
  PlainFaces plain;
  for (LineReader lines(text); lines.next();) {
    const Hint hint = hint_of(lines.words());
    if (hint == Hint::dialect) return Kind::dialect;
    ordinary |= hint == Hint::ordinary || hint == Hint::large_face;
    long_vertices |= hint == Hint::long_vertex;
    faces += hint == Hint::small_face ? 1 : 0;
    if (!ordinary && faces <= few) plain.take(lines.words());
  }
  ordinary |= faces > few || (faces > 0 && long_vertices) || plain.bent();
  return ordinary ? Kind::ordinary : Kind::dialect;
}

Value gray(double brightness, const Location& where) {
  const Value channel{brightness, where};
  return {Value::List{channel, channel, channel}, where};
}

/// The scene's one object is the scene's own file. Its camera and its lamps depend on its shape,
/// and are chosen where that is known (world/stage.h).
void read_as_mesh(const Location& whole, Scene& scene) {
  constexpr double backdrop = 0.85, ambient = 0.22;
  constexpr double crease = 40.0;  // degrees
  scene.environment.set("color", gray(backdrop, whole));
  scene.shading.set("ambient", gray(ambient, whole));
  Table mesh{"mesh", whole, {}};
  mesh.set("file", {scene.file.filename().string(), whole});
  mesh.set("smooth", {crease, whole});
  scene.objects.push_back(std::move(mesh));
}

}  // namespace

void read_obj(std::string_view text, const std::shared_ptr<const std::string>& name, Scene& scene) {
  const Location whole{name, 0};
  if (is_utf16(text)) {
    scene.faults.add(whole, "the file is in UTF-16", "save it as UTF-8");
  } else if (kind_of(text) == Kind::ordinary) {
    read_as_mesh(whole, scene);
  } else if (text.size() > max_dialect) {
    scene.faults.add(whole, "longer than 64 MiB", "put its faces into a mesh");
  } else if (TokenStream(text).peek().at_end()) {
    scene.faults.add(whole, "the file has no statement", "describe a scene in it");
  } else {
    ObjReader(text, name, scene).read();
  }
}

}  // namespace portalens
