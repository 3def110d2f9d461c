#include "app/recipe.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <exception>
#include <memory>
#include <new>
#include <sstream>
#include <string_view>
#include <utility>

#include "app/json.h"
#include "core/words.h"
#include "io/exr_texts.h"
#include "io/read_scene.h"
#include "render/layers.h"

namespace portalens {
namespace {

constexpr const char* recipe_entry = "portalens:recipe";
constexpr const char* window_entry = "portalens:window";
/// Bytes; a text that can't be packed takes twice its own.
constexpr std::size_t max_recipe = 4 * max_kept_text;

std::string packed(const std::string& text) {
  uLongf size = compressBound(text.size());
  std::string bytes(size, '\0');
  const int result =
      compress2(reinterpret_cast<Bytef*>(bytes.data()), &size,
                reinterpret_cast<const Bytef*>(text.data()), text.size(), Z_BEST_COMPRESSION);
  if (result != Z_OK) throw WorkError("no memory to pack the scene's text");
  std::string spelled;
  for (std::size_t i = 0; i < size; ++i)
    spelled += fmt::format("{:02x}", static_cast<unsigned char>(bytes[i]));
  return spelled;
}

/// Nothing if it is damaged, or the text is longer than any that is kept.
std::optional<std::string> unpacked(const std::string& spelled) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < spelled.size(); i += 2) {
    unsigned char byte = 0;
    const char* const end = spelled.data() + i + 2;
    const auto [stopped, error] = std::from_chars(spelled.data() + i, end, byte, 16);
    if (error != std::errc{} || stopped != end) return std::nullopt;
    bytes += static_cast<char>(byte);
  }
  std::string text(max_kept_text, '\0');
  uLongf size = text.size();
  if (uncompress(reinterpret_cast<Bytef*>(text.data()), &size,
                 reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) != Z_OK)
    return std::nullopt;
  text.resize(size);
  return text;
}

const char* name_of(Engine engine) { return engine == Engine::scalar ? "scalar" : "automatic"; }
const char* name_of(Photons photons) { return photons == Photons::all ? "all" : "fewer"; }

/// "X0 Y0 X1 Y1"
std::optional<Window> window_in(const std::string& text) {
  std::istringstream numbers(text);
  Window window{};
  if (!(numbers >> window.x0 >> window.y0 >> window.x1 >> window.y1) || window.empty() ||
      window.x0 < 0 || window.y0 < 0)
    return std::nullopt;
  return window;
}

/// Thrown where a recipe says what no render has written.
struct Damaged : std::exception {};

void require(bool condition) {
  if (!condition) throw Damaged{};
}

/// @throws Json::exception, Damaged
Recipe recipe_in(const std::string& text) {
  const Json json = Json::parse(text);
  Recipe recipe;
  json.at("program").get_to(recipe.program);
  const Json& scene = json.at("scene");
  // It came from elsewhere: no more of it is taken than a name.
  recipe.scene_name =
      std::filesystem::path(scene.at("name").get<std::string>()).filename().string();
  const std::string& name = recipe.scene_name;
  require(!name.empty() && name != "." && name != ".." && name == harmless(name));
  scene.at("digest").get_to(recipe.scene_digest);
  if (const auto kept = scene.find("text"); kept != scene.end()) {
    recipe.text = unpacked(kept->get<std::string>());
    require(recipe.text && digest(*recipe.text) == recipe.scene_digest);
  }
  for (const Json& file : json.at("files"))
    recipe.files.push_back(
        {file.at("name").get<std::string>(), file.at("digest").get<std::string>()});
  json.at("set").get_to(recipe.settings);
  recipe.engine = json.at("engine") == "scalar" ? Engine::scalar : Engine::automatic;
  recipe.photons = json.at("photons") == "all" ? Photons::all : Photons::fewer;
  require(json.at("engine") == name_of(recipe.engine));
  require(json.at("photons") == name_of(recipe.photons));
  json.at("layers").get_to(recipe.layers);
  for (const std::string& layer : recipe.layers)
    require(std::find(layer_names.begin(), layer_names.end(), layer) != layer_names.end());
  return recipe;
}

std::string entry_in(const Metadata& header, std::string_view name) {
  const auto found = std::find_if(header.begin(), header.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  return found == header.end() ? "" : found->second;
}

}  // namespace

Metadata recipe_metadata(const Recipe& recipe) {
  Json scene = {{"name", recipe.scene_name}, {"digest", recipe.scene_digest}};
  if (recipe.text) scene["text"] = packed(*recipe.text);
  Json files = Json::array();
  for (const UsedFile& file : recipe.files)
    files.push_back({{"name", file.name}, {"digest", file.digest}});
  const Json json = {{"program", recipe.program},
                     {"scene", scene},
                     {"files", files},
                     {"set", recipe.settings},
                     {"engine", name_of(recipe.engine)},
                     {"photons", name_of(recipe.photons)},
                     {"layers", recipe.layers}};
  try {
    std::string text = json.dump();
    if (text.size() <= max_recipe) return {{recipe_entry, std::move(text)}};
  } catch (const Json::exception&) {  // JSON has no bytes that are no UTF-8
  }
  return {};
}

Metadata without_recipe(Metadata header) {
  header.erase(std::remove_if(header.begin(), header.end(),
                              [](const auto& entry) { return entry.first == recipe_entry; }),
               header.end());
  return header;
}

Recipe read_recipe(const std::filesystem::path& picture) {
  const Metadata header = read_exr_texts(picture);
  const std::string text = entry_in(header, recipe_entry);
  if (text.empty())
    refuse("the picture " + picture.filename().string() + " does not tell how it was made",
           "name an .exr that portalens rendered or merged, and that image has not changed");
  try {
    require(text.size() <= max_recipe);
    Recipe recipe = recipe_in(text);
    recipe.window = window_in(entry_in(header, window_entry));
    return recipe;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    refuse("what the picture " + picture.filename().string() + " tells of its making is damaged",
           "use another copy of the picture");
  }
}

namespace {

/// What a fault of the whole picture has for its place.
Location place_of(const std::filesystem::path& picture) {
  return {std::make_shared<const std::string>(picture.string()), 0};
}

}  // namespace

void check_files_exist(const Recipe& recipe, const std::filesystem::path& picture,
                       const std::filesystem::path& scene_file, Containment containment,
                       Faults& faults) {
  const std::string folder =
      scene_file.has_parent_path() ? scene_file.parent_path().string() : "this folder";
  for (const UsedFile& file : recipe.files) {
    if (is_missing(scene_file, file.name))
      faults.add(place_of(picture), "its file " + in_quotes(file.name) + " is not in " + folder,
                 "put it there, or name the folder of the scene's files with --scene-folder");
    else
      (void)resolve_file(scene_file, file.name, containment, place_of(picture), faults);
  }
}

void check_files_same(const Recipe& recipe, const std::filesystem::path& picture,
                      const std::vector<UsedFile>& files, Faults& faults) {
  for (const UsedFile& before : recipe.files)
    for (const UsedFile& now : files)
      if (now.name == before.name && now.digest != before.digest)
        faults.add(place_of(picture),
                   "the file " + in_quotes(now.name) + " is not the one it was made with",
                   "put that one back, or take this one all the same with --changed-files");
}

}  // namespace portalens
