/// \file
/// What is inside the values of the public headers, and how the library's own errors become theirs.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "math/vec3.h"
#include "portalens/error.h"
#include "portalens/scene.h"
#include "portalens/types.h"
#include "portalens/world.h"
#include "scene/scene.h"
#include "world/world.h"

namespace portalens::api {

struct Scene::Inside {
  portalens::Scene scene;
};

struct World::Inside {
  portalens::World world;
  std::vector<std::string> notes;  ///< of the scene's reader
};

/// The one who may look.
struct Access {
  [[nodiscard]] static portalens::Scene& inside(Scene& scene) { return scene.inside_->scene; }
  [[nodiscard]] static const portalens::Scene& inside(const Scene& scene) {
    return scene.inside_->scene;
  }
  [[nodiscard]] static const World::Inside& inside(const World& world) { return *world.inside_; }
  [[nodiscard]] static Scene made(portalens::Scene scene) {
    Scene result;
    result.inside_->scene = std::move(scene);
    return result;
  }
  [[nodiscard]] static World made(World::Inside world) {
    return World(std::make_shared<const World::Inside>(std::move(world)));
  }
};

[[nodiscard]] inline const portalens::World& inside(const World& world) {
  return Access::inside(world).world;
}

[[nodiscard]] inline Vec3 outward(Vec3d v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline Vec3d inward(Vec3 v) { return {v.x, v.y, v.z}; }

/// The same faults as others see them.
[[nodiscard]] std::vector<Fault> outward(const std::vector<portalens::Fault>& faults);

/// A fault of what was asked for.
[[nodiscard]] Error asked(std::string problem, std::string remedy);

/// @throws Error (asked) unless it is 0 or a number of threads that a machine may have
void check_threads(int threads);

/// Runs `work`; what it throws becomes an `Error`.
template <class Work>
auto guarded(const Work& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const SceneError& error) {
    throw Error(Cause::asked, outward(error.faults()));
  } catch (const std::bad_alloc&) {
    throw Error(Cause::work,
                {{"", 0, "out of memory", "a smaller picture, mesh or texture would need less"}});
  } catch (const std::exception& error) {
    throw Error(Cause::work, {{"", 0, error.what(), ""}});
  }
}

}  // namespace portalens::api
