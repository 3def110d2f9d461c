#include "render/layers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/camera_photon.h"
#include "shading/shading_point.h"

namespace portalens {
namespace {

double angle_between(Vec3d a, Vec3d b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

/// Whole half turns about `center`, counted anew in each stretch: where nothing bends there are
/// none, however many portals are crossed.
double half_turns(Vec3d center, const Arrival& arrival, const PathTrace& path_trace) {
  double turns = 0.0;
  for (std::size_t s = 0; s < path_trace.stretches.size(); ++s) {
    const std::vector<Vec3d>& stretch = path_trace.stretches[s];
    double angle = 0.0;
    for (std::size_t i = 1; i < stretch.size(); ++i)
      angle += angle_between(stretch[i - 1] - center, stretch[i] - center);
    if (s + 1 == path_trace.stretches.size() && arrival.fate == Fate::escaped)
      angle += angle_between(arrival.position - center, arrival.direction);
    turns += std::floor(angle / std::numbers::pi);
  }
  return turns;
}

std::uint32_t object_of(const World& world, const Arrival& arrival) {
  const std::size_t bodies = world.appearance.bodies.size();
  const std::size_t portals = world.space.portals.portals().size();
  switch (arrival.met) {
    case Met::nothing:
      return 0;
    case Met::surface:
      return 1 + arrival.object;
    case Met::portal_back:
      return static_cast<std::uint32_t>(1 + bodies + arrival.object);
    case Met::mass:
      return static_cast<std::uint32_t>(1 + bodies + portals + arrival.object);
  }
  return 0;
}

std::vector<float> three(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::vector<float> raw_values(const FirstHit& first_hit, Layer layer) {
  switch (layer) {
    case Layer::depth:
      return {static_cast<float>(first_hit.depth)};
    case Layer::normal:
      return three(first_hit.normal);
    case Layer::albedo:
      return three(first_hit.albedo);
    case Layer::object:
      return {static_cast<float>(first_hit.object)};
    case Layer::fate:
      return {static_cast<float>(first_hit.fate)};
    case Layer::steps:
      return {static_cast<float>(first_hit.steps)};
    case Layer::turning:
      return {static_cast<float>(first_hit.turning)};
    case Layer::crossings:
      return {static_cast<float>(first_hit.crossings)};
    case Layer::order:
      return {static_cast<float>(first_hit.order)};
    case Layer::position:
      return three(first_hit.position);
  }
  return {};
}

}  // namespace

std::vector<std::string> channel_names(Layer layer) {
  switch (layer) {
    case Layer::depth:
      return {"depth.Z"};
    case Layer::normal:
      return {"N.X", "N.Y", "N.Z"};
    case Layer::albedo:
      return {"albedo.R", "albedo.G", "albedo.B"};
    case Layer::position:
      return {"P.X", "P.Y", "P.Z"};
    case Layer::object:
    case Layer::fate:
    case Layer::steps:
    case Layer::turning:
    case Layer::crossings:
    case Layer::order:
      break;
  }
  return {std::string(layer_names[static_cast<std::size_t>(layer)]) + ".X"};
}

std::vector<float> channel_values(const FirstHit& first_hit, Layer layer) {
  std::vector<float> values = raw_values(first_hit, layer);
  for (float& value : values)
    if (!std::isfinite(value)) value = 0.0f;
  return values;
}

std::uint32_t image_order(std::span<const Mass> masses, const Arrival& arrival,
                          const PathTrace& path_trace) {
  double most = 0.0;
  for (const Mass& mass : masses)
    if (mass.gm > 0.0) most = std::max(most, half_turns(mass.center, arrival, path_trace));
  return std::isfinite(most) ? static_cast<std::uint32_t>(most) : 0;
}

FirstHit first_hit_of(const World& world, const Arrival& arrival, const PathTrace& path_trace) {
  FirstHit first_hit;
  if (arrival.fate == Fate::hit || arrival.fate == Fate::absorbed) first_hit.depth = arrival.length;
  if (arrival.fate == Fate::hit) {
    const ShadedSurface place = shaded_surface(world.space, world.appearance, arrival);
    first_hit.normal = place.point.normal;
    first_hit.albedo = albedo_of(world.appearance, place, -arrival.direction);
  }
  first_hit.object = object_of(world, arrival);
  first_hit.fate = arrival.fate;
  first_hit.steps = arrival.steps;
  first_hit.turning = arrival.turning;
  first_hit.crossings = arrival.crossings;
  first_hit.order = image_order(world.space.masses, arrival, path_trace);
  first_hit.position = arrival.position;
  return first_hit;
}

std::vector<std::string> object_names(const World& world) {
  std::vector<std::string> names;
  for (const Body& body : world.appearance.bodies) names.push_back(body.name);
  for (const Portal& portal : world.space.portals.portals()) names.push_back(portal.name);
  for (const Mass& mass : world.space.masses) names.push_back(mass.name);
  return names;
}

std::size_t channel_count(std::span<const Layer> layers) {
  std::size_t count = 0;
  for (const Layer layer : layers) count += channel_names(layer).size();
  return count;
}

void take_layers(const World& world, int x, int y, std::span<const Layer> layers,
                 std::span<float> values) {
  PathTrace path_trace;
  const Arrival arrival =
      advance_recorded(world.space, camera_photon(world, {x, y, 0}), path_trace);
  const FirstHit first_hit = first_hit_of(world, arrival, path_trace);
  std::size_t channel = 0;
  for (const Layer layer : layers)
    for (const float value : channel_values(first_hit, layer)) values[channel++] = value;
}

}  // namespace portalens
