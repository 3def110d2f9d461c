#include "world/face_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include "core/words.h"
#include "geometry/extent.h"
#include "geometry/two_lengths.h"
#include "portal/portal.h"
#include "world/polygon_check.h"

namespace portalens {
namespace {

constexpr std::size_t max_vertices = 64;
/// A flatter ellipse is a line for all that numbers tell.
constexpr double flattest = 1e-6;

/// Where a face is that is not told by its vertices.
std::optional<Frame> read_frame(Parameters& parameters) {
  const std::size_t before = parameters.faults().size();
  const Vec3d center = to_vec3(parameters.triple("center", coordinate));
  const Vec3d facing = to_vec3(parameters.triple("facing"));
  const Vec3d up = to_vec3(parameters.triple("up", any_number, Triple{0, 1, 0}));
  if (parameters.faults().size() > before) return std::nullopt;
  if (!(length(facing) > 0.0)) {
    parameters.fault("facing", "'facing' is no direction", "give the way that the front looks");
    return std::nullopt;
  }
  const Vec3d normal = normalize(facing);
  const Vec3d right = cross(up, normal);
  if (!(length(right) > 1e-6 * length(up))) {
    parameters.fault("up", "'up' leads along 'facing'",
                     "give an 'up' that points aside of it; by default it is [0, 1, 0]");
    return std::nullopt;
  }
  const Vec3d unit = normalize(right);
  return Frame{center, unit, cross(normal, unit), normal};
}

std::optional<FaceInput> polygon(Parameters& parameters, const std::string& name) {
  std::vector<Vec3d> vertices;
  for (const Triple& point : parameters.points("vertices", 3, max_vertices))
    vertices.push_back(to_vec3(point));
  if (vertices.empty()) return std::nullopt;
  if (const auto fault = polygon_fault(vertices)) {
    parameters.fault("vertices", in_quotes(name) + ": " + fault->problem, fault->remedy);
    return std::nullopt;
  }
  return polygon_input(std::move(vertices));
}

std::optional<FaceInput> rectangle(Parameters& parameters) {
  const std::optional<Frame> frame = read_frame(parameters);
  const auto size = two_lengths(parameters, "size", OneNumber::is_not_enough,
                                "give [width, height]: width across 'up', height along it");
  if (!frame || !size) return std::nullopt;
  const double x = 0.5 * (*size)[0], y = 0.5 * (*size)[1];
  return polygon_input({frame->to_world({-x, -y, 0}), frame->to_world({x, -y, 0}),
                        frame->to_world({x, y, 0}), frame->to_world({-x, y, 0})});
}

std::optional<FaceInput> ellipse(Parameters& parameters) {
  const std::optional<Frame> frame = read_frame(parameters);
  const auto radii = two_lengths(parameters, "radius", OneNumber::stands_for_both,
                                 "give a number, or [across, along]: radii across 'up' and along "
                                 "it");
  if (!frame || !radii) return std::nullopt;
  if ((*radii)[0] < flattest * (*radii)[1] || (*radii)[1] < flattest * (*radii)[0]) {
    parameters.fault("radius", "the radii of the ellipse differ by more than a million times",
                     "give radii that are more alike");
    return std::nullopt;
  }
  FaceInput input;
  input.frame = *frame;
  input.radii = *radii;
  return input;
}

}  // namespace

std::string_view shape_key(Parameters& parameters) {
  if (parameters.has("vertices")) return "vertices";
  if (parameters.has("radius")) return "radius";
  return parameters.has("size") ? "size" : "vertices";
}

std::optional<FaceInput> read_face(Parameters& parameters, const std::string& name) {
  const bool round = parameters.has("radius"), straight = parameters.has("size");
  std::string_view about_center;
  for (const std::string_view key : {"up", "facing", "center"})
    if (parameters.has(key)) about_center = key;
  if (parameters.has("vertices") && (round || straight || !about_center.empty())) {
    parameters.fault(round      ? "radius"
                     : straight ? "size"
                                : about_center,
                     in_quotes(name) + " has vertices, and a center or a shape about it",
                     "give vertices alone, or center, facing and either size or radius");
    return std::nullopt;
  }
  if (round && straight) {
    parameters.fault("size", in_quotes(name) + " has a size and a radius",
                     "give a size for a rectangle, or a radius for an ellipse");
    return std::nullopt;
  }
  if (round) return ellipse(parameters);
  if (straight) return rectangle(parameters);
  if (!about_center.empty()) {
    parameters.fault(about_center, in_quotes(name) + " has a place, and no shape about it",
                     "add size = [width, height] or radius, or give vertices alone");
    return std::nullopt;
  }
  return polygon(parameters, name);
}

}  // namespace portalens
