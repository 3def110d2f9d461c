#include "app/scene_options.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "app/shell_word.h"
#include "core/words.h"
#include "io/files.h"
#include "io/override.h"
#include "io/read_scene.h"
#include "portalens/version.h"
#include "world/compile.h"

namespace portalens {
namespace {

Containment containment_of(const SceneOptions& options) {
  return options.allow_outside_files ? Containment::anywhere : Containment::scene_folder;
}

/// The scene that a picture keeps, as if its file lay in the folder of its files.
Scene kept_scene(const Recipe& recipe, const SceneOptions& options) {
  const std::filesystem::path file =
      options.folder.value_or(options.from->parent_path()) / recipe.scene_name;
  Faults faults;
  check_files_exist(recipe, *options.from, file, containment_of(options), faults);
  faults.raise();
  if (recipe.text) return read_kept_text(*recipe.text, file);
  Scene scene = read_scene(file);
  Recipe scene_alone;
  scene_alone.files = {{recipe.scene_name, recipe.scene_digest}};
  if (!options.changed_files)
    check_files_same(scene_alone, *options.from, {{recipe.scene_name, scene.digest}}, faults);
  faults.raise();
  return scene;
}

Scene scene_from_input() {
  Faults faults;
  const auto text = read_file(standard_stream, max_kept_text, {}, faults);
  faults.raise();
  return read_scene_text(*text, "<stdin>");
}

void check_choice(const SceneOptions& options) {
  if (options.from && !options.file.empty())
    refuse("both a scene and --from are given", "leave one of them out");
  if (options.folder && !std::filesystem::is_directory(*options.folder))
    refuse("--scene-folder " + options.folder->string() + " is no folder",
           "name the one in which the scene's files are");
  if (!options.from && (options.folder || options.changed_files))
    refuse("--scene-folder and --changed-files are for --from",
           "leave them out, or name a picture with --from");
}

}  // namespace

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command
      .add_option("scene", options.file,
                  "Scene file: TOML, or the OBJ dialect; - is TOML from standard input")
      ->required()
      ->type_name("SCENE");
  command
      .add_option("--from", options.from,
                  "In place of SCENE: an .exr that portalens wrote; the scene and the options that "
                  "it keeps are taken, the files of the scene from beside it")
      ->type_name("PICTURE");
  command
      .add_option("--scene-folder", options.folder,
                  "With --from: the folder in which the scene's files are")
      ->type_name("FOLDER");
  command.add_flag("--changed-files", options.changed_files,
                   "With --from: take files that have changed since, too");
  command
      .add_option("--set", options.settings,
                  "Set a value as if the file said so, for instance physics.tolerance=1e-6 or "
                  "sphere.ball.radius=2; may be repeated")
      ->type_name("PATH=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command.add_flag("--allow-outside-files", options.allow_outside_files,
                   "Let the scene name files outside its own folder");
}

AskedScene read_with_settings(const SceneOptions& options) {
  check_choice(options);
  AskedScene asked;
  if (options.from) {
    asked.recipe = read_recipe(*options.from);
    asked.scene = kept_scene(*asked.recipe, options);
  } else {
    asked.scene = options.file == standard_stream ? scene_from_input() : read_scene(options.file);
  }
  std::vector<std::string> settings;
  if (asked.recipe) settings = asked.recipe->settings;
  settings.insert(settings.end(), options.settings.begin(), options.settings.end());
  Faults faults;
  for (const std::string& setting : settings) {
    const auto place = std::make_shared<const std::string>("--set " + setting);
    override_value(asked.scene, setting, faults, {place, 0});
  }
  faults.raise();
  return asked;
}

World compile_with_options(const AskedScene& asked, const SceneOptions& options) {
  CompileOptions compile_options;
  compile_options.files = containment_of(options);
  World world = compile(asked.scene, compile_options);
  if (!asked.recipe) return world;
  Faults faults;
  if (!options.changed_files) check_files_same(*asked.recipe, *options.from, world.files, faults);
  faults.raise();
  if (asked.recipe->program != api::version)
    world.warnings.push_back(options.from->filename().string() + " was made by portalens " +
                             harmless(asked.recipe->program) + ", this is " +
                             std::string(api::version) + ": the picture may differ");
  return world;
}

std::vector<std::filesystem::path> inputs_of(const World& world, const SceneOptions& options) {
  std::vector<std::filesystem::path> inputs = {world.file};
  if (options.from) inputs.push_back(*options.from);
  for (const UsedFile& file : world.files) inputs.push_back(world.file.parent_path() / file.name);
  return inputs;
}

std::string stem_of(const SceneOptions& options) {
  if (options.from) return options.from->stem().string() + "-again";
  return options.file == standard_stream ? "scene" : options.file.stem().string();
}

std::string scene_words(const SceneOptions& options) {
  std::string words;
  if (options.from) {
    words = "--from " + shell_word(options.from->string());
    if (options.folder) words += " --scene-folder " + shell_word(options.folder->string());
    if (options.changed_files) words += " --changed-files";
  } else {
    words = shell_word(options.file.string());
  }
  for (const std::string& setting : options.settings) words += " --set " + shell_word(setting);
  if (options.allow_outside_files) words += " --allow-outside-files";
  return words;
}

}  // namespace portalens
