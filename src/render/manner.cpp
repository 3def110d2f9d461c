#include "render/manner.h"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <span>

#include "lanes/instruction_sets.h"
#include "lanes/plan.h"
#include "photon/beam.h"

namespace portalens {
namespace {

/// "3 cube, 1 mesh"
std::string kinds_of(const World& world, std::span<const std::uint32_t> shapes) {
  std::map<std::string, std::size_t> counts;
  for (const std::uint32_t shape : shapes) ++counts[world.appearance.bodies[shape].kind];
  std::string text;
  for (const auto& [kind, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  return text;
}

std::string why_all_photons(const RenderOptions& options, bool lanes) {
  if (options.photons == Photons::all) return "it is asked for (--photons all)";
  if (!lanes) return "only lanes know how to send fewer";
  return fmt::format("more than {} surfaces, portals and masses are there to hold beams against",
                     BeamGuard::max_obstacles);
}

}  // namespace

Manner manner_of(const World& world, const RenderOptions& options) {
  const PlannedSpace& space = world.space;
  const bool lanes = takes_lanes(space, options.engine), fewer = interpolates(world, options);
  const bool plain = lanes && !lane_engine().rounds_as_all;
  return {lanes ? "lanes" : "scalar",
          why_no_lanes(space, options.engine),
          plain ? "products and sums are rounded apart, as this processor does; PORTALENS_ISA=sse4 "
                  "gives the bits of others, slower"
                : "",
          lanes ? kinds_of(world, space.lanes->boxed) : "",
          fewer ? "fewer" : "all",
          fewer ? "" : why_all_photons(options, lanes)};
}

Metadata manner_metadata(const Manner& manner) {
  Metadata metadata;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) metadata.emplace_back(name, value);
  };
  add("portalens:engine", manner.engine);
  add("portalens:engine_because", manner.why_scalar);
  add("portalens:engine_rounding", manner.rounding);
  add("portalens:engine_in_double", manner.in_double);
  add("portalens:photon_mode", manner.photons);
  add("portalens:photon_mode_because", manner.why_all);
  return metadata;
}

}  // namespace portalens
