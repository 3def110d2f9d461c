// Do a thousand masses cost more than ten, where as many of them act at a place? A sheet of masses,
// as deep for any number of them, is looked through at right angles: so photons cross as many
// spheres of influence in each. A cube of the same size for any number of them is shown, too: there
// photons cross more spheres, and smaller ones. And what does it save that masses are crossed by
// table which are alone in their influence? A grain of dust in each is enough that they are stepped
// through. Photons must land where the scalar engine has them.
//
//     bench_masses [--json | --markdown]
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lanes/engine.h"
#include "math/random.h"
#include "support/clock.h"
#include "support/command.h"
#include "support/errors.h"
#include "support/subject.h"

namespace portalens::benchmarks {
namespace {

constexpr int side = 128;          ///< photons, squared
constexpr double coverage = 1.0;   ///< mean number of spheres of influence over a point
constexpr double min_force = 5.0;  ///< so that a horizon is 1/200 of its sphere, of radius 1
/// Errors are told in pixels of a picture with 256 over 40 degrees.
constexpr double pixel = 40.0 * std::numbers::pi / 180.0 / 256;

/// Masses in a box about the origin, that is looked through along -z.
struct ManyMasses {
  double width, depth;  ///< of the box: width² depth
  std::vector<Vec3d> centers;
  double radius = 0.0;  ///< of each influence
  double dust = 0.0;    ///< radius of a grain in each

  /// Side by side, each alone.
  static ManyMasses apart(int columns, int rows) {
    constexpr double distance = 2.1;
    ManyMasses many;
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < rows; ++j)
        many.centers.push_back({distance * (i - 0.5 * (columns - 1)),
                                distance * (j - 0.5 * (rows - 1)), 0.05 * ((i + j) % 3)});
    many.radius = 1.0;
    many.width = distance * columns;
    many.depth = 2.0;
    return many;
  }
  ManyMasses() = default;

  /// Spread evenly.
  ManyMasses(int count, double the_width, double the_depth) : width(the_width), depth(the_depth) {
    // An additive sequence with the powers of the root of x⁴ = x + 1 (Roberts, 2018).
    constexpr double root = 1.2207440846057596;
    for (int i = 1; i <= count; ++i) {
      const auto share = [i](double power) { return std::fmod(0.5 + i / power, 1.0) - 0.5; };
      centers.push_back(
          {width * share(root), width * share(root * root), depth * share(root * root * root)});
    }
    radius = radius_for(coverage);
  }

  /// The mean number of spheres of that radius over a place in the box.
  [[nodiscard]] double spheres_over_a_place(double of_radius) const {
    constexpr int places = 4000;
    std::size_t count = 0;
    for (int i = 0; i < places; ++i) {
      const auto key = static_cast<std::uint64_t>(i);
      const Vec3d x{width * (random_number(key, 0) - 0.5), width * (random_number(key, 1) - 0.5),
                    depth * (random_number(key, 2) - 0.5)};
      for (const Vec3d& center : centers)
        count += dot(x - center, x - center) < of_radius * of_radius ? 1 : 0;
    }
    return static_cast<double>(count) / places;
  }

  [[nodiscard]] double radius_for(double spheres) const {
    double low = 0.0, high = width + depth;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (spheres_over_a_place(middle) < spheres ? low : high) = middle;
    }
    return high;
  }

  [[nodiscard]] std::string toml() const {
    std::string text = fmt::format(R"(
[camera]
type = "orthographic"
position = [0, 0, {0}]
look_at = [0, 0, 0]
size = {1}
[film]
width = {2}
height = {2}
[sampler]
samples = 1
[physics]
min_force = {3}
max_steps = 1000000
)",
                                   0.5 * depth + 2.0 * radius, width, side, min_force);
    for (const Vec3d& center : centers)
      fmt::format_to(std::back_inserter(text), "[[mass]]\ncenter = [{}, {}, {}]\nmass = {}\n",
                     center.x, center.y, center.z, min_force * radius * radius);
    if (dust > 0.0)
      for (const Vec3d& center : centers)
        fmt::format_to(std::back_inserter(text), "[[sphere]]\ncenter = [{}, {}, {}]\nradius = {}\n",
                       center.x, center.y, center.z - 0.9 * radius, dust);
    return text;
  }
};

/// What was found about one many masses.
struct Found {
  double seconds = 0, steps = 0;  ///< a photon
  Errors errors;
};

