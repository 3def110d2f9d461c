// How does the time grow with pixels, triangles, masses, portals, and the depth of gravity through
// portals? Each is doubled some times while all else stays; the exponent is the slope of a straight
// line through the logarithms (least squares), and stands beside what is expected. Before a scene
// is timed, a sample of its photons must land where the scalar engine has them.
//
//     bench_growth [--json | --markdown]
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
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

/// One thing that grows.
struct Question {
  std::string name;
  double expected;      ///< exponent
  std::string because;  ///< why that is expected
  std::vector<int> counts;
  std::function<std::string(int)> toml;  ///< the scene with so many
};

/// A camera that looks at a ground, a light, and some settings.
std::string stage(int side, const std::string& physics) {
  return fmt::format(R"(
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
min_force = 0.2
{1}
[[material]]
name = "ground"
diffuse = {{ checker = [[0.8, 0.8, 0.8], [0.1, 0.1, 0.15]], size = 1.0 }}
[[light]]
position = [4, 9, 8]
intensity = [400, 400, 380]
[[quad]]
vertices = [[-30, 0, 30], [30, 0, 30], [30, 0, -30], [-30, 0, -30]]
material = "ground"
)",
                     side, physics);
}

std::string mass(double x, double y, double z, double kilograms) {
  return fmt::format("[[mass]]\ncenter = [{}, {}, {}]\nmass = {}\n", x, y, z, kilograms);
}

/// An upright portal, 2 by 2.2, that faces the camera.
std::string portal(int index, int pair, double x, double z) {
  return fmt::format(
      "[[portal]]\nname = \"p{0}\"\npair = \"p{1}\"\n"
      "vertices = [[{2}, 0.6, {4}], [{3}, 0.6, {4}], [{3}, 2.8, {4}], [{2}, 2.8, {4}]]\n",
      index, pair, x - 1.0, x + 1.0, z);
}

std::string portals(int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += portal(i, i ^ 1, -5.25 + 3.5 * (i % 4), i < 4 ? -1.5 : -5.5);
  return text;
}

/// So many masses that all act on every photon.
std::string many(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const double around = 6.283185307179586 * i / count;
    text += mass(4.0 * std::cos(around), 2.5 + 0.3 * i / count, 4.0 * std::sin(around) - 2.0,
                 240.0 / count);
  }
  return text;
}

std::vector<Question> questions(const Request& request) {
  const std::string none = "portal_gravity = \"none\"\n";
  const auto depth = [](int levels, const std::string& coupling) {
    return fmt::format("portal_gravity = \"{}\"\nportal_gravity_depth = {}\n", coupling, levels);
  };
  const auto one_mass = mass(-3.6, 1.7, 1.0, 120.0);
  const auto mesh = [&request](int triangles) {
    const std::string file = fmt::format("sphere-{}.obj", triangles);
    replace_file(request.folder / file, bumpy_sphere(triangles));
    return fmt::format("[[mesh]]\nfile = \"{}\"\nscale = 2\ntranslate = [0.5, 2, 0]\n", file);
  };
  return {
      {"pixels",
       1.0,
       "each is taken by itself",
       {1 << 12, 1 << 14, 1 << 16, 1 << 18},
       [=](int pixels) {
         return stage(static_cast<int>(std::lround(std::sqrt(pixels))), none) + one_mass;
       }},
      {"triangles of a mesh",
       0.1,
       "the logarithm of their number",
       {1000, 10000, 100000, 1000000},
       [=](int triangles) { return stage(64, none) + one_mass + mesh(triangles); }},
      {"masses that all act",
       1.0,
       "each pulls at every step, beside what else a step takes",
       {1, 2, 4, 8},
       [=](int masses) { return stage(128, none) + many(masses); }},
      {"portals, depth 1",
       1.0,
       "each is asked at every step, beside what else a step takes",
       {2, 4, 8},
       [=](int count) {
         return stage(128, depth(1, "closest-point")) + one_mass + portals(count);
       }},
      {"depth, one pair",
       1.0,
       "no chain goes straight back: one way more a portal and level",
       {1, 2, 4, 8},
       [=](int levels) {
         return stage(128, depth(levels, "closest-point")) + one_mass + portals(2);
       }},
      {"depth, one pair, graviton-map",
       0.0,
       "one look-up a portal, whatever the depth; a stronger field takes more steps",
       {1, 2, 4, 8},
       [=](int levels) {
         return stage(128, depth(levels, "graviton-map")) + one_mass + portals(2);
       }},
  };
}

struct Cost {
  double seconds = 0;  ///< of a picture
  double steps = 0;    ///< a photon
};

/// Of a picture, after a look at its photons.
Cost cost_of(const Subject& subject, const std::string& name, const Request& request) {
  const int every = std::max(1, subject.world.film.width / 16);
  const auto photons = camera_photons(subject.world, every);
  std::vector<Arrival> arrivals(photons.size());
  advance(subject.world.space, photons, arrivals);
  demand_sound(errors_of(arrivals, converged_arrivals(subject, photons, request.cache()),
                         pixel_angle(subject.world)),
               name);
  Cost cost;
  for (const Arrival& arrival : arrivals) cost.steps += arrival.steps;
  cost.steps /= static_cast<double>(arrivals.size());
  cost.seconds = least_time_of(3, [&] { (void)take_picture(subject.world); });
  return cost;
}

/// Slope of the straight line through (ln count, ln value) with the least squares.
double exponent_of(const std::vector<int>& counts, const std::vector<double>& values) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double a = std::log(counts[i]), b = std::log(values[i]);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

int run(const Request& request) {
  Table table("how the time of a picture grows with ...",
              {{"", ""},
               {"exponent", "exponent", "{:.2f}"},
               {"expected", "expected", "{:.1f}"},
               {"of the steps", "exponent_of_steps", "{:.2f}"},
               {"because", ""},
               {"seconds", "times"},
               {"last to first", "ratio", "{:.2f}"}});
  for (const Question& question : questions(request)) {
    std::vector<double> seconds, steps;
    std::string times;
    for (const int count : question.counts) {
      const std::string name = fmt::format("{} {}", count, question.name);
      const Subject subject =
          generated_subject(request.folder / "growth.toml", question.toml(count));
      const Cost cost = cost_of(subject, name, request);
      seconds.push_back(cost.seconds);
      steps.push_back(cost.steps);
      times += fmt::format("{}{}: {:.3g}", times.empty() ? "" : ", ", count, seconds.back());
    }
    table.add("growth/" + question.name,
              {question.name, exponent_of(question.counts, seconds), question.expected,
               exponent_of(question.counts, steps), question.because, times,
               seconds.back() / seconds.front()});
  }
  table.print(request.style);
  return 0;
}

}  // namespace
}  // namespace portalens::benchmarks

int main(int count, char** words) {
  return portalens::benchmarks::Command(
             "How does the time grow with pixels, triangles, masses, portals and depth?")
      .run(count, words, portalens::benchmarks::run);
}
