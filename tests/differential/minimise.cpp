#include "differential/minimise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"

namespace portalens::differential {
namespace {

/// What a photon comes to by an engine, and by the reference.
struct Answers {
  Arrival found, exact;
  Difference difference;
};

/// Nothing if the scene is refused, or has no lanes: it would be another scene then.
std::optional<Answers> answers_in(const Find& find, Engine engine) {
  const SceneFolder folder;
  try {
    const Stage stage = set_up(find.draft, folder);
    if (!takes_lanes(stage.own.space, Engine::automatic)) return std::nullopt;
    Answers answers;
    advance(stage.own.space, {&find.photon, 1}, {&answers.found, 1}, engine);
    answers.exact = exact_arrival(stage, find.photon);
    answers.difference = difference_of(stage, find.photon, answers.found, answers.exact);
    return answers;
  } catch (const SceneError&) {
    return std::nullopt;
  }
}

bool is_as_wrong(const Difference& now, const Difference& before) {
  if (now.unexplained != before.unexplained || now.other_way != before.other_way) return false;
  return now.other_way || now.tolerances > std::max(1.0, 0.1 * before.tolerances);
}

template <class Item>
void erase(std::vector<Item>& items, std::size_t first, std::size_t count) {
  const auto begin = items.begin() + static_cast<std::ptrdiff_t>(first);
  items.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
}

std::vector<DraftWeight*> weights_of(Draft& draft) {
  std::vector<DraftWeight*> weights;
  for (DraftMass& mass : draft.masses) weights.push_back(&mass.weight);
  for (DraftBody& body : draft.bodies) weights.push_back(&body.weight);
  for (DraftPortal& portal : draft.portals) weights.push_back(&portal.weight);
  return weights;
}

/// So many digits of a number.
double rounded(double x, int digits) {
  return x == 0.0 ? x : std::strtod(fmt::format("{:.{}e}", x, digits - 1).c_str(), nullptr);
}

/// A find that is made smaller, step by step.
class Minimiser {
 public:
  Minimiser(const Find& find, const Judge& judge) : find_(find), judge_(judge) {}

  /// Drops what can be dropped, from the last to the first.
  bool drop_things();
  /// Takes away what things have, but for the mass of a mass, and what is unusual of the settings.
  void make_things_plain();
  /// As few digits as the photon's path can do with, the fewest first.
  void round_numbers();

  [[nodiscard]] const Find& find() const { return find_; }

 private:
  /// Tries a change, and keeps it if the photon stays wrong.
  template <class Change>
  bool keeps_wrong(const Change& change);
  /// Tries a change with ever more digits.
  template <class Change>
  void shorten(const Change& change);

