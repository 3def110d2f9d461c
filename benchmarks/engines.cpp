// How fast are the engines beside the paper's method, and how exact? Every engine's arrivals are
// compared with a converged scalar run before its time counts. Times are of one thread, from camera
// photons to arrivals; the reference runs on every eighth pixel each way, and is scaled.
//
//     bench_engines [--json] [--set key=value ...] [scene ...]
//
// by default the scenes in benchmarks/scenes. The paper's method knows `closest-point` alone; with
// other couplings the ratios are to fixed steps of Euler's.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "io/read_scene.h"
#include "photon/engine.h"
#include "reference/paper_method.h"
#include "world/compile.h"

namespace portalens {
namespace {

constexpr int side = 256;
constexpr int stride = 8;
constexpr double euler_step = 0.02;
constexpr double converged_tolerance = 1e-8;

/// Processor time of this thread, seconds.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<Photon> camera_photons(const World& world, int every) {
  std::vector<Photon> photons;
  for (int y = every / 2; y < side; y += every)
    for (int x = every / 2; x < side; x += every) {
      const Ray ray = world.camera.ray(x + 0.5, y + 0.5, side, side);
      Photon photon;
      photon.position = ray.origin;
      photon.direction = ray.direction;
      photons.push_back(photon);
    }
  return photons;
}

struct Errors {
  double median = 0, p99 = 0, p9999 = 0, most = 0;  ///< pixels
  double mismatch = 0;                              ///< share that ends elsewhere
};

/// Errors where photons landed, in pixels: a miss divided by the length of the path and the angle
/// of a pixel.
Errors errors_of(const std::vector<Arrival>& arrivals, const std::vector<Arrival>& converged) {
  const double pixel = 40.0 * std::numbers::pi / 180.0 / side;
  std::vector<double> apart;
  std::size_t unlike = 0;
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    const Arrival &a = arrivals[i], &b = converged[i];
    if (a.fate != b.fate || a.object != b.object || a.crossings != b.crossings) {
      ++unlike;
    } else if (a.fate == Fate::escaped) {
      apart.push_back(length(a.direction - b.direction) / pixel);
    } else if (a.fate == Fate::hit) {
      apart.push_back(length(a.position - b.position) / (b.length * pixel));
    }
  }
  Errors errors;
  errors.mismatch = static_cast<double>(unlike) / static_cast<double>(arrivals.size());
  if (apart.empty()) return errors;
  std::sort(apart.begin(), apart.end());
  errors.median = apart[apart.size() / 2];
  errors.p99 = apart[apart.size() * 99 / 100];
  errors.p9999 = apart[apart.size() * 9999 / 10000];
  errors.most = apart.back();
  return errors;
}

struct Row {
  std::string what;
  double seconds = 0;  ///< for side² photons
  double steps = 0;    ///< a photon
  Errors errors;
};

using Advance = std::function<void(std::span<const Photon>, std::span<Arrival>)>;

/// The best of `rounds` on `photons`, scaled to a whole picture; its errors on every `stride`-th.
Row measure(const std::string& what, const Advance& advance, const std::vector<Photon>& photons,
            const std::vector<Photon>& checked, const std::vector<Arrival>& converged, int rounds) {
  Row row;
  row.what = what;
  std::vector<Arrival> arrivals(checked.size());
  advance(checked, arrivals);
  row.errors = errors_of(arrivals, converged);
  for (const Arrival& arrival : arrivals) row.steps += arrival.steps;
  row.steps /= static_cast<double>(arrivals.size());
  arrivals.resize(photons.size());
  double best = INFINITY;
  for (int round = 0; round < rounds; ++round) {
    const double start = thread_seconds();
    advance(photons, arrivals);
    best = std::min(best, thread_seconds() - start);
  }
  row.seconds = best * (side * side / static_cast<double>(photons.size()));
  return row;
}

