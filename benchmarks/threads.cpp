// What do two threads gain over one? Median of nine runs each, taken in turn, after it was checked
// that both take the same picture to the bit. Where others work on the machine, the wall time tells
// little; what all threads take together tells then: as much as one thread alone, and nothing is
// wasted.
//
//     bench_threads [--json | --markdown] [--size N] [--rounds N] [scene ...]
#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "support/clock.h"
#include "support/command.h"
#include "support/picture.h"
#include "support/subject.h"

namespace portalens::benchmarks {
namespace {

/// The times of one run, seconds.
struct Run {
  double wall, processor;
};

Run run(const World& world, int threads) {
  const double wall = wall_seconds(), processor = processor_seconds();
  (void)take_picture(world, threads);
  return {wall_seconds() - wall, processor_seconds() - processor};
}

bool same_bits(const Image& a, const Image& b) {
  return a.width == b.width && a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

void measure(const std::filesystem::path& file, int side, int rounds, Table& table) {
  const Subject subject = read_subject(file, square_film(side));
  if (!same_bits(take_picture(subject.world, 1).image, take_picture(subject.world, 2).image))
    throw WorkError("two threads take another picture than one: not timed");
  std::vector<double> walls, speed_ups, shares;
  for (int round = 0; round < rounds; ++round) {
    const Run one = run(subject.world, 1), two = run(subject.world, 2);
    walls.push_back(one.wall);
    speed_ups.push_back(one.wall / two.wall);
    shares.push_back(two.processor / one.processor);
  }
  const std::string name = fmt::format("{} {}²", file.stem().string(), side);
  table.add("threads/" + name, {name, median(walls), median(speed_ups), median(shares), 0.0, 0.0});
}

}  // namespace
}  // namespace portalens::benchmarks

int main(int count, char** words) {
  namespace benchmarks = portalens::benchmarks;
  benchmarks::Command command("What do two threads gain over one?");
  int side = 512, rounds = 9;
  std::vector<std::string> scenes;
  command.options()
      .add_option("--size", side, "pixels along the picture's sides")
      ->check(CLI::Range(8, 8192))
      ->capture_default_str();
  command.options()
      .add_option("--rounds", rounds, "runs with each number of threads")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command.options().add_option("scenes", scenes, "scene files");
  return command.run(count, words, [&](const benchmarks::Request& request) {
    if (scenes.empty())
      for (const char* name : {"figure-7.toml", "one-hole.toml"})
        scenes.push_back(std::string(PORTALENS_BENCHMARK_SCENES) + "/" + name);
    benchmarks::Table table("two threads beside one",
                            {{"", ""},
                             {"one thread, s", "seconds", "{:.3f}"},
                             {"times as fast", "ratio", "{:.2f}"},
                             {"processor time", "processor_ratio", "{:.2f}"},
                             {"max px", "error_max_px"},
                             {"mismatch", "mismatch"}});
    for (const std::string& scene : scenes) benchmarks::measure(scene, side, rounds, table);
    table.print(request.style);
    return 0;
  });
}
