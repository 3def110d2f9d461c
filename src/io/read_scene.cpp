#include "io/read_scene.h"

#include <cstdint>
#include <memory>
#include <string_view>

#include "core/words.h"
#include "io/digest.h"
#include "io/files.h"
#include "io/obj.h"
#include "io/toml.h"
#include "io/vocabulary.h"

namespace portalens {
namespace {

constexpr std::uint64_t max_toml = max_kept_text;
constexpr std::uint64_t max_obj = std::uint64_t{1} << 30;  // an ordinary mesh may be its own scene

std::string lower_suffix(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  for (char& letter : suffix) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return suffix;
}

}  // namespace

Scene empty_scene(const std::filesystem::path& file) {
  const Location whole{std::make_shared<const std::string>(file.string()), 0};
  Scene scene;
  scene.file = file;
  for (const std::string& name : sections_known()) *find_section(scene, name) = {name, whole, {}};
  return scene;
}

namespace {

enum class Kind { toml, obj };

Scene scene_of(std::string_view text, const std::filesystem::path& file, Kind kind) {
  Scene scene = empty_scene(file);
  const Location whole = scene.camera.where;
  if (text.empty()) throw SceneError({{whole, "the file is empty", "describe a scene in it"}});
  if (kind == Kind::obj)
    read_obj(text, whole.file, scene);
  else
    read_toml(text, whole.file, scene);
  scene.digest = digest(text);
  if (text.size() <= max_kept_text) scene.text.emplace(text);
  return scene;
}

}  // namespace

Scene read_scene(const std::filesystem::path& file) {
  const Location whole = empty_scene(file).camera.where;
  Faults faults;
  const std::string suffix = lower_suffix(file);
  if (suffix != ".toml" && suffix != ".obj") {
    faults.add(whole, suffix.empty() ? "no suffix" : "unknown suffix " + in_quotes(suffix),
               "a scene's name ends in .toml or .obj");
    faults.raise();
  }
  const auto text = read_file(file, suffix == ".toml" ? max_toml : max_obj, whole, faults);
  faults.raise();
  return read_kept_text(*text, file);
}

Scene read_scene_text(std::string_view text, const std::filesystem::path& file) {
  return scene_of(text, file, Kind::toml);
}

Scene read_kept_text(std::string_view text, const std::filesystem::path& file) {
  return scene_of(text, file, lower_suffix(file) == ".obj" ? Kind::obj : Kind::toml);
}

}  // namespace portalens
