#include "app/scene_options.h"

#include <CLI/CLI.hpp>

#include "io/override.h"
#include "io/read_scene.h"
#include "world/compile.h"

namespace portalens {

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command.add_option("scene", options.file, "Scene file: TOML, or the OBJ dialect")
      ->required()
      ->type_name("SCENE");
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

Scene read_with_settings(const SceneOptions& options) {
  Scene scene = read_scene(options.file);
  Faults faults;
  for (const std::string& setting : options.settings) override_value(scene, setting, faults);
  faults.raise();
  return scene;
}

World compile_with_options(const Scene& scene, const SceneOptions& options) {
  CompileOptions compile_options;
  compile_options.files =
      options.allow_outside_files ? Containment::anywhere : Containment::scene_folder;
  return compile(scene, compile_options);
}

}  // namespace portalens
