#include "app/trace_ray.h"

#include <fmt/format.h>

#include <numbers>

#include "shading/reflection.h"
#include "shading/shading_point.h"

namespace portalens {
namespace {

/// Appends the way after a bounce: it goes on in the stretch in which it was.
void append(Journey& journey, const Journey& more) {
  std::vector<Vec3d>& last = journey.stretches.back();
  const std::vector<Vec3d>& first = more.stretches.front();
  last.insert(last.end(), first.begin() + (first.empty() ? 0 : 1), first.end());
  journey.stretches.insert(journey.stretches.end(), more.stretches.begin() + 1,
                           more.stretches.end());
  journey.crossings.insert(journey.crossings.end(), more.crossings.begin(), more.crossings.end());
}

std::string place(Vec3d v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }

std::string length_and_turning(double length, double turning) {
  return fmt::format("length {:.6g}, turned {:.6g} rad ({:.4g} degrees)", length, turning,
                     turning * 180.0 / std::numbers::pi);
}

Json name_or_null(const std::string& name) { return name.empty() ? Json() : Json(name); }

}  // namespace

Trace trace_ray(const World& world, Vec3d position, Vec3d direction, int most_bounces) {
  Trace trace;
  Photon photon;
  photon.position = position;
  photon.direction = direction;
  trace.end = advance_recorded(world.space, photon, trace.journey);
  for (int i = 0; i < most_bounces && trace.end.fate == Fate::hit; ++i) {
    const ShadingPoint point = shading_point(world.space, world.appearance, trace.end);
    const auto mirrored = reflect(trace.end.direction, point.normal, 0.0, 0.0, 0.0);
    if (!mirrored) break;
    trace.bounces.push_back(trace.end);
    photon.position = point.position;
    photon.direction = mirrored->direction;
    photon.departure = point.leaving(photon.direction);
    Journey more;
    Arrival next = advance_recorded(world.space, photon, more);
    append(trace.journey, more);
    next.length += trace.end.length;
    next.turning += trace.end.turning;
    next.steps += trace.end.steps;
    trace.end = next;
  }
  return trace;
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

Json trace_json(const World& world, const Trace& trace, int most_bounces, PathOutput path) {
  const Arrival& end = trace.end;
  Json crossings = Json::array();
  for (const std::uint32_t portal : trace.journey.crossings)
    crossings.push_back(world.space.portals.portals()[portal].name);
  Json json = {{"fate", fate_names[static_cast<std::size_t>(end.fate)]},
               {"object", name_or_null(name_of_met(world, end))},
               {"position", to_json(end.position)},
               {"direction", to_json(end.direction)},
               {"length", end.length},
               {"turning", end.turning},
               {"crossings", crossings},
               {"steps", end.steps}};
  if (most_bounces > 0) {
    Json& bounces = json["bounces"] = Json::array();
    for (const Arrival& bounce : trace.bounces)
      bounces.push_back({{"object", name_or_null(name_of_met(world, bounce))},
                         {"position", to_json(bounce.position)},
                         {"direction", to_json(bounce.direction)},
                         {"length", bounce.length},
                         {"turning", bounce.turning}});
  }
  if (path == PathOutput::included) {
    Json& stretches = json["path"] = Json::array();
    for (const std::vector<Vec3d>& stretch : trace.journey.stretches) {
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
  for (const Arrival& bounce : trace.bounces)
    text += fmt::format("bounce {} at {}; {}\n", name_of_met(world, bounce), place(bounce.position),
                        length_and_turning(bounce.length, bounce.turning));
  text += fmt::format("{}{} at {} towards {}; {}; {} steps",
                      fate_names[static_cast<std::size_t>(end.fate)],
                      name.empty() ? "" : " " + name, place(end.position), place(end.direction),
                      length_and_turning(end.length, end.turning), end.steps);
  for (std::size_t i = 0; i < trace.journey.crossings.size(); ++i)
    text += (i == 0 ? "; through " : ", ") +
            world.space.portals.portals()[trace.journey.crossings[i]].name;
  text += '\n';
  if (path == PathOutput::included)
    for (std::size_t i = 0; i < trace.journey.stretches.size(); ++i) {
      text += fmt::format("  stretch {}\n", i);
      for (const Vec3d& point : trace.journey.stretches[i])
        text += fmt::format("    {:.9g} {:.9g} {:.9g}\n", point.x, point.y, point.z);
    }
  return text;
}

}  // namespace portalens
