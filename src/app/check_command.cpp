/// \file
/// `portalens check`: whether a scene is right, and what it holds.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "app/command.h"
#include "app/describe.h"
#include "app/scene_options.h"

namespace portalens {

void add_check_command(CLI::App& program, Command& chosen) {
  struct CheckArguments {
    SceneOptions scene;
    bool json = false;
  };
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App& command = *program.add_subcommand("check", "Validate a scene and describe it");
  add_scene_options(command, arguments->scene);
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments, &chosen] {
    chosen = [arguments] {
      const AskedScene asked = read_with_settings(arguments->scene);
      const World world = compile_with_options(asked, arguments->scene);
      if (arguments->json)
        std::cout << json_line(describe_json(asked.scene, world)) << '\n';
      else
        std::cout << describe_text(asked.scene, world);
      return static_cast<int>(exit_done);
    };
  });
}

}  // namespace portalens
