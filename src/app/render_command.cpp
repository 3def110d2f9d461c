/// \file
/// `portalens render`: from a scene to a picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <system_error>

#include "app/checkpoint_manager.h"
#include "app/command.h"
#include "app/display_server.h"
#include "app/machine_memory.h"
#include "app/output.h"
#include "app/picture_lock.h"
#include "app/progress_bar.h"
#include "app/render_options.h"
#include "app/report.h"
#include "io/files.h"
#include "io/override.h"
#include "io/read_scene.h"
#include "render/parallel.h"

namespace portalens {
namespace {

/// All who want to know how far the picture is.
class Watchers : public Progress {
 public:
  Watchers(const RenderArguments& arguments, const std::filesystem::path& picture,
           const Exposure& begun) {
    if (arguments.display_server)
      server_.emplace(display_address(*arguments.display_server), picture.string(),
                      begun.assignment().window);
    const Account account = begun.account();
    if (!arguments.quiet && errors_go_to_a_terminal()) bar_.emplace(account.pixels, account.tally);
  }
  void advanced(std::size_t done, std::size_t total, const Tally& tally) override {
    if (bar_) bar_->advanced(done, total, tally);
  }
  void tile_taken(const Window& tile, const Image& film, const Window& window) override {
    if (server_) server_->tile_taken(tile, film, window);
  }
  [[nodiscard]] bool server_went_away() const { return server_ && !server_->connected(); }

