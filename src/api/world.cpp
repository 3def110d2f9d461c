#include "portalens/world.h"

#include <utility>

#include "api/access.h"
#include "io/read_scene.h"
#include "world/compile.h"

namespace portalens::api {
namespace {

std::vector<ObjectSummary> objects_of(const Appearance& appearance) {
  std::vector<ObjectSummary> objects;
  for (const Body& body : appearance.bodies)
    objects.push_back({body.name, body.kind, appearance.materials[body.material].name});
  return objects;
}

std::vector<MassSummary> masses_of(const Space& space) {
  std::vector<MassSummary> masses;
  for (const Mass& mass : space.masses)
    masses.push_back({mass.name, mass.gm / space.physics.G, outward(mass.center),
                      mass.horizon_radius, mass.influence, mass.core, mass.horizon});
  return masses;
}

std::vector<PortalSummary> portals_of(const Space& space) {
  std::vector<PortalSummary> list;
  const std::span<const Portal> portals = space.portals.portals();
  for (const Portal& portal : portals)
    list.push_back({portal.name, portals[portal.pair].name, outward(portal.frame.origin),
                    outward(portal.frame.normal)});
  return list;
}

}  // namespace

World::World(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}

int World::width() const { return inside_->world.film.width; }
int World::height() const { return inside_->world.film.height; }

Summary World::summary() const {
  const portalens::World& world = inside_->world;
  Summary summary{world.film.width,       world.film.height,
                  world.sampling.samples, objects_of(world.appearance),
                  masses_of(world.space), portals_of(world.space),
                  world.warnings,         world.remarks};
  summary.notes.insert(summary.notes.end(), inside_->notes.begin(), inside_->notes.end());
  return summary;
}

World compile(const Scene& scene, Files files) {
  return guarded([&] {
    CompileOptions options;
    options.files = files == Files::anywhere ? Containment::anywhere : Containment::scene_folder;
    const portalens::Scene& tables = Access::inside(scene);
    return Access::made({portalens::compile(tables, options), tables.notes});
  });
}

Report check(const Scene& scene, Files files) {
  try {
    return {{}, compile(scene, files).summary()};
  } catch (const Error& error) {
    if (error.cause() == Cause::work) throw;
    return {error.faults(), {}};
  }
}

Report check_file(const std::filesystem::path& file, Files files) {
  try {
    return check(Scene::from_file(file), files);
  } catch (const Error& error) {
    if (error.cause() == Cause::work) throw;
    return {error.faults(), {}};
  }
}

}  // namespace portalens::api
