#include "app/trace_ray.h"

#include <fmt/format.h>

#include <numbers>

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

Rgb sum_of(const std::vector<Rgb>& lights) {
  Rgb sum;
  for (const Rgb& light : lights) sum += light;
  return sum;
}

std::string place(Vec3d v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }

std::string length_and_turning(double length, double turning) {
  return fmt::format("length {:.6g}, turned {:.6g} rad ({:.4g} degrees)", length, turning,
                     turning * 180.0 / std::numbers::pi);
}

Json name_or_null(const std::string& name) { return name.empty() ? Json() : Json(name); }

std::string light_text(Rgb light) {
  return fmt::format("light {:.6g} {:.6g} {:.6g}", light.x, light.y, light.z);
}

/// Each layer under its name, in the float of the picture.
Json layers_json(const FirstHit& sight) {
  Json json = Json::object();
  for (int i = 0; i < layer_count; ++i) {
    const std::vector<float> values = channel_values(sight, static_cast<Layer>(i));
    json[std::string(layer_names[i])] = values.size() == 1 ? Json(values.front()) : Json(values);
  }
  return json;
}

Json bounces_json(const World& world, const Trace& trace) {
  Json bounces = Json::array();
  for (std::size_t i = 0; i < trace.bounces.size(); ++i) {
    const Arrival& bounce = trace.bounces[i];
    Json& json = bounces.emplace_back(Json{{"object", name_or_null(name_of_met(world, bounce))},
                                           {"position", to_json(bounce.position)},
                                           {"direction", to_json(bounce.direction)},
                                           {"length", bounce.length},
                                           {"turning", bounce.turning}});
    if (trace.view) json["light"] = to_json(trace.view->contributions[i]);
  }
  return bounces;
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
  trace.view->sight = first_hit_of(world, arrival, trace.path_trace);
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

Json trace_json(const World& world, const Trace& trace, int max_bounces, PathOutput path) {
  const Arrival& end = trace.end;
  Json crossings = Json::array();
  for (const std::uint32_t portal : trace.path_trace.crossings)
    crossings.push_back(world.space.portals.portals()[portal].name);
  Json json = {{"fate", fate_names[static_cast<std::size_t>(end.fate)]},
               {"object", name_or_null(name_of_met(world, end))},
               {"position", to_json(end.position)},
               {"direction", to_json(end.direction)},
               {"length", end.length},
               {"turning", end.turning},
               {"crossings", crossings},
               {"steps", end.steps}};
  if (max_bounces > 0 || trace.view) json["bounces"] = bounces_json(world, trace);
  if (trace.view) {
    const Vec3d x = trace.start.position, t = trace.start.direction;
    json["ray"] = {x.x, x.y, x.z, t.x, t.y, t.z};
    json["light"] = to_json(sum_of(trace.view->contributions));
    json["layers"] = layers_json(trace.view->sight);
  }
  if (path == PathOutput::included) {
    Json& stretches = json["path"] = Json::array();
    for (const std::vector<Vec3d>& stretch : trace.path_trace.stretches) {
      Json& points = stretches.emplace_back(Json::array());
      for (const Vec3d& point : stretch) points.push_back(to_json(point));
    }
  }
  return json;
}

std::string trace_text(const World& world, const Trace& trace, PathOutput path) {
  const Arrival& end = trace.end;
  const std::string name = name_of_met(world, end);
  std::string text;
  if (trace.view)
    text += fmt::format("from {} towards {}\n", place(trace.start.position),
                        place(trace.start.direction));
  for (std::size_t i = 0; i < trace.bounces.size(); ++i) {
    const Arrival& bounce = trace.bounces[i];
    text += fmt::format("bounce {} at {}; {}{}\n", name_of_met(world, bounce),
                        place(bounce.position), length_and_turning(bounce.length, bounce.turning),
                        trace.view ? "; " + light_text(trace.view->contributions[i]) : "");
  }
  text += fmt::format("{}{} at {} towards {}; {}; {} steps",
                      fate_names[static_cast<std::size_t>(end.fate)],
                      name.empty() ? "" : " " + name, place(end.position), place(end.direction),
                      length_and_turning(end.length, end.turning), end.steps);
  for (std::size_t i = 0; i < trace.path_trace.crossings.size(); ++i)
    text += (i == 0 ? "; through " : ", ") +
            world.space.portals.portals()[trace.path_trace.crossings[i]].name;
  if (trace.view) {
    text += "; " + light_text(trace.view->contributions.back());
    if (trace.view->sight.order > 0)
      text += fmt::format("; image of order {}", trace.view->sight.order);
  }
  text += '\n';
  if (path == PathOutput::included)
    for (std::size_t i = 0; i < trace.path_trace.stretches.size(); ++i) {
      text += fmt::format("  stretch {}\n", i);
      for (const Vec3d& point : trace.path_trace.stretches[i])
        text += fmt::format("    {:.9g} {:.9g} {:.9g}\n", point.x, point.y, point.z);
    }
  return text;
}

}  // namespace portalens