 private:
  std::optional<DisplayServer> server_;
  std::optional<ProgressBar> bar_;
};

/// The scene with what the options --width and so on change in it, too.
AskedScene asked_scene(RenderArguments& arguments) {
  AskedScene asked = read_with_settings(arguments.scene);
  keep_shape(arguments, asked.scene);
  Faults faults;
  for (const auto& [key, value] : arguments.overrides)
    override_value(asked.scene, key + "=" + value, faults, place_of_override(key));
  faults.raise();
  return asked;
}

Provenance provenance_of(const AskedScene& asked, const World& world,
                         const RenderArguments& arguments, const RenderOptions& options) {
  Provenance provenance{fingerprint_of(asked.scene, world, options), world_metadata(world, options),
                        scene_words(arguments)};
  if (!options.layers.empty())
    provenance.metadata.emplace_back("portalens:objects", object_list(world));
  Metadata recipe = recipe_metadata(recipe_of(arguments, asked, world, options));
  if (recipe.empty() && !arguments.quiet)
    std::cerr << "note: the picture can't keep how it is made: a name is no UTF-8, or all of it is "
                 "too long\n";
  for (auto& entry : recipe) provenance.metadata.push_back(std::move(entry));
  return provenance;
}

/// Runs the exposure with all who watch it.
std::optional<int> run_watched(const World& world, Exposure& exposure,
                               const RenderArguments& arguments, const RenderOptions& options,
                               const Provenance& provenance, const Keeping& keeping,
                               Signals& signals) {
  Watchers watchers(arguments, keeping.picture, exposure);
  const auto ended = run_kept(world, exposure, options, provenance, keeping, signals, &watchers);
  if (watchers.server_went_away() && !arguments.quiet)
    std::cerr << "note: the display server went away; the picture went on without it\n";
  return ended;
}

/// Writes the result, and takes away the checkpoint and what an interruption showed of the picture;
/// where that fails, the work is kept in one.
RenderResult finish(const Exposure& exposure, const Provenance& provenance,
                    const Keeping& keeping) {
  RenderResult result = result_of(exposure);
  try {
    write_output(keeping.picture, exposure, result, provenance);
  } catch (...) {
    keep_if_possible(keeping, provenance, exposure);
    throw;
  }
  std::error_code ignored;
  if (is_kept(keeping.picture)) {
    std::filesystem::remove(checkpoint_of(keeping.picture), ignored);
    std::filesystem::remove(unfinished(keeping.picture), ignored);
  }
  return result;
}

/// Refuses a picture that the machine has no memory for, and tells what a large one will take.
void look_at_memory(const World& world, const Assignment& assignment,
                    const RenderArguments& arguments) {
  constexpr std::uint64_t large = std::uint64_t{1} << 30;
  std::size_t channels = assignment.takes_layers() ? channel_count(assignment.layers) : 0;
  // A sum takes three doubles, here and in the file: as much as two channels.
  if (!assignment.whole_pixels()) channels += 2 * SampleSum::node_count(assignment.range);
  const int threads =
      arguments.options.threads > 0 ? arguments.options.threads : available_threads();
  const MemoryEstimate estimate =
      estimated_memory(world, assignment.window, channels, threads, assignment.tile_size);
  check_memory(estimate);
  if (!arguments.quiet && (arguments.statistics || estimate.total() > large))
    std::cerr << fmt::format("note: this takes about {} of memory; there are {}\n",
                             memory_text(estimate.total()), memory_text(machine_memory()));
}

/// What of the scene is probably not meant, before a picture is taken of it.
void warn(const World& world) {
  constexpr std::size_t most = 10;
  const std::vector<std::string>& warnings = world.warnings;
  for (std::size_t i = 0; i < std::min(most, warnings.size()); ++i)
    std::cerr << "warning: " << warnings[i] << '\n';
  if (warnings.size() > most)
    std::cerr << fmt::format("warning: and {} more, which check tells\n", warnings.size() - most);
}

/// Where the picture goes.
/// @throws SceneError, WorkError where it can't
std::filesystem::path picture_of(const RenderArguments& arguments) {
  const std::string suffix = arguments.layers.empty() && !arguments.scene.from ? ".png" : ".exr";
  std::filesystem::path picture = arguments.output.value_or(stem_of(arguments.scene) + suffix);
  if (!is_kept(picture) && (arguments.checkpoint || arguments.resume || arguments.restart))
    refuse("a picture for standard output has no checkpoint",
           "name a file with -o, or leave --checkpoint, --resume and --restart out");
  if (!is_part(picture)) check_writable(picture);  // before a scene that takes long to compile
  return picture;
}

/// The exposure to begin with, where the picture may have a checkpoint.
std::unique_ptr<Exposure> begun(const std::filesystem::path& picture,
                                const RenderArguments& arguments, const Provenance& provenance,
                                const Assignment& assignment) {
  if (!is_kept(picture)) return std::make_unique<Exposure>(assignment);
  const Found found = arguments.resume    ? Found::resume
                      : arguments.restart ? Found::restart
                                          : Found::refuse;
  return begun_exposure(checkpoint_of(picture), found, provenance, assignment);
}

int render_scene(RenderArguments& arguments) {
  Signals signals;
  const AskedScene asked = asked_scene(arguments);
  const std::filesystem::path picture = picture_of(arguments);
  const World world = compile_with_options(asked, arguments.scene);
  check_not_an_input(picture, inputs_of(world, arguments.scene));
  const RenderOptions options = asked_options(arguments, asked, world, picture);
  if (asked.recipe && asked.recipe->window && !options.crop && !arguments.quiet)
    std::cerr << "note: that picture was a part; of another size the whole is taken\n";
  const Assignment assignment = assignment_of(world, options);
  if (!arguments.quiet) warn(world);
  check_output(picture, assignment);
  look_at_memory(world, assignment, arguments);
  std::optional<PictureLock> lock;
  if (is_kept(picture)) {
    check_replaceable(checkpoint_of(picture));
    lock.emplace(picture);
  }
  const Provenance provenance = provenance_of(asked, world, arguments, options);
  const auto exposure = begun(picture, arguments, provenance, assignment);

  signals.hold_ends();
  const Keeping keeping{picture, arguments.checkpoint, arguments.quiet,
                        [&](const std::filesystem::path& file, const RenderResult& result) {
                          write_picture(file, result, provenance, Packing::quick);
                        }};
  if (const auto code =
          run_watched(world, *exposure, arguments, options, provenance, keeping, signals))
    return *code;
  tell(finish(*exposure, provenance, keeping), provenance, picture,
       {arguments.quiet, arguments.statistics, arguments.json});
  return exit_done;
}

}  // namespace

void add_render_command(CLI::App& program, Command& chosen) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App& command = *program.add_subcommand("render", "Take the picture of a scene");
  add_render_options(command, *arguments);
  command.callback(
      [arguments, &chosen] { chosen = [arguments] { return render_scene(*arguments); }; });
}

}  // namespace portalens
