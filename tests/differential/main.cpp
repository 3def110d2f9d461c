// Random scenes, traced in lanes and by the scalar engine, held to the scalar engine at a tolerance
// of 1e-8: docs/reliability.md tells how to read what comes of it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "differential/minimise.h"
#include "differential/random_scene.h"
#include "differential/table.h"
#include "render/parallel.h"

namespace portalens::differential {
namespace {

struct Request {
  std::uint64_t scenes = 1000, seed = 1;
  std::optional<std::uint64_t> only;
  std::string save;
  std::vector<int> film{48, 32};
  int threads = available_threads();
  double limit = usual_limit;
  std::size_t worst = 20;
  bool json = false, hold = false, minimise = false;
};

Draft scene_of(const Request& request, std::uint64_t index) {
  Draft draft = random_scene(request.seed, index);
  draft.width = request.film.front();
  draft.height = request.film.back();
  return draft;
}

Comparison compare_draft(const Draft& draft, double limit) {
  const SceneFolder folder;
  try {
    return compare(set_up(draft, folder), limit);
  } catch (const SceneError& error) {
    Comparison comparison;
    comparison.reason = error.faults().front().problem;
    return comparison;
  }
}

void save(const Draft& draft, const Request& request, std::uint64_t index) {
  const std::filesystem::path folder = request.save;
  std::filesystem::create_directories(folder);
  if (has_mesh(draft)) std::ofstream(folder / mesh_name) << mesh_text();
  const std::string name = fmt::format("{}-{}", request.seed, index);
  std::ofstream(folder / (name + ".toml"))
      << to_toml(draft, fmt::format("{}: scene {} of seed {}", draft.kind, index, request.seed));
}

/// Makes the worst photon's scene small, and tells how to trace it.
void tell_minimised(const Entry& entry, const Request& request) {
  const Draft draft = scene_of(request, entry.index);
  Find find{draft, {}, entry.comparison.lanes.worst_difference};
  {
    const SceneFolder folder;
    find.photon = set_up(draft, folder).photons[entry.comparison.lanes.worst];
  }
  const Find small = minimised(find);
  const std::string name = fmt::format("{}-{}-small.toml", request.seed, entry.index);
  const std::string text =
      to_toml(small.draft, fmt::format("scene {} of seed {}, made small: {}", entry.index,
                                       request.seed, in_words(small.difference)));
  if (!request.save.empty()) std::ofstream(std::filesystem::path(request.save) / name) << text;
  std::cout << '\n' << text << "# " << trace_command(name, small.photon) << '\n';
}

std::vector<Entry> compare_all(const Request& request) {
  const std::uint64_t first = request.only.value_or(0);
  std::vector<Entry> entries(request.only ? 1 : request.scenes);
  std::atomic<std::size_t> done{0};
  parallel_for(
      entries.size(), request.threads,
      [&](std::size_t i) {
        const Draft draft = scene_of(request, first + i);
        if (!request.save.empty()) save(draft, request, first + i);
        entries[i] = {first + i, draft.kind, compare_draft(draft, request.limit)};
        if (const std::size_t count = ++done; count % 10 == 0 || count == entries.size())
          std::cerr << fmt::format("\r{} of {} scenes", count, entries.size()) << std::flush;
      },
      [] { return false; });
  std::cerr << '\n';
  return entries;
}

int run(const Request& request) {
  const std::vector<Entry> entries = compare_all(request);
  Tally free, rooms;
  for (const Entry& entry : entries) (entry.kind == "room" ? rooms : free).add(entry.comparison);
  if (request.json) {
    std::cout << json_of(entries);
  } else {
    if (free.scenes > 0) std::cout << table_of("free scenes", free) << '\n';
    if (rooms.scenes > 0) std::cout << table_of("rooms", rooms) << '\n';
    const std::vector<Entry> worst = worst_of(entries, request.worst);
    std::cout << kinds_of(entries) << '\n' << lines_of(worst);
    if (request.minimise)
      for (const Entry& entry : worst) tell_minimised(entry, request);
  }
  return request.hold && !holds(free) ? 1 : 0;
}

}  // namespace
}  // namespace portalens::differential

int main(int count, char** words) {
  using namespace portalens::differential;
  Request request;
  CLI::App app("Random scenes: lanes and the scalar engine, held to the scalar engine at 1e-8.");
  app.add_option("-n,--scenes", request.scenes, "How many scenes");
  app.add_option("--seed", request.seed, "Which scenes");
  app.add_option("--only", request.only, "The scene of this number alone")->type_name("INDEX");
  app.add_option("--save", request.save, "Write the scenes there")->type_name("FOLDER");
  app.add_option("--film", request.film, "Photons of a scene")->expected(2)->type_name("W H");
  app.add_option("--threads", request.threads, "Scenes at a time");
  app.add_option("--limit", request.limit, "Seconds that the reference may take for a scene");
  app.add_option("--worst", request.worst, "How many of the worst scenes are told");
  app.add_flag("--minimise", request.minimise, "Make the worst scenes small and print them");
  app.add_flag("--hold", request.hold,
               "Exit with 1 if a row of the free scenes is above its bound");
  app.add_flag("--json", request.json, "Print each scene's numbers as JSON");
  CLI11_PARSE(app, count, words);
  return run(request);
}
