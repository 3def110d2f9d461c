#include "render/trace.h"

#include "shading/reflection.h"
#include "shading/shade.h"
#include "shading/shading_point.h"

namespace portalens {
namespace {

/// Appends the path after a bounce: it goes on in the stretch in which it was.
void append(PathTrace& path_trace, const PathTrace& more) {
  std::vector<Vec3d>& last = path_trace.stretches.back();
  const std::vector<Vec3d>& first = more.stretches.front();
  last.insert(last.end(), first.begin() + (first.empty() ? 0 : 1), first.end());
  path_trace.stretches.insert(path_trace.stretches.end(), more.stretches.begin() + 1,
                              more.stretches.end());
  path_trace.crossings.insert(path_trace.crossings.end(), more.crossings.begin(),
                              more.crossings.end());
}

/// Advances a photon that leaves the trace's end, which becomes a bounce.
/// @return the arrival, counted from that bounce
Arrival go_on(const PlannedSpace& space, const Photon& photon, Trace& trace) {
  PathTrace more;
  const Arrival arrival = advance_recorded(space, photon, more);
  append(trace.path_trace, more);
  trace.bounces.push_back(trace.end);
  Arrival next = arrival;
  next.length += trace.end.length;
  next.turning += trace.end.turning;
  next.steps += trace.end.steps;
  trace.end = next;
  return arrival;
}

Rgb light_of(const Space& space, const ShadeOutput& found) {
  Rgb light;
  for (const Contribution& contribution : found.light) light += contribution.radiance;
  for (const ShadowQuery& query : found.shadows)
    if (visible(space, query)) light += query.contribution;
  return light;
}

}  // namespace

Trace trace_ray(const World& world, const Photon& start, int max_bounces) {
  Trace trace;
  trace.start = start;
  Photon photon = start;
  trace.end = advance_recorded(world.space, photon, trace.path_trace);
  for (int i = 0; i < max_bounces && trace.end.fate == Fate::hit; ++i) {
    const ShadingPoint point = shaded_surface(world.space, world.appearance, trace.end).point;
    const auto mirrored = reflect(trace.end.direction, point.normal, 0.0, 0.0, 0.0);
    if (!mirrored) break;
    photon.position = point.position;
    photon.direction = mirrored->direction;
    photon.guard = point.leaving(photon.direction);
    go_on(world.space, photon, trace);
  }
  return trace;
}

Trace trace_pixel(const World& world, const Photon& start, int max_bounces) {
  Trace trace;
  trace.start = start;
  Photon photon = start;
  Arrival arrival = advance_recorded(world.space, photon, trace.path_trace);
  trace.end = arrival;
  trace.view.emplace();
  trace.view->first_hit = first_hit_of(world, arrival, trace.path_trace);
  for (int i = 0;; ++i) {
    ShadeOutput found;
    shade(world.space, world.appearance, {&photon, 1}, {&arrival, 1}, found);
    trace.view->contributions.push_back(light_of(world.space, found));
    if (found.secondary.empty() || i == max_bounces) return trace;
    photon = found.secondary.front();
    arrival = go_on(world.space, photon, trace);
  }
}

std::string name_of_met(const World& world, const Arrival& arrival) {
  switch (arrival.met) {
    case Met::surface:
      return world.appearance.bodies[arrival.object].name;
    case Met::portal_back:
      return world.space.portals.portals()[arrival.object].name;
    case Met::mass:
      return world.space.masses[arrival.object].name;
    case Met::nothing:
      break;
  }
  return {};
}

}  // namespace portalens
