// Random scenes, traced in lanes and by the scalar engine, held to the scalar engine at a tolerance
// of 1e-8; or pictures of such, interpolated and not. docs/differential.md tells how to read what
// comes of it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
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
#include "differential/picture_table.h"
#include "differential/random_scene.h"
#include "differential/table.h"
#include "render/parallel.h"

namespace portalens::differential {
namespace {

struct Request {
  std::uint64_t scenes = 1000, seed = 1;
  std::optional<std::uint64_t> only;
  std::string save;
  std::vector<int> film;
  int threads = available_threads();
  double limit = usual_limit;
  std::size_t worst = 20;
  Engine engine = Engine::automatic;  ///< whose worst is told
  bool picture = false, json = false, hold = false, minimise = false;

  [[nodiscard]] Draft scene(std::uint64_t index) const {
    Draft draft = picture ? random_picture(seed, index) : random_scene(seed, index);
    if (!film.empty()) {
      draft.width = film.front();
      draft.height = film.back();
    }
    return draft;
  }
};

/// Writes a scene file, and what it names, if a folder was given.
void save(const Request& request, const Draft& draft, const std::string& name,
          const std::string& text) {
  if (request.save.empty()) return;
  const std::filesystem::path folder = request.save;
  std::filesystem::create_directories(folder);
  if (has_mesh(draft)) std::ofstream(folder / mesh_name) << mesh_text();
  std::ofstream(folder / name) << text;
}

void save_whole(const Request& request, const Draft& draft, std::uint64_t index) {
  save(request, draft, fmt::format("{}-{}.toml", request.seed, index),
       to_toml(draft, fmt::format("{}: scene {} of seed {}", draft.kind, index, request.seed)));
}

/// Calls `visit(place, index, draft)` for each scene, on several threads.
template <class Visit>
void for_each_scene(const Request& request, std::size_t count, const Visit& visit) {
  const std::uint64_t first = request.only.value_or(0);
  std::atomic<std::size_t> done{0};
  parallel_for(
      count, request.threads,
      [&](std::size_t i) {
        const std::uint64_t index = first + i;
        const Draft draft = request.scene(index);
        if (!request.minimise) save_whole(request, draft, index);
        visit(i, index, draft);
        if (const std::size_t so_far = ++done; so_far % 10 == 0 || so_far == count)
          std::cerr << fmt::format("\r{} of {} scenes", so_far, count) << std::flush;
      },
      [] { return false; });
  std::cerr << '\n';
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

PictureComparison compare_picture(const Draft& draft) {
  const SceneFolder folder;
  try {
    return compare_pictures(set_up(draft, folder));
  } catch (const SceneError&) {
    return {};
  }
}

/// Makes the worst photon's scene small, and tells how to trace it.
void tell_minimised(const Entry& entry, const Request& request) {
  const Draft draft = request.scene(entry.index);
  const Column& column = entry.comparison.of(request.engine);
  Find find{draft, {}, column.worst_difference};
  {
    const SceneFolder folder;
    find.photon = set_up(draft, folder).photons[column.worst];
  }
  const Find small = minimised(find, judged_by(request.engine));
  const std::string name = fmt::format("{}-{}.toml", request.seed, entry.index);
  const std::string comment = fmt::format(
      "{}: scene {} of seed {}, made small; {} {}", draft.kind, entry.index, request.seed,
      request.engine == Engine::automatic ? "in lanes" : "scalar", in_words(small.difference));
  const std::string text = to_toml(small.draft, comment) + answers_of(small, request.engine) +
                           "# " + trace_command(name, small.photon) + "\n";
  save(request, small.draft, name, text);
  std::cout << '\n' << text;
}

/// The table of some scenes, and the worst of them.
void tell(const std::string& title, const std::vector<Entry>& entries, const Request& request) {
  if (entries.empty()) return;
  Tally tally;
  for (const Entry& entry : entries) tally.add(entry.comparison);
  const std::vector<Entry> worst = worst_of(entries, request.engine, request.worst);
  std::cout << table_of(title, tally) << '\n'
            << kinds_of(entries) << '\n'
            << lines_of(worst, request.engine) << '\n';
  if (request.minimise)
    for (const Entry& entry : worst) tell_minimised(entry, request);
}

int run_photons(const Request& request) {
  std::vector<Entry> entries(request.only ? 1 : request.scenes);
  for_each_scene(request, entries.size(),
                 [&](std::size_t place, std::uint64_t index, const Draft& draft) {
                   entries[place] = {index, draft.kind, compare_draft(draft, request.limit)};
                 });
  if (request.json) std::cout << json_of(entries);
  const auto rooms = std::stable_partition(
      entries.begin(), entries.end(), [](const Entry& entry) { return entry.kind != room_kind; });
  const std::vector<Entry> free(entries.begin(), rooms), others(rooms, entries.end());
  if (!request.json) {
    tell("free scenes", free, request);
    tell("rooms", others, request);
  }
  Tally tally;
  for (const Entry& entry : free) tally.add(entry.comparison);
  return request.hold && !holds(tally) ? 1 : 0;
}

int run_pictures(const Request& request) {
  std::vector<PictureEntry> entries(request.only ? 1 : request.scenes);
  for_each_scene(request, entries.size(),
                 [&](std::size_t place, std::uint64_t index, const Draft& draft) {
                   entries[place] = {index, draft.kind, compare_picture(draft)};
                 });
  std::cout << picture_table(entries, request.worst);
  return request.hold && !pictures_hold(entries) ? 1 : 0;
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
  app.add_option("--save", request.save,
                 "Write the scenes there; with --minimise, those made small")
      ->type_name("FOLDER");
  app.add_option("--film", request.film, "Pixels of a scene, if not 48 x 32 (pictures: 480 x 270)")
      ->expected(2)
      ->type_name("W H");
  app.add_option("--threads", request.threads, "Scenes at a time");
  app.add_option("--limit", request.limit, "Seconds that the reference may take for a scene");
  app.add_option("--worst", request.worst, "How many of the worst scenes are told");
  app.add_flag_callback(
      "--scalar", [&] { request.engine = portalens::Engine::scalar; },
      "Tell where the scalar engine is worst, not the lanes");
  app.add_flag("--minimise", request.minimise, "Make the worst scenes small and print them");
  app.add_flag("--picture", request.picture,
               "Pictures: --photons fewer against all, in place of engines against the reference");
  app.add_flag("--hold", request.hold,
               "Exit with 1 if a row of the free scenes is above its bound");
  app.add_flag("--json", request.json, "Print each scene's numbers as JSON");
  CLI11_PARSE(app, count, words);
  return request.picture ? run_pictures(request) : run_photons(request);
}
