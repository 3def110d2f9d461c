// What does a hole cost in a scene with a mesh of a million triangles? The same picture is taken
// with the hole and without it, where all photons fly straight. Before that, photons with the hole
// must land where the scalar engine has them, and with a hole so light that it bends nothing,
// though it acts everywhere, where straight ones do.
//
//     bench_mesh [--json | --markdown] [--triangles N]
#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

#include "io/files.h"
#include "lanes/engine.h"
#include "support/bumpy_sphere.h"
#include "support/clock.h"
#include "support/command.h"
#include "support/errors.h"
#include "support/picture.h"
#include "support/subject.h"

namespace portalens::benchmarks {
namespace {

constexpr int side = 256;
constexpr double hole_mass = 300.0, min_force = 0.1;

/// The mesh over a ground, and a hole at its side. Half of the picture is mesh.
/// @param mass  kg; whatever it is, the hole acts as far as that of `hole_mass`
Subject scene_with(double mass, const std::string& mesh, const Request& request) {
  std::string toml = fmt::format(R"(
[camera]
position = [0, 2.5, 13]
look_at = [0, 1.6, 0]
fov = 40
[film]
width = {0}
height = {0}
[sampler]
samples = 1
[physics]
min_force = {1}
[[material]]
name = "ground"
diffuse = {{ checker = [[0.8, 0.8, 0.8], [0.1, 0.1, 0.15]], size = 1.0 }}
[[material]]
name = "clay"
diffuse = [0.7, 0.3, 0.2]
[[light]]
position = [6, 9, 8]
intensity = [400, 400, 380]
[[quad]]
vertices = [[-30, -1.8, 30], [30, -1.8, 30], [30, -1.8, -30], [-30, -1.8, -30]]
material = "ground"
[[mesh]]
file = "{2}"
scale = 3.2
translate = [-0.8, 1.5, 0]
material = "clay"
)",
                                 side, mass > 0.0 ? min_force * mass / hole_mass : min_force, mesh);
  if (mass > 0.0) toml += fmt::format("[[mass]]\ncenter = [2.9, 2.4, 2.2]\nmass = {}\n", mass);
  return generated_subject(request.folder / fmt::format("mesh-{}.toml", mass), toml);
}

std::vector<Arrival> arrivals_of(const Subject& subject, const std::vector<Photon>& photons) {
  std::vector<Arrival> arrivals(photons.size());
  advance(subject.world.space, photons, arrivals);
  return arrivals;
}

struct Timed {
  double picture, photons;  ///< seconds
};

Timed time(const Subject& subject) {
  const auto photons = camera_photons(subject.world);
  Timed timed{};
  timed.photons = least_time_of(3, [&] { (void)arrivals_of(subject, photons); });
  timed.picture = least_time_of(3, [&] { (void)take_picture(subject.world); });
  return timed;
}

int measure(int triangles, const Request& request) {
  const std::string mesh = fmt::format("sphere-{}.obj", triangles);
  replace_file(request.folder / mesh, bumpy_sphere(triangles));
  const Subject straight = scene_with(0.0, mesh, request),
                hole = scene_with(hole_mass, mesh, request),
                light = scene_with(1e-5, mesh, request);

  const double pixel = pixel_angle(hole.world);
  const auto photons = camera_photons(hole.world, 8);
  const auto flying = arrivals_of(straight, photons);
  const Errors straight_errors =
      errors_of(flying, converged_arrivals(straight, photons, request.cache()), pixel);
  const Errors light_errors = errors_of(arrivals_of(light, photons), flying, pixel);
  const Errors errors = errors_of(arrivals_of(hole, photons),
                                  converged_arrivals(hole, photons, request.cache()), pixel);
  demand_sound(straight_errors, "straight flight");
  demand_sound(light_errors, "the light hole");
  demand_sound(errors, "the hole");

  const Timed base = time(straight);
  Table table(fmt::format("{} triangles, {} x {} photons", triangles, side, side),
              {{"", ""},
               {"seconds", "seconds", "{:.3f}"},
               {"to straight", "ratio", "{:.2f}"},
               {"photons alone", "ratio_photons", "{:.2f}"},
               {"median px", "error_p50_px", "{:.2g}"},
               {"p99 px", "error_p99_px", "{:.2g}"},
               {"max px", "error_max_px", "{:.2g}"},
               {"mismatch", "mismatch", "{:.3f} %", 100.0}});
  const auto add = [&](const std::string& name, const Timed& timed, const Errors& of) {
    table.add("mesh/" + name,
              {name, timed.picture, timed.picture / base.picture, timed.photons / base.photons,
               of.median, of.p99, of.most, of.mismatch});
  };
  add("no hole", base, straight_errors);
  add("a hole that bends nothing", time(light), light_errors);
  add("a hole", time(hole), errors);
  table.print(request.style);
  return 0;
}

}  // namespace
}  // namespace portalens::benchmarks

int main(int count, char** words) {
  namespace benchmarks = portalens::benchmarks;
  benchmarks::Command command(
      "What does a hole cost in a scene with a mesh of a million triangles, beside the same scene "
      "without it?");
  int triangles = 1000000;
  command.options()
      .add_option("--triangles", triangles, "of the mesh")
      ->check(CLI::Range(8, 8000000))
      ->capture_default_str();
  return command.run(count, words, [&](const benchmarks::Request& request) {
    return benchmarks::measure(triangles, request);
  });
}
