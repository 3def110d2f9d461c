/// \file
/// From a scene to a world that can be asked; and what is wrong with a scene, as data.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "portalens/error.h"
#include "portalens/scene.h"
#include "portalens/types.h"

namespace portalens::api {

/// Where the pictures and meshes that a scene names may lie.
enum class Files {
  scene_folder,  ///< in the folder of the scene's file, or below it
  anywhere,
};

/// A body with a surface.
struct ObjectSummary {
  std::string name, kind, material;
};

struct MassSummary {
  std::string name;
  double mass = 0.0;  ///< in units by which `physics.G · mass` is length³/time²
  Vec3 center;
  double horizon_radius = 0.0;    ///< length
  double influence_radius = 0.0;  ///< length; beyond it the mass does nothing; may be infinite
  double core_radius = 0.0;       ///< length; 0: a point
  bool horizon = false;           ///< whether it swallows light
};

struct PortalSummary {
  std::string name, pair;
  Vec3 center, normal;  ///< `normal` points out of the front; length 1
};

/// What a world holds.
struct Summary {
  int width = 0, height = 0;  ///< of the picture, pixels
  std::int64_t samples = 0;   ///< a pixel
  std::vector<ObjectSummary> objects;
  std::vector<MassSummary> masses;
  std::vector<PortalSummary> portals;
  std::vector<std::string> warnings;  ///< what is no fault, but probably not meant
  std::vector<std::string> notes;     ///< what is worth knowing besides
};

/// A scene that was understood: ready to be rendered and asked. It never changes, so that any
/// number of threads may use it at once; copies share it.
class World {
 public:
  [[nodiscard]] Summary summary() const;
  /// Of the picture, pixels.
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;

 private:
  friend struct Access;
  struct Inside;
  explicit World(std::shared_ptr<const Inside> inside);
  std::shared_ptr<const Inside> inside_;
};

/// Gives a scene its meaning: reads the files that it names, and prepares what rays are found by.
/// @throws Error (asked) with all the faults of the scene; Error (work) if memory runs out
[[nodiscard]] World compile(const Scene& scene, Files files = Files::scene_folder);

/// What `check` finds.
struct Report {
  std::vector<Fault> faults;  ///< by file and line; a scene with any does not compile
  Summary summary;            ///< empty where there are faults

  [[nodiscard]] bool sound() const { return faults.empty(); }
};

/// As `compile`, with what is wrong as data.
/// @throws Error (work) if memory runs out
[[nodiscard]] Report check(const Scene& scene, Files files = Files::scene_folder);
/// The same for a scene file, with what hinders reading it.
[[nodiscard]] Report check_file(const std::filesystem::path& file,
                                Files files = Files::scene_folder);

}  // namespace portalens::api
