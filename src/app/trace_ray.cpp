#include "app/trace_ray.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/beyond.h"

namespace portalens {
namespace {

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

/// What a lost photon ran out of; empty if it is not lost.
std::string why_lost(const World& world, const Arrival& end) {
  const Physics& physics = world.space.physics;
  if (end.fate != Fate::lost) return "";
  if (end.out_of_crossings)
    return fmt::format("it had crossed shading.max_crossings = {} portals",
                       world.space.max_crossings);
  if (end.steps >= physics.max_steps)
    return fmt::format("it took physics.max_steps = {} steps", physics.max_steps);
  if (end.length > physics.max_length)
    return fmt::format("it went further than physics.max_length = {:g}", physics.max_length);
  return "it came where a pull has no bound";
}

/// What the end of influences has taken from the turning; empty if that is next to nothing.
std::string cut_text(const World& world, const Trace& trace, double missing) {
  constexpr double least_share = 0.001;
  const double least = 2.0 * world.space.physics.tolerance;
  if (std::fabs(missing) < std::max(least, least_share * trace.end.turning)) return "";
  return fmt::format("; pulls without end (physics.min_force = 0) would turn it by {:.3g} rad {}",
                     std::fabs(missing), missing > 0.0 ? "more" : "less");
}

Json name_or_null(const std::string& name) { return name.empty() ? Json() : Json(name); }

std::string light_text(Rgb light) {
  return fmt::format("light {:.6g} {:.6g} {:.6g}", light.x, light.y, light.z);
}

/// Each layer under its name, in the float of the picture.
Json layers_json(const FirstHit& first_hit) {
  Json json = Json::object();
  for (int i = 0; i < layer_count; ++i) {
    const std::vector<float> values = channel_values(first_hit, static_cast<Layer>(i));
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

Json trace_json(const World& world, const Trace& trace, std::optional<double> missing,
                int max_bounces, PathOutput path) {
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
  if (missing) json["cut_turning"] = *missing;
  if (end.fate == Fate::lost) json["because"] = why_lost(world, end);
  if (const auto camera = beyond(world, trace)) json["camera_beyond"] = to_json(*camera);
  if (max_bounces > 0 || trace.view) json["bounces"] = bounces_json(world, trace);
  if (trace.view) {
    const Vec3d x = trace.start.position, t = trace.start.direction;
    json["ray"] = {x.x, x.y, x.z, t.x, t.y, t.z};
    json["light"] = to_json(sum_of(trace.view->contributions));
    json["layers"] = layers_json(trace.view->first_hit);
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

std::string trace_text(const World& world, const Trace& trace, std::optional<double> missing,
                       PathOutput path) {
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
    if (trace.view->first_hit.order > 0)
      text += fmt::format("; image of order {}", trace.view->first_hit.order);
  }
  if (end.fate == Fate::lost) text += "; lost because " + why_lost(world, end);
  if (missing) text += cut_text(world, trace, *missing);
  text += '\n';
  if (const auto camera = beyond(world, trace))
    text += "a camera that goes through stands at\n" + as_toml(*camera, "  ");
  if (path == PathOutput::included)
    for (std::size_t i = 0; i < trace.path_trace.stretches.size(); ++i) {
      text += fmt::format("  stretch {}\n", i);
      for (const Vec3d& point : trace.path_trace.stretches[i])
        text += fmt::format("    {:.9g} {:.9g} {:.9g}\n", point.x, point.y, point.z);
    }
  return text;
}

}  // namespace portalens
