#include "differential/minimise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/error.h"

namespace portalens::differential {
namespace {

using Change = std::function<void(Find&)>;

/// How wrong the photon is in lanes; nothing if the scene is refused, or has none.
std::optional<Difference> difference_in(const Find& find) {
  const SceneFolder folder;
  try {
    const Stage stage = set_up(find.draft, folder);
    if (!takes_lanes(stage.own.space, Engine::automatic)) return std::nullopt;
    Arrival arrival;
    advance(stage.own.space, {&find.photon, 1}, {&arrival, 1}, Engine::automatic);
    return difference_of(stage, find.photon, arrival, exact_arrival(stage, find.photon));
  } catch (const SceneError&) {
    return std::nullopt;
  }
}

bool is_as_wrong(const Difference& now, const Difference& before) {
  if (now.unexplained != before.unexplained || now.other_way != before.other_way) return false;
  return now.other_way || now.tolerances > std::max(1.0, 0.1 * before.tolerances);
}

/// Tries a change, and keeps it if the photon stays wrong.
bool keeps_wrong(Find& find, const Change& change) {
  Find changed = find;
  change(changed);
  const auto difference = difference_in(changed);
  if (!difference || !is_as_wrong(*difference, find.difference)) return false;
  find = std::move(changed);
  return true;
}

template <class Item>
void erase(std::vector<Item>& items, std::size_t first, std::size_t count) {
  const auto begin = items.begin() + static_cast<std::ptrdiff_t>(first);
  items.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
}

/// Drops what can be dropped, from the last to the first.
bool drop_things(Find& find) {
  bool any = false;
  for (std::size_t i = find.draft.masses.size(); i-- > 0;)
    any |= keeps_wrong(find, [&](Find& f) { erase(f.draft.masses, i, 1); });
  for (std::size_t i = find.draft.bodies.size(); i-- > 0;)
    any |= keeps_wrong(find, [&](Find& f) { erase(f.draft.bodies, i, 1); });
  for (std::size_t i = find.draft.portals.size() / 2; i-- > 0;)
    any |= keeps_wrong(find, [&](Find& f) { erase(f.draft.portals, 2 * i, 2); });
  return any;
}

std::vector<DraftWeight*> weights_of(Draft& draft) {
  std::vector<DraftWeight*> weights;
  for (DraftMass& mass : draft.masses) weights.push_back(&mass.weight);
  for (DraftBody& body : draft.bodies) weights.push_back(&body.weight);
  for (DraftPortal& portal : draft.portals) weights.push_back(&portal.weight);
  return weights;
}

/// Takes away what things have, but for the mass of a mass.
void make_things_plain(Find& find) {
  const std::size_t masses = find.draft.masses.size();
  for (std::size_t i = weights_of(find.draft).size(); i-- > 0;) {
    if (weights_of(find.draft)[i]->mass <= 0.0) continue;
    if (i >= masses && keeps_wrong(find, [&](Find& f) { *weights_of(f.draft)[i] = DraftWeight{}; }))
      continue;
    if (weights_of(find.draft)[i]->core > 0.0)
      keeps_wrong(find, [&](Find& f) { weights_of(f.draft)[i]->core = 0.0; });
  }
  for (std::size_t i = 0; i < find.draft.portals.size(); ++i)
    if (find.draft.portals[i].solid_back)
      keeps_wrong(find, [&](Find& f) { f.draft.portals[i].solid_back = false; });
  keeps_wrong(find, [](Find& f) { f.draft.depth = 1; });
  keeps_wrong(find, [](Find& f) { f.draft.resolution = 32; });
  keeps_wrong(find, [](Find& f) { f.draft.coupling = "none"; });
}

/// So many digits of a number.
double rounded(double x, int digits) {
  return x == 0.0 ? x : std::strtod(fmt::format("{:.{}e}", x, digits - 1).c_str(), nullptr);
}

/// As few digits as the photon's way can do with, the fewest first.
void round_numbers(Find& find) {
  const auto shorten = [&](const std::function<void(Find&, int)>& change) {
    for (const int digits : {2, 3, 4, 6})
      if (keeps_wrong(find, [&](Find& f) { change(f, digits); })) return;
  };
  const auto point = [](Vec3d v, int digits) {
    return Vec3d{rounded(v.x, digits), rounded(v.y, digits), rounded(v.z, digits)};
  };
  shorten([&](Find& f, int digits) { f.photon.position = point(f.photon.position, digits); });
  shorten([&](Find& f, int digits) {
    f.photon.direction = normalize(point(f.photon.direction, digits));
  });
  shorten([&](Find& f, int digits) { f.draft.min_force = rounded(f.draft.min_force, digits); });
  for (std::size_t i = 0; i < find.draft.masses.size(); ++i)
    shorten([&](Find& f, int digits) {
      f.draft.masses[i].center = point(f.draft.masses[i].center, digits);
    });
  for (std::size_t i = 0; i < weights_of(find.draft).size(); ++i)
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

}  // namespace

Find minimised(const Find& find) {
  Find small = find;
  look_along(small, length(find.draft.camera.target - find.draft.camera.position));
  while (drop_things(small)) {
  }
  make_things_plain(small);
  drop_things(small);
  round_numbers(small);
  look_along(small, length(find.draft.camera.target - find.draft.camera.position));
  if (const auto difference = difference_in(small)) small.difference = *difference;
  return small;
}

std::string trace_command(const std::string& file, const Photon& photon) {
  const Vec3d x = photon.position, d = photon.direction;
  return fmt::format("portalens trace {} --ray {} {} {}  {} {} {}", file, x.x, x.y, x.z, d.x, d.y,
                     d.z);
}

}  // namespace portalens::differential
