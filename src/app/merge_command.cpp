/// \file
/// `portalens merge`: a picture from parts that were taken by several renders.
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "app/command.h"
#include "app/output.h"
#include "app/render_options.h"
#include "render/merge.h"

namespace portalens {
namespace {

struct MergeArguments {
  std::vector<std::filesystem::path> parts;
  std::filesystem::path output;
  std::vector<int> crop;
  Telling telling;
};

int merge_parts(const MergeArguments& arguments) {
  std::vector<PartialFile> parts;
  for (const std::filesystem::path& file : arguments.parts) parts.emplace_back(file);
  std::optional<Window> crop;
  if (!arguments.crop.empty())
    crop = checked_crop(arguments.crop, parts.front().head().assignment.film);
  Assignment wanted = parts.front().head().assignment;
  wanted.range = {0, wanted.samples};
  check_not_an_input(arguments.output, arguments.parts);
  check_output(arguments.output, wanted);
  const auto exposure = merged(parts, crop);
  const RenderResult result = result_of(*exposure);
  const Provenance& provenance = parts.front().head().provenance;
  write_output(arguments.output, *exposure, result, provenance);
  tell(result, provenance, arguments.output, arguments.telling);
  return exit_done;
}

}  // namespace

void add_merge_command(CLI::App& program, Command& chosen) {
  const auto arguments = std::make_shared<MergeArguments>();
  CLI::App& command = *program.add_subcommand("merge", "Put the parts of a picture together");
  command
      .add_option("parts", arguments->parts,
                  "Parts, in any order: what render -o NAME.part wrote with --crop or "
                  "--samples-from and --samples-to")
      ->required()
      ->type_name("PART");
  command
      .add_option("-o,--output", arguments->output,
                  "Picture to write: .png, .jpg, .exr or .part, or - for standard output, as PNG")
      ->required()
      ->type_name("FILE");
  add_crop_option(command, arguments->crop,
                  "The parts make up only the pixels X0 <= x < X1, Y0 <= y < Y1 of the picture");
  command.add_flag("-q,--quiet", arguments->telling.quiet, "Print nothing but faults");
  command.add_flag("--stats", arguments->telling.statistics, "Print what all parts took");
  command.add_flag("--json", arguments->telling.json, "Print what they took, as one JSON object");
  command.callback(
      [arguments, &chosen] { chosen = [arguments] { return merge_parts(*arguments); }; });
}

}  // namespace portalens
