#include "app/draw_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "app/legend.h"
#include "app/scene_marks.h"
#include "app/sheet.h"
#include "core/error.h"
#include "render/parallel.h"

namespace portalens {
namespace {

constexpr std::size_t max_steps = 4000000;  ///< of all paths together

int height_of(const World& world, const StandpointChoice& from, const DrawingSize& size) {
  if (size.height > 0) return size.height;
  const bool own = from.from == Standpoint::camera && !from.eye;
  const double aspect =
      own ? static_cast<double>(world.film.height) / world.film.width : 540.0 / 960.0;
  return static_cast<int>(std::clamp(std::round(size.width * aspect), 1.0, 4096.0));
}

/// Whether photons begin at the scene's camera, or there are none.
bool camera_matters(const World& world, const std::vector<DrawnPath>& paths, double tolerance) {
  return paths.empty() || std::any_of(paths.begin(), paths.end(), [&](const DrawnPath& path) {
           const Vec3d start = path.trace.path_trace.stretches.front().front();
           return length(start - world.camera.position) <= tolerance;
         });
}

}  // namespace

std::vector<DrawnPath> follow(const World& world, const std::vector<NamedRay>& rays, int bounces,
                              int threads) {
  std::vector<DrawnPath> paths(rays.size());
  std::atomic<std::size_t> steps = 0;
  const auto work = [&](std::size_t i) {
    Photon photon;
    photon.position = rays[i].ray.origin;
    photon.direction = rays[i].ray.direction;
    paths[i] = {rays[i].name, trace_ray(world, photon, bounces)};
    steps += paths[i].trace.end.steps;
  };
  const bool all = parallel_for(rays.size(), threads, work, [&] { return steps > max_steps; });
  if (!all || steps > max_steps)
    refuse(fmt::format("the paths have more than {} steps", max_steps),
           "draw fewer photons, or take a larger physics.tolerance or physics.step");
  return paths;
}

Drawing draw_scene(const World& world, const std::vector<DrawnPath>& paths,
                   const StandpointChoice& from, const DrawingStyle& style) {
  const int width = style.size.width, height = height_of(world, from, style.size);
  const Box interest = box_of_interest(world, paths);
  const double size = interest.diagonal();
  const Camera camera = drawing_camera(world, from, interest, static_cast<double>(width) / height);
  Sheet sheet(View(camera, width, height, 1e-4 * size));
  add_scene(world, sheet);
  const bool elsewhere = from.from != Standpoint::camera || from.eye;
  if (elsewhere && camera_matters(world, paths, 1e-6 * size)) add_camera(world, 0.06 * size, sheet);
  const PathStyle path_style{style.steps_a_color, style.color, 0.12 * size};
  add_paths(world, paths, path_style, sheet);
  const View view = sheet.view();
  const double unit = sheet.unit();
  Drawing drawing = std::move(sheet).release();
  if (style.legend)
    add_legend(world, view, world.file.filename().string() + ", " + standpoint_text(from), paths,
               path_style, unit, drawing);
  return drawing;
}

}  // namespace portalens