void report(const std::string& scene, const std::vector<Row>& rows, bool json) {
  if (json) {
    for (const Row& row : rows)
      fmt::print("{}\n", nlohmann::json{{"benchmark", scene + "/" + row.what},
                                        {"ratio", rows[0].seconds / row.seconds},
                                        {"seconds", row.seconds},
                                        {"steps", row.steps},
                                        {"error_p50_px", row.errors.median},
                                        {"error_p99_px", row.errors.p99},
                                        {"error_p9999_px", row.errors.p9999},
                                        {"error_max_px", row.errors.most},
                                        {"mismatch", row.errors.mismatch}}
                             .dump());
    return;
  }
  fmt::print("{}, {} x {} photons\n", scene, side, side);
  fmt::print("  {:<22}{:>10}{:>9}{:>9}{:>11}{:>10}{:>10}{:>10}{:>11}\n", "", "seconds", "ratio",
             "steps", "p50 px", "p99 px", "p99.99 px", "max px", "mismatch");
  for (const Row& row : rows)
    fmt::print("  {:<22}{:>10.4f}{:>9.1f}{:>9.1f}{:>11.2g}{:>10.2g}{:>10.2g}{:>10.2g}{:>10.3f}%\n",
               row.what, row.seconds, rows[0].seconds / row.seconds, row.steps, row.errors.median,
               row.errors.p99, row.errors.p9999, row.errors.most, 100.0 * row.errors.mismatch);
}

Scene changed(Scene scene, const std::vector<std::string>& settings) {
  Faults faults;
  for (const std::string& setting : settings) override_value(scene, setting, faults);
  faults.raise();
  return scene;
}

/// The scene's space with another tolerance or integrator.
World with(const Scene& scene, const std::vector<std::string>& settings) {
  return compile(changed(scene, settings));
}

void run(const std::filesystem::path& file, const std::vector<std::string>& settings, bool json) {
  const Scene scene = changed(read_scene(file), settings);
  const World world = compile(scene);
  const World exact = with(scene, {fmt::format("physics.tolerance={}", converged_tolerance),
                                   "physics.max_steps=10000000"});
  const World euler =
      with(scene, {"physics.integrator=euler", fmt::format("physics.step={}", euler_step)});
  const auto all = camera_photons(world, 1), checked = camera_photons(world, stride);
  std::vector<Arrival> converged(checked.size());
  advance(exact.space, checked, converged, Engine::scalar);

  const auto engine = [](const World& of, Engine which) -> Advance {
    return [&of, which](std::span<const Photon> photons, std::span<Arrival> arrivals) {
      advance(of.space, photons, arrivals, which);
    };
  };
  std::vector<Row> rows;
  const std::string& coupling = world.space.physics.portal_gravity;
  if (coupling == "none" || coupling == "closest-point") {
    const int depth =
        coupling == "none" ? 0 : static_cast<int>(world.space.physics.portal_gravity_depth);
    const reference::PaperMethod paper(world.space, euler_step, depth);
    rows.push_back(measure(
        "paper's method",
        [&](std::span<const Photon> photons, std::span<Arrival> arrivals) {
          for (std::size_t i = 0; i < photons.size(); ++i) arrivals[i] = paper.advance(photons[i]);
        },
        checked, checked, converged, 1));
  }
  rows.push_back(
      measure("euler 0.02", engine(euler, Engine::scalar), checked, checked, converged, 1));
  rows.push_back(
      measure("adaptive, scalar", engine(world, Engine::scalar), checked, checked, converged, 3));
  if (world.space.lanes)
    rows.push_back(
        measure("adaptive, lanes", engine(world, Engine::automatic), all, checked, converged, 5));
  const std::string name = file.stem().string();
  report(settings.empty() ? name : fmt::format("{} {}", name, fmt::join(settings, " ")), rows,
         json);
}

}  // namespace
}  // namespace portalens

int main(int count, char** words) {
  bool json = false;
  std::vector<std::filesystem::path> scenes;
  std::vector<std::string> settings;
  for (int i = 1; i < count; ++i) {
    if (std::string(words[i]) == "--json")
      json = true;
    else if (std::string(words[i]) == "--set" && i + 1 < count)
      settings.emplace_back(words[++i]);
    else
      scenes.emplace_back(words[i]);
  }
  if (scenes.empty())
    for (const auto& entry : std::filesystem::directory_iterator(PORTALENS_BENCHMARK_SCENES))
      if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  try {
    for (const auto& scene : scenes) portalens::run(scene, settings, json);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
