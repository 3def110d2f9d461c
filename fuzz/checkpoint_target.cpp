// Checkpoints and parts of pictures: any bytes as one, or as several, each beginning with the mark
// that all begin with. They are read, written again, gone on with, merged, and told of.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/checkpoint_manager.h"
#include "app/output.h"
#include "app/report.h"
#include "checkpoint_partials.h"
#include "io/override.h"
#include "io/read_scene.h"
#include "laws.h"
#include "render/merge.h"
#include "render/render.h"
#include "support/scene_folder.h"
#include "target.h"
#include "world/compile.h"

namespace {

using namespace portalens;

/// What is looked into: more is read, but takes too long for a fuzzer.
constexpr std::size_t max_pixels = 1024;
constexpr std::uint64_t max_work = 256;

const SceneFolder& folder() {
  static const SceneFolder made;
  return made;
}

/// A small scene, with the film and the samples of an assignment.
World world_for(const Assignment& assignment) {
  static const Scene plain = read_scene(folder().write(
      "scene.toml",
      "[camera]\nposition = [0, 1, 5]\nlook_at = [0, 0, 0]\n[physics]\nmax_steps = 40\n"
      "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n[[mass]]\ncenter = [2, 0, 0]\nmass = 50\n"));
  Scene scene = plain;
  Faults faults;
  override_value(scene, "film.width=" + std::to_string(assignment.film.width()), faults);
  override_value(scene, "film.height=" + std::to_string(assignment.film.height()), faults);
  override_value(scene, "sampler.samples=" + std::to_string(assignment.samples), faults);
  faults.raise();
  return compile(scene);
}

bool printable(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return (code < 0x20 && letter != '\n') || code == 0x7f;
  });
}

void check_result(const RenderResult& result, const Provenance& provenance) {
  fuzz::check_image(result.image);
  for (const Channel& layer : result.layers)
    fuzz::require(std::all_of(layer.values.begin(), layer.values.end(),
                              [](float value) { return std::isfinite(value); }),
                  "layers are finite");
  fuzz::require(printable(statistics_text(result, provenance)),
                "what a partial picture tells may be given to a terminal");
  fuzz::require(!json_line(statistics_json(result, provenance, "picture.exr")).empty(),
                "it can be told");
  if (result.window.pixels() <= 64) write_picture(folder().path() / "p.exr", result, provenance);
}

/// What stands of it is written again as it was, but for the time.
void check_written(const PartialFile& file, const Exposure& exposure, std::string_view bytes) {
  const PartialHeader& head = file.head();
  const std::string again = encoded_partial(head.provenance, exposure);
  fuzz::require(again.size() == bytes.size(),
                "a partial picture is written again as long as it was");
  const std::size_t body = bytes.size() - head.body_size - fuzz::digest_size;
  fuzz::require(again.substr(body) == bytes.substr(body), "its pixels are written as they were");
  fuzz::require(
      encoded_head(head.provenance, head.assignment, head.account) == fuzz::head_of(bytes),
      "its head is written as it was");
}

std::uint64_t work_left(const Exposure& exposure) {
  std::uint64_t left = 0;
  const Account account = exposure.account();
  for (std::size_t i = 0; i < exposure.tiles().count(); ++i)
    if (!account.complete[i]) left += exposure.work_on(i).total() - exposure.progress(i).done;
  return left;
}

/// A render that finds it goes on to a whole picture.
void go_on(Exposure& exposure, const Provenance& provenance) {
  const Assignment& assignment = exposure.assignment();
  RenderOptions options;
  options.threads = 1;
  expose(world_for(assignment), exposure, options);
  const RenderResult result = result_of(exposure);
  fuzz::require(result.completion == Completion::complete, "what stands can be gone on with");
  if (assignment.whole_pixels()) check_result(result, provenance);
}

/// As `--resume` finds it, by a render of the same kind and by one of another.
void check_resumed(const PartialFile& file, std::string_view bytes) {
  const auto place = folder().write("a.exr.checkpoint", std::string(bytes));
  const Provenance other{{{"the program", "another"}}, {}, "scene.toml"};
  for (const Provenance* provenance : {&file.head().provenance, &other}) try {
      static_cast<void>(begun_exposure(place, Found::resume, *provenance, file.head().assignment));
    } catch (const SceneError& error) {
      fuzz::check_faults(error.faults());
    }
}

std::optional<PartialFile> partial_of(std::string_view bytes) {
  try {
    PartialFile file("a.part", std::string(bytes));
    if (file.head().assignment.window.pixels() > max_pixels) return std::nullopt;
    const auto exposure = file.exposure();
    check_written(file, *exposure, bytes);
    check_resumed(file, bytes);
    check_result(result_of(*exposure), file.head().provenance);
    if (work_left(*exposure) <= max_work) go_on(*exposure, file.head().provenance);
    return file;
  } catch (const SceneError& error) {
    fuzz::check_faults(error.faults());
    return std::nullopt;
  }
}

void check_merged(const std::vector<PartialFile>& parts, const std::optional<Window>& crop) {
  try {
    const auto exposure = merged(parts, crop);
    const RenderResult result = result_of(*exposure);
    fuzz::require(result.completion == Completion::complete, "a merged picture is whole");
    check_result(result, parts.front().head().provenance);
    static_cast<void>(
        PartialFile("m.part", encoded_partial(parts.front().head().provenance, *exposure))
            .exposure());
  } catch (const SceneError& error) {
    fuzz::check_faults(error.faults());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<PartialFile> parts;
  for (const std::string_view bytes : fuzz::partials_in(fuzz::as_text(data, size)))
    if (const auto part = partial_of(bytes)) parts.push_back(*part);
  if (parts.empty()) return 0;
  const Assignment& first = parts.front().head().assignment;
  check_merged(parts, first.window);
  if (first.film.pixels() <= max_pixels) check_merged(parts, std::nullopt);
  return 0;
}
