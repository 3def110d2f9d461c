#include "portalens/trace.h"

#include "api/access.h"
#include "geometry/rays.h"
#include "render/parallel.h"
#include "render/trace.h"

namespace portalens::api {
namespace {

std::optional<portalens::Ray> inward(const Ray& ray) {
  const Vec3 &x = ray.origin, &t = ray.direction;
  return ray_of({x.x, x.y, x.z, t.x, t.y, t.z});
}

/// The photons of the rays; all that are none are told at once.
std::vector<Photon> photons_of(std::span<const Ray> rays) {
  std::vector<Photon> photons;
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (const auto ray = inward(rays[i])) {
      photons.emplace_back();
      photons.back().position = ray->origin;
      photons.back().direction = ray->direction;
    } else {
      faults.push_back(
          {"", 0,
           "ray " + std::to_string(i) + " has a zero direction, or a number that is not finite",
           "an origin and a direction of finite numbers are needed"});
    }
  }
  if (!faults.empty()) throw Error(Cause::asked, std::move(faults));
  return photons;
}

Trace outward(const portalens::World& world, const portalens::Trace& found, bool with_path) {
  Trace trace;
  const Arrival& end = found.end;
  trace.fate = static_cast<Fate>(end.fate);
  trace.object = name_of_met(world, end);
  trace.position = api::outward(end.position);
  trace.direction = api::outward(end.direction);
  trace.length = end.length;
  trace.turning = end.turning;
  trace.steps = end.steps;
  for (const std::uint32_t portal : found.path_trace.crossings)
    trace.crossings.push_back(world.space.portals.portals()[portal].name);
  for (const Arrival& bounce : found.bounces)
    trace.bounces.push_back({name_of_met(world, bounce), api::outward(bounce.position),
                             api::outward(bounce.direction), bounce.length, bounce.turning});
  if (!with_path) return trace;
  for (const std::vector<Vec3d>& stretch : found.path_trace.stretches) {
    std::vector<Vec3>& points = trace.path.emplace_back();
    for (const Vec3d& point : stretch) points.push_back(api::outward(point));
  }
  return trace;
}

}  // namespace

std::vector<Trace> trace(const World& world, std::span<const Ray> rays,
                         const TraceOptions& options) {
  return guarded([&] {
    check_threads(options.threads);
    if (options.bounces < 0)
      throw asked(std::to_string(options.bounces) + " bounces", "0 or more are possible");
    const portalens::World& scene = inside(world);
    const std::vector<Photon> photons = photons_of(rays);
    std::vector<Trace> traces(photons.size());
    const auto work = [&](std::size_t i) {
      traces[i] = outward(scene, trace_ray(scene, photons[i], options.bounces), options.path);
    };
    parallel_for(photons.size(), options.threads > 0 ? options.threads : available_threads(), work,
                 [] { return false; });
    return traces;
  });
}

Trace trace(const World& world, const Ray& ray, const TraceOptions& options) {
  TraceOptions alone = options;
  alone.threads = 1;
  return std::move(trace(world, std::span(&ray, 1), alone).front());
}

std::vector<Ray> fan(const Ray& middle, Vec3 across, double spread, int count) {
  return guarded([&] {
    const auto ray = inward(middle);
    const Vec3d axis = api::inward(across);
    if (!ray || !is_finite(axis) || !(spread >= 0.0 && spread <= 360.0) || count < 1)
      throw asked(
          "this is no fan of rays",
          "finite numbers, a direction that is not zero, a spread of 0 to 360 degrees and a "
          "count of at least 1 are needed");
    std::vector<Ray> rays;
    for (const portalens::Ray& one : fan_of(*ray, axis, spread, count))
      rays.push_back({api::outward(one.origin), api::outward(one.direction)});
    return rays;
  });
}

Ray camera_ray(const World& world, double x, double y) {
  const portalens::World& scene = inside(world);
  const portalens::Ray ray = scene.camera.ray(x, y, scene.film.width, scene.film.height);
  return {api::outward(ray.origin), api::outward(ray.direction)};
}

}  // namespace portalens::api