double seconds_a_photon(const PlannedSpace& space, const std::vector<Photon>& photons) {
  std::vector<Arrival> arrivals(photons.size());
  return least_time_of(3, [&] { advance(space, photons, arrivals); }) /
         static_cast<double>(photons.size());
}

Found measure(const std::string& name, const ManyMasses& many, const Request& request) {
  const Subject subject = generated_subject(request.folder / (name + ".toml"), many.toml());
  const PlannedSpace& space = subject.world.space;
  const auto checked = camera_photons(subject.world, 4);
  std::vector<Arrival> arrivals(checked.size());
  advance(space, checked, arrivals);
  Found found;
  found.errors = errors_of(arrivals, converged_arrivals(subject, checked, request.cache()), pixel);
  demand_sound(found.errors, name);

  for (const Arrival& arrival : arrivals) found.steps += arrival.steps;
  found.steps /= static_cast<double>(arrivals.size());

  found.seconds = seconds_a_photon(space, checked);
  // Where photons are quick, more of them tell it better.
  if (found.seconds * side * side < 0.5)
    found.seconds = seconds_a_photon(space, camera_photons(subject.world));
  return found;
}

/// Masses that are alone, by table and by steps.
void run_apart(const Request& request) {
  Table table("masses alone in their influence",
              {{"masses", ""},
               {"us a photon", "microseconds", "{:.3f}"},
               {"stepped through", "microseconds_stepped", "{:.3f}"},
               {"ratio", "ratio", "{:.1f}"},
               {"steps", "steps", "{:.1f}"},
               {"median px", "error_p50_px", "{:.2g}"},
               {"p99 px", "error_p99_px", "{:.2g}"},
               {"max px", "error_max_px", "{:.2g}"},
               {"mismatch", "mismatch", "{:.3f} %", 100.0}});
  for (const auto& [columns, rows] : {std::pair(1, 1), {2, 4}, {4, 5}, {10, 10}}) {
    const std::string count = fmt::format("{}", columns * rows);
    ManyMasses many = ManyMasses::apart(columns, rows);
    const Found found = measure("masses-apart-" + count, many, request);
    many.dust = 1e-5;
    const Found stepped = measure("masses-dusty-" + count, many, request);
    table.add("masses/apart-" + count,
              {count, 1e6 * found.seconds, 1e6 * stepped.seconds, stepped.seconds / found.seconds,
               found.steps, found.errors.median, found.errors.p99, found.errors.most,
               found.errors.mismatch});
  }
  table.print(request.style);
}

int run(const Request& request) {
  Table table(fmt::format("{:.3g} spheres of influence over a place", coverage),
              {{"", ""},
               {"radius", "", "{:.3f}"},
               {"us a photon", "microseconds", "{:.2f}"},
               {"to ten", "ratio", "{:.2f}"},
               {"steps", "steps", "{:.1f}"},
               {"us a step", "microseconds_a_step", "{:.3f}"},
               {"median px", "error_p50_px", "{:.2g}"},
               {"p99 px", "error_p99_px", "{:.2g}"},
               {"max px", "error_max_px", "{:.2g}"},
               {"mismatch", "mismatch", "{:.3f} %", 100.0}});
  const auto add = [&](const std::string& kind, int count, const ManyMasses& many, double base) {
    const std::string name = fmt::format("{}-{}", kind, count);
    const Found found = measure("masses-" + name, many, request);
    const double ratio = base > 0.0 ? found.seconds / base : 1.0;
    table.add("masses/" + name,
              {fmt::format("{} of {}", kind, count), many.radius, 1e6 * found.seconds, ratio,
               found.steps, 1e6 * found.seconds / found.steps, found.errors.median,
               found.errors.p99, found.errors.most, found.errors.mismatch});
    return found.seconds;
  };
  constexpr double depth = 4.0;
  double base = 0.0;
  for (const int count : {10, 100, 1000}) {
    const double seconds = add("sheet", count, ManyMasses(count, std::sqrt(count), depth), base);
    if (count == 10) base = seconds;
  }
  base = add("cube", 10, ManyMasses(10, depth, depth), 0.0);
  add("cube", 1000, ManyMasses(1000, depth, depth), base);
  table.print(request.style);
  run_apart(request);
  return 0;
}

}  // namespace
}  // namespace portalens::benchmarks

int main(int count, char** words) {
  return portalens::benchmarks::Command(
             "Do a thousand masses cost more than ten, where as many of them act at a place?")
      .run(count, words, portalens::benchmarks::run);
}
