#include "io/read_scene.h"

#include <cstdint>
#include <memory>
#include <string_view>

#include "core/words.h"
#include "io/files.h"
#include "io/obj.h"
#include "io/toml.h"
#include "io/vocabulary.h"

namespace portalens {
namespace {

constexpr std::uint64_t max_toml = std::uint64_t{1} << 20;
constexpr std::uint64_t max_obj = std::uint64_t{1} << 30;  // an ordinary mesh may be its own scene

std::string lower_suffix(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  for (char& letter : suffix) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return suffix;
}

void check_not_empty(std::string_view text, const Location& whole) {
  if (text.empty()) throw SceneError({{whole, "the file is empty", "describe a scene in it"}});
}

}  // namespace

Scene empty_scene(const std::filesystem::path& file) {
  const Location whole{std::make_shared<const std::string>(file.string()), 0};
  Scene scene;
  scene.file = file;
  for (const std::string& name : sections_known()) *find_section(scene, name) = {name, whole, {}};
  return scene;
}

Scene read_scene(const std::filesystem::path& file) {
  Scene scene = empty_scene(file);
  const Location whole = scene.camera.where;
  Faults faults;
  const std::string suffix = lower_suffix(file);
  if (suffix != ".toml" && suffix != ".obj") {
    faults.add(whole, suffix.empty() ? "no suffix" : "unknown suffix " + in_quotes(suffix),
               "a scene's name ends in .toml or .obj");
    faults.raise();
  }
  const auto text = read_file(file, suffix == ".toml" ? max_toml : max_obj, whole, faults);
  faults.raise();
  check_not_empty(*text, whole);
  if (suffix == ".toml") {
    read_toml(*text, whole.file, scene);
  } else {
    read_obj(*text, whole.file, scene);
  }
  return scene;
}

Scene read_scene_text(std::string_view text, const std::filesystem::path& file) {
  Scene scene = empty_scene(file);
  const Location whole = scene.camera.where;
  check_not_empty(text, whole);
  read_toml(text, whole.file, scene);
  return scene;
}

}  // namespace portalens
