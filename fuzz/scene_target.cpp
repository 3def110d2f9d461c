// Any scene at all, from its text to a picture of 8 x 8 pixels: what the text says is kept, but the
// work is bounded. Text that begins with "#obj" is of the dialect, all other is TOML. Beside the
// scene lie a picture.exr and a mesh.obj, which it may name.
#include <cmath>
#include <numeric>
#include <string>
#include <string_view>

#include "app/describe.h"
#include "gravity/coupling.h"
#include "io/image.h"
#include "io/override.h"
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

// Deeper paths and finer maps cost more than a fuzzer has, and tell no more.
constexpr std::int64_t deepest = 2, finest_map = 8, max_steps = 200;
/// Pulls of a mass, at one place each for all steps of a photon: with the sanitizers some tenths of
/// a second for all photons of the picture.
constexpr double max_pulls = 1200;

/// Holds a whole number of the physics at or below `most`; what is none is left to be refused.
void hold(Scene& scene, const char* key, std::int64_t most, std::int64_t unsaid, Faults& faults) {
  std::int64_t asked = unsaid;
  if (const Value* value = scene.physics.find(key)) {
    const auto* number = std::get_if<std::int64_t>(&value->data);
    if (!number) return;
    asked = *number;
  }
  if (asked > most)
    override_value(scene, std::string("physics.") + key + "=" + std::to_string(most), faults);
}

/// The scene as it is but for what bounds the work.
Scene bounded(const std::filesystem::path& file) {
  Scene scene = read_scene(file);
  Faults faults;
  const Physics unsaid;
  hold(scene, "portal_gravity_depth", deepest, unsaid.portal_gravity_depth, faults);
  hold(scene, "graviton_resolution", finest_map, unsaid.graviton_resolution, faults);
  hold(scene, "max_steps", max_steps, unsaid.max_steps, faults);
  for (const char* setting :
       {"film.width=8", "film.height=8", "sampler.samples=1", "shading.max_bounces=2",
        "shading.max_crossings=8", "shading.shadow_samples=1"})
    override_value(scene, setting, faults);
  faults.raise();
  return scene;
}

/// What the field costs at one place, in pulls of a mass.
double cost_of_a_place(const Space& space) {
  const Physics& physics = space.physics;
  const CouplingCost cost = estimated_cost(
      physics.portal_gravity, {space.portals.portals(), space.masses, physics.min_force,
                               static_cast<int>(physics.portal_gravity_depth),
                               static_cast<int>(physics.graviton_resolution)});
  return 1.0 + static_cast<double>(space.masses.size()) + cost.each_call;
}

/// Compiled, with as many steps a photon as its field allows.
World affordable(Scene scene) {
  World world = compile(scene);
  const auto steps = static_cast<std::int64_t>(max_pulls / cost_of_a_place(world.space)) + 1;
  if (steps >= world.space.physics.max_steps) return world;
  Faults faults;
  override_value(scene, "physics.max_steps=" + std::to_string(steps), faults);
  return compile(scene);
}

void check_picture(const RenderResult& result) {
  fuzz::check_image(result.image);
  const auto& fates = result.tally.fates;
  fuzz::require(
      std::accumulate(fates.begin(), fates.end(), std::uint64_t{0}) == result.tally.photons,
      "every photon has one fate");
  fuzz::require(result.tally.samples == 64, "every pixel has its sample");
}

/// The picture by one engine or the other, as the text's length is even or odd; layers are always
/// taken by the scalar one, and so beside the lanes.
void take(const World& world, std::string_view text) {
  RenderOptions options;
  options.threads = 1;
  if (text.size() % 2 == 0)
    options.layers = {Layer::depth, Layer::normal, Layer::albedo, Layer::order};
  else
    options.engine = Engine::scalar;
  check_picture(render(world, options));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::as_text(data, size));
  const char* name = text.rfind("#obj", 0) == 0 ? "scene.obj" : "scene.toml";
  try {
    const Scene scene = bounded(folder().write(name, text));
    const World world = affordable(scene);
    fuzz::require(!json_line(describe_json(scene, world)).empty(), "a scene can be described");
    static_cast<void>(describe_text(scene, world));
    take(world, text);
  } catch (const SceneError& error) {
    fuzz::check_faults(error.faults());
  }
  return 0;
}