  Find find_;
  const Judge& judge_;
};

template <class Change>
bool Minimiser::keeps_wrong(const Change& change) {
  Find changed = find_;
  change(changed);
  const auto difference = judge_(changed);
  if (!difference || !is_as_wrong(*difference, find_.difference)) return false;
  find_ = std::move(changed);
  return true;
}

template <class Change>
void Minimiser::shorten(const Change& change) {
  for (const int digits : {2, 3, 4, 6})
    if (keeps_wrong([&](Find& f) { change(f, digits); })) return;
}

bool Minimiser::drop_things() {
  bool any = false;
  for (std::size_t i = find_.draft.masses.size(); i-- > 0;)
    any |= keeps_wrong([&](Find& f) { erase(f.draft.masses, i, 1); });
  // What starts on a body knows it by its place among them.
  const bool starts_on_one = find_.photon.guard.shape != no_object;
  for (std::size_t i = starts_on_one ? 0 : find_.draft.bodies.size(); i-- > 0;)
    any |= keeps_wrong([&](Find& f) { erase(f.draft.bodies, i, 1); });
  for (std::size_t i = find_.draft.portals.size() / 2; i-- > 0;)
    any |= keeps_wrong([&](Find& f) { erase(f.draft.portals, 2 * i, 2); });
  return any;
}

void Minimiser::make_things_plain() {
  const std::size_t masses = find_.draft.masses.size();
  for (std::size_t i = weights_of(find_.draft).size(); i-- > 0;) {
    if (weights_of(find_.draft)[i]->mass <= 0.0) continue;
    if (i >= masses && keeps_wrong([&](Find& f) { *weights_of(f.draft)[i] = DraftWeight{}; }))
      continue;
    if (weights_of(find_.draft)[i]->core > 0.0)
      keeps_wrong([&](Find& f) { weights_of(f.draft)[i]->core = 0.0; });
  }
  for (std::size_t i = 0; i < find_.draft.portals.size(); ++i)
    if (find_.draft.portals[i].solid_back)
      keeps_wrong([&](Find& f) { f.draft.portals[i].solid_back = false; });
  keeps_wrong([](Find& f) { f.draft.depth = 1; });
  keeps_wrong([](Find& f) { f.draft.resolution = 32; });
  keeps_wrong([](Find& f) { f.draft.coupling = "none"; });
}

void Minimiser::round_numbers() {
  const auto point = [](Vec3d v, int digits) {
    return Vec3d{rounded(v.x, digits), rounded(v.y, digits), rounded(v.z, digits)};
  };
  shorten([&](Find& f, int digits) { f.photon.position = point(f.photon.position, digits); });
  shorten([&](Find& f, int digits) {
    f.photon.direction = normalize(point(f.photon.direction, digits));
  });
  shorten([&](Find& f, int digits) { f.draft.min_force = rounded(f.draft.min_force, digits); });
  for (std::size_t i = 0; i < find_.draft.masses.size(); ++i)
    shorten([&](Find& f, int digits) {
      f.draft.masses[i].center = point(f.draft.masses[i].center, digits);
    });
  for (std::size_t i = 0; i < weights_of(find_.draft).size(); ++i)
    shorten([&](Find& f, int digits) {
      DraftWeight& weight = *weights_of(f.draft)[i];
      weight.mass = rounded(weight.mass, digits);
      weight.core = rounded(weight.core, digits);
    });
}

/// The camera where the photon starts, looking along it.
void look_along(Find& find, double distance) {
  DraftCamera& camera = find.draft.camera;
  const Vec3d direction = find.photon.direction;
  camera.position = find.photon.position;
  camera.target = camera.position + distance * direction;
  camera.up = std::fabs(direction.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
}

std::string in_words(const Arrival& arrival) {
  const Vec3d d = arrival.direction;
  return fmt::format("{} after {} crossings, turning {:.6g}, direction {:.9g} {:.9g} {:.9g}",
                     fate_names[static_cast<std::size_t>(arrival.fate)], arrival.crossings,
                     arrival.turning, d.x, d.y, d.z);
}

}  // namespace

std::string answers_of(const Find& find, Engine engine) {
  const auto answers = answers_in(find, engine);
  if (!answers) return {};
  return fmt::format("# {}: {}\n# right: {}\n", engine == Engine::automatic ? "lanes" : "scalar",
                     in_words(answers->found), in_words(answers->exact));
}

Judge judged_by(Engine engine) {
  return [engine](const Find& find) -> std::optional<Difference> {
    const auto answers = answers_in(find, engine);
    if (!answers) return std::nullopt;
    return answers->difference;
  };
}

Find minimised(const Find& find, const Judge& judge) {
  const double ahead = length(find.draft.camera.target - find.draft.camera.position);
  Find start = find;
  look_along(start, ahead);
  Minimiser minimiser(start, judge);
  while (minimiser.drop_things()) {
  }
  minimiser.make_things_plain();
  minimiser.drop_things();
  minimiser.round_numbers();
  Find small = minimiser.find();
  look_along(small, ahead);
  if (const auto difference = judge(small)) small.difference = *difference;
  return small;
}

std::string trace_command(const std::string& file, const Photon& photon) {
  const Vec3d x = photon.position, d = photon.direction;
  return fmt::format("portalens trace {} --ray {} {} {}  {} {} {}", file, x.x, x.y, x.z, d.x, d.y,
                     d.z);
}

}  // namespace portalens::differential
