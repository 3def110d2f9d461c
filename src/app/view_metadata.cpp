#include "app/view_metadata.h"

#include <fmt/format.h>

#include <string>

namespace portalens {
namespace {

std::string vector_text(Vec3d v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

}  // namespace

Metadata view_metadata(const World& world) {
  const Camera& camera = world.camera;
  const Environment& sky = world.appearance.environment;
  const bool perspective = camera.projection == Projection::perspective;
  const char* const axis = camera.fov_axis == FovAxis::x ? "x" : "y";
  return {
      {std::string(matrix_entry), matrix_text(world_to_camera(camera))},
      {"portalens:camera", perspective ? "perspective" : "orthographic"},
      {"portalens:camera_position", vector_text(camera.position)},
      {"portalens:camera_forward", vector_text(camera.forward)},
      {"portalens:camera_up", vector_text(camera.up)},
      {perspective ? "portalens:camera_fov" : "portalens:camera_size",
       perspective ? fmt::format("{} degrees along {}", camera.fov, axis)
                   : fmt::format("{}", camera.size)},
      {"portalens:environment", sky.image ? fmt::format("a picture times {}, turned by {} degrees",
                                                        vector_text(sky.scale), sky.rotation)
                                          : vector_text(sky.color)},
      {"portalens:lost_color", vector_text(world.appearance.limits.lost_color)},
      {"portalens:lost_by_crossings",
       world.appearance.limits.lost_color_given ? "lost_color" : "environment"}};
}

ExrMatrix world_to_camera(const Camera& camera) {
  ExrMatrix matrix{};
  const Vec3d axes[] = {camera.right, camera.up, camera.forward};
  for (std::size_t column = 0; column < 3; ++column) {
    const Vec3d& axis = axes[column];
    const double rows[] = {axis.x, axis.y, axis.z, -dot(axis, camera.position)};
    for (std::size_t row = 0; row < 4; ++row)
      matrix[4 * row + column] = static_cast<float>(rows[row]) + 0.0f;  // no -0
  }
  matrix[15] = 1.0f;
  return matrix;
}

}  // namespace portalens
