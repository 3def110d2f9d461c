// Any scene at all, from its text to a picture of 8 x 8 pixels: what the text says is kept, but the
// work is bounded. Text that begins with "#obj" is of the dialect, all other is TOML. Beside the
// scene lie a picture.exr and a mesh.obj, which it may name.
#include <cmath>
#include <numeric>
#include <string>

#include "app/describe.h"
#include "io/image.h"
#include "io/read_scene.h"
#include "laws.h"
#include "render/layers.h"
#include "render/render.h"
#include "support/scene_folder.h"
#include "target.h"
#include "world/compile.h"

namespace {

using namespace portalens;

/// The scene's folder, with the files that scenes name.
const SceneFolder& folder() {
  static const SceneFolder made;
  static const bool filled = [] {
    write_image(made.path() / "picture.exr", 2, 2,
                {{"R", {0, 1, 2, 3}}, {"G", {1, 1, 0, 0}}, {"B", {0, 0, 1, 9}}}, {});
    made.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 2 4 3\n");
    return true;
  }();
  static_cast<void>(filled);
  return made;
}

/// Paths through more portals than that cost more than a fuzzer has: 64 photons take seconds.
constexpr std::int64_t deepest = 2;

/// The scene as it is but for what bounds the work.
Scene bounded(const std::filesystem::path& file) {
  Scene scene = read_scene(file);
  Faults faults;
  if (const Value* depth = scene.physics.find("portal_gravity_depth"))
    if (const auto* number = std::get_if<std::int64_t>(&depth->data); number && *number > deepest)
      override_value(scene, "physics.portal_gravity_depth=" + std::to_string(deepest), faults);
  for (const char* setting :
       {"film.width=8", "film.height=8", "sampler.samples=1", "physics.max_steps=200",
        "shading.max_bounces=2", "shading.max_crossings=8", "shading.shadow_samples=1"})
    override_value(scene, setting, faults);
  faults.raise();
  return scene;
}

void check_picture(const RenderResult& result) {
  fuzz::check_image(result.image);
  const auto& fates = result.tally.fates;
  fuzz::require(
      std::accumulate(fates.begin(), fates.end(), std::uint64_t{0}) == result.tally.photons,
      "every photon has one fate");
  fuzz::require(result.tally.samples == 64, "every pixel has its sample");
}

void take(const World& world, Engine engine) {
  RenderOptions options;
  options.threads = 1;
  options.engine = engine;
  options.layers = {Layer::depth, Layer::normal, Layer::albedo, Layer::order};
  check_picture(render(world, options));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::as_text(data, size));
  const char* name = text.rfind("#obj", 0) == 0 ? "scene.obj" : "scene.toml";
  try {
    const Scene scene = bounded(folder().write(name, text));
    const World world = compile(scene);
    fuzz::require(!json_line(describe_json(scene, world)).empty(), "a scene can be described");
    static_cast<void>(describe_text(scene, world));
    take(world, Engine::automatic);
    take(world, Engine::scalar);
  } catch (const SceneError& error) {
    fuzz::check_faults(error.faults());
  }
  return 0;
}
