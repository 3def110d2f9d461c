// How fast is the program beside the paper's method, and how exact? Every engine's arrivals are
// compared with a converged scalar run, on 16,384 photons, before its time counts. Times are of one
// thread, from the camera to the film: photons on their paths, shading, shadows, the sum of
// samples. The reference runs on every eighth pixel each way, and is scaled.
//
//     bench_engines [--json | --markdown] [--size N] [--set key=value ...] [scene ...]
//
// by default the scenes in benchmarks/scenes. The paper's method knows `closest-point` alone; with
// other couplings the reference is the scalar engine with Euler's steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lanes/engine.h"
#include "oracle_digest.h"
#include "reference/paper_method.h"
#include "reference_digest.h"
#include "support/clock.h"
#include "support/command.h"
#include "support/errors.h"
#include "support/picture.h"
#include "support/subject.h"

namespace portalens::benchmarks {
namespace {

constexpr int checked_side = 128;  ///< errors are of that number of photons, squared
constexpr int every = 8;           ///< pixels of the reference
constexpr double euler_step = 0.02;

using RayState = std::function<void(std::span<const Photon>, std::span<Arrival>)>;

/// One way of taking the picture, and what was found about it.
struct Contestant {
  std::string name;
  RayState ray_state;
  int every;                         ///< pixels it is timed on
  std::function<void()> picture;     ///< takes them, from camera to film
  std::vector<double> seconds{};     ///< of the whole picture, in each round
  double photon_seconds = INFINITY;  ///< the least without shading and film
  double steps = 0;                  ///< a photon
  Errors errors{};
};

RayState engine_of(const Subject& subject, Engine engine) {
  return [&space = subject.world.space, engine](std::span<const Photon> photons,
                                                std::span<Arrival> arrivals) {
    advance(space, photons, arrivals, engine);
  };
}

/// The paper's method, or Euler's steps where it doesn't know the coupling.
Contestant reference_for(const Subject& subject, const Subject& euler) {
  Contestant reference;
  reference.every = every;
  const Physics& physics = subject.world.space.physics;
  if (physics.portal_gravity == "none" || physics.portal_gravity == "closest-point") {
    const int depth =
        physics.portal_gravity == "none" ? 0 : static_cast<int>(physics.portal_gravity_depth);
    const auto paper =
        std::make_shared<const reference::PaperMethod>(subject.world.space, euler_step, depth);
    reference.name = "the paper's method";
    reference.ray_state = [paper](std::span<const Photon> photons, std::span<Arrival> arrivals) {
      for (std::size_t i = 0; i < photons.size(); ++i) arrivals[i] = paper->advance(photons[i]);
    };
  } else {
    reference.name = "Euler's steps, scalar";
    reference.ray_state = engine_of(euler, Engine::scalar);
  }
  reference.picture = [&subject, ray_state = reference.ray_state] {
    (void)take_pixels(subject.world, every, ray_state);
  };
  return reference;
}

/// What `render` does by default; null where it sends every photon.
std::optional<Contestant> fewer_photons(const World& world) {
  if (!interpolates(world, {})) return std::nullopt;
  auto guard = BeamGuard::over(world.space);
  if (!guard) return std::nullopt;
  const auto kept = std::make_shared<const BeamGuard>(std::move(*guard));
  const RayState ray_state = [&world, kept](std::span<const Photon> photons,
                                            std::span<Arrival> arrivals) {
    const double pixels = static_cast<double>(world.film.width) * world.film.height;
    const double step = std::sqrt(pixels / static_cast<double>(photons.size()));
    interpolate(world, *kept, static_cast<int>(std::lround(step)), arrivals);
  };
  return Contestant{"fewer photons", ray_state, 1,
                    [&world] { (void)take_picture(world, 1, Engine::automatic, Photons::fewer); }};
}

std::vector<Contestant> contestants(const Subject& subject, const Subject& euler) {
  std::vector<Contestant> all{reference_for(subject, euler)};
  const RayState scalar = engine_of(subject, Engine::scalar);
  all.push_back({"scalar", scalar, every,
                 [&subject, scalar] { (void)take_pixels(subject.world, every, scalar); }});
  const World& world = subject.world;
  all.push_back({world.space.lanes ? "lanes" : "render, without lanes",
                 engine_of(subject, Engine::automatic), 1,
                 [&world] { (void)take_picture(world); }});
  if (auto interpolating = fewer_photons(world)) all.push_back(std::move(*interpolating));
  return all;
}

/// Arrivals of the reference are kept: they take long, and only their time is wanted anew.
std::vector<Arrival> arrivals_of(const Contestant& one, bool is_reference, const Subject& subject,
                                 const std::vector<Photon>& photons, const ArrivalCache& cache) {
  if (is_reference)
    return cache.arrivals(recipe_of(subject) + "reference " PORTALENS_REFERENCE_DIGEST " " +
                              one.name + fmt::format(" {}", euler_step),
                          photons, one.ray_state);
  std::vector<Arrival> arrivals(photons.size());
  one.ray_state(photons, arrivals);
  return arrivals;
}

void check(std::vector<Contestant>& all, const Subject& subject, const ArrivalCache& cache) {
  const World& world = subject.world;
  const int step = std::max(1, std::min(world.film.width, world.film.height) / checked_side);
  const auto photons = camera_photons(world, step);
  const auto exact = converged_arrivals(subject, photons, cache);
  for (Contestant& one : all) {
    const auto arrivals = arrivals_of(one, &one == all.data(), subject, photons, cache);
    one.errors = errors_of(arrivals, exact, pixel_angle(world));
    for (const Arrival& arrival : arrivals) one.steps += arrival.steps;
    one.steps /= static_cast<double>(arrivals.size());
    // The reference's steps are as long for any picture: its errors count in pixels of 256².
    const double pixels = &one == all.data() ? std::max(1.0, world.film.height / 256.0) : 1.0;
    demand_sound(one.errors, one.name + " of " + subject.scene.file.string(), pixels);
  }
}

/// In rounds, so that all have the same share of the machine's good and bad times.
void time(std::vector<Contestant>& all, const World& world, int rounds) {
  const auto pixels = static_cast<double>(world.film.width) * world.film.height;
  for (int round = 0; round < rounds; ++round)
    for (Contestant& one : all) {
      const auto photons = camera_photons(world, one.every);
      const double scale = pixels / static_cast<double>(photons.size());
      const int repeats = one.every == 1 ? 3 : 1;  // a short time is the best of several
      one.seconds.push_back(scale * least_time_of(repeats, one.picture));
      std::vector<Arrival> arrivals(photons.size());
      one.photon_seconds =
          std::min(one.photon_seconds,
                   scale * least_time_of(repeats, [&] { one.ray_state(photons, arrivals); }));
    }
}

double least(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

/// By how much a ratio moves from round to round: half of its range over its middle.
double noise_of(const Contestant& reference, const Contestant& one) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < one.seconds.size(); ++i)
    ratios.push_back(reference.seconds[i] / one.seconds[i]);
  const auto [low, high] = std::minmax_element(ratios.begin(), ratios.end());
  return (*high - *low) / (*high + *low);
}

void measure(const std::filesystem::path& file, const Settings& settings, int side,
             const Request& request) {
  Settings all_settings = square_film(side);
  all_settings.insert(all_settings.end(), settings.begin(), settings.end());
  const Subject subject = read_subject(file, all_settings);
  const Subject euler =
      subject.with({"physics.integrator=euler", fmt::format("physics.step={}", euler_step)});
  std::vector<Contestant> all = contestants(subject, euler);
  check(all, subject, request.cache());
  time(all, subject.world, side > 256 ? 1 : 3);

  std::string name = fmt::format("{} {}²", file.stem().string(), side);
  for (const std::string& setting : settings) name += " " + setting;
  Table table(name, {{"", ""},
                     {"seconds", "seconds", "{:.4f}"},
                     {"ratio", "ratio", "{:.1f}"},
                     {"noise", "noise", "±{:.0f} %", 100.0},
                     {"photons alone", "ratio_photons", "{:.1f}"},
                     {"steps", "steps", "{:.1f}"},
                     {"median px", "error_p50_px", "{:.2g}"},
                     {"p99 px", "error_p99_px", "{:.2g}"},
                     {"p99.99 px", "error_p9999_px", "{:.2g}"},
                     {"max px", "error_max_px", "{:.2g}"},
                     {"mismatch", "mismatch", "{:.3f} %", 100.0}});
  const Contestant& reference = all.front();
  for (const Contestant& one : all) {
    const Errors& errors = one.errors;
    table.add(name + "/" + one.name,
              {one.name, least(one.seconds), least(reference.seconds) / least(one.seconds),
               noise_of(reference, one), reference.photon_seconds / one.photon_seconds, one.steps,
               errors.median, errors.p99, errors.p9999, errors.most, errors.mismatch});
  }
  table.print(request.style);
}

/// All scenes small, and figure 7 large.
void measure_all(const Settings& settings, const Request& request) {
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(PORTALENS_BENCHMARK_SCENES))
    if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  for (const auto& scene : scenes) measure(scene, settings, 256, request);
  measure(std::filesystem::path(PORTALENS_BENCHMARK_SCENES) / "figure-7.toml", settings, 1024,
          request);
}

}  // namespace
}  // namespace portalens::benchmarks

int main(int count, char** words) {
  namespace benchmarks = portalens::benchmarks;
  benchmarks::Command command(
      "How fast is the program beside the paper's method, and how exact? By default on all of "
      "benchmarks/scenes at 256², and figure 7 at 1024².");
  int side = 256;
  benchmarks::Settings settings;
  std::vector<std::string> scenes;
  command.options()
      .add_option("--size", side, "pixels along the picture's sides")
      ->check(CLI::Range(8, 8192));
  command.options()
      .add_option("--set", settings, "section.key=value, as in TOML")
      ->allow_extra_args(false);
  command.options().add_option("scenes", scenes, "scene files");
  return command.run(count, words, [&](const benchmarks::Request& request) {
    if (scenes.empty()) {
      benchmarks::measure_all(settings, request);
    } else {
      for (const std::string& scene : scenes) benchmarks::measure(scene, settings, side, request);
    }
    return 0;
  });
}
