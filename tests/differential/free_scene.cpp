#include "differential/free_scene.h"

#include <algorithm>
#include <cmath>

#include "differential/camera_place.h"
#include "differential/pieces.h"

namespace portalens::differential {
namespace {

constexpr double half_box = 5.0;  // where things are, before a scene is placed

void choose_physics(Draft& draft, Lot& lot, double& heaviest) {
  draft.tolerance = std::pow(10.0, -3 - lot.weighted({3, 5, 2}));
  // Of the heaviest mass: its influence, and how compact it is, m / R.
  const double influence = lot.logarithmic(0.8, 5.0), compactness = lot.logarithmic(0.003, 0.15);
  heaviest = compactness * influence * light_speed2;
  draft.min_force = heaviest / (influence * influence);
}

DraftWeight random_weight(const Draft& draft, Lot& lot, double mass) {
  DraftWeight weight{mass};
  const double influence = influence_of(draft, mass), m = mass / light_speed2;
  if (lot.chance(0.2))
    weight.core = influence * lot.logarithmic(0.01, 0.5);
  else if (lot.chance(0.05))
    weight.core = m * lot.logarithmic(0.1, 3.0);
  weight.horizon = weight.core > 0.0 && lot.chance(0.1);
  return weight;
}

void add_masses(Draft& draft, Lot& lot, double heaviest) {
  const bool many = draft.kind == "bare" && lot.chance(0.15);
  const int count = many ? lot.whole(9, 20) : 1 + lot.weighted({5, 4, 2, 1, 0.5, 0.5});
  for (int i = 0; i < count; ++i) {
    const double share = i == 0 ? 1.0 : lot.logarithmic(many ? 0.003 : 0.03, 1.0);
    Vec3d center = lot.point(half_box);
    // Also near the one before: influences within influences, and such as cut each other.
    if (i > 0 && lot.chance(0.4))
      center = draft.masses.back().center + influence_of(draft, draft.masses.back().weight.mass) *
                                                lot.uniform(0.1, 1.2) * lot.direction();
    draft.masses.push_back({center, random_weight(draft, lot, share * heaviest)});
  }
}

/// Where the second member of a pair is: how pairs lie to each other decides what gravity does.
Frame partner_of(const Frame& a, Lot& lot, double size) {
  const Frame about{a.origin, -a.right, a.up, -a.normal};
  const auto moved = [&](double along) {
    Frame b = about;
    b.origin = a.origin + along * a.normal + lot.uniform(0.0, 0.4) * size * a.right;
    return b;
  };
  switch (lot.weighted({0.4, 0.15, 0.15, 0.15, 0.15})) {
    case 0:
      return lot.frame(lot.point(half_box));
    case 1:  // back to back
      return moved(-size * lot.logarithmic(0.02, 1.0));
    case 2:  // facing each other
      return moved(size * lot.logarithmic(0.2, 4.0));
    case 3: {  // beside each other, to the same side
      Frame b = a;
      b.origin = a.origin + lot.uniform(2.1, 4.0) * size * a.right +
                 lot.uniform(-0.5, 0.5) * size * a.normal;
      return b;
    }
    default:  // near, anyhow
      return lot.frame(a.origin + size * lot.uniform(1.5, 3.0) * lot.direction());
  }
}

/// Not far from one of the masses; half of them face it.
Frame frame_near_a_mass(const Draft& draft, Lot& lot, double size) {
  const int last = static_cast<int>(draft.masses.size()) - 1;
  const DraftMass& mass = draft.masses[static_cast<std::size_t>(lot.whole(0, last))];
  const double nearest = std::max(0.5 * size, 0.25 * influence_of(draft, mass.weight.mass));
  const Vec3d away = lot.direction();
  const Vec3d origin = mass.center + nearest * lot.logarithmic(1.0, 5.0) * away;
  return lot.chance(0.5) ? lot.frame(origin) : lot.frame(origin, -away);
}

/// Masses of the members of the last pair. What acts through a face is not bounded where the
/// partner weighs, if its closest points count: of such there are few, and they weigh less.
void add_weights(Draft& draft, Lot& lot, double heaviest) {
  const bool unbounded = draft.coupling == "closest-point" || draft.coupling == "graviton-map";
  if (!draft.masses.empty() && !lot.chance(unbounded ? 0.12 : 0.3)) return;
  for (std::size_t i = draft.portals.size() - 2; i < draft.portals.size(); ++i)
    if (lot.chance(0.75))
      draft.portals[i].weight.mass = heaviest * lot.logarithmic(0.02, unbounded ? 0.2 : 1.0);
}

void add_portals(Draft& draft, Lot& lot, double heaviest) {
  const int pairs = 1 + lot.weighted({6, 2, draft.depth < 3 ? 1.0 : 0.0});
  // Circles alone, too: behind these light is hardest to follow.
  const bool circles =
      draft.coupling != "graviton-map" && draft.coupling != "shortest-path" && lot.chance(0.2);
  if (circles) draft.depth = std::min(draft.depth, 1);
  for (int i = 0; i < pairs; ++i) {
    const double size = lot.logarithmic(0.4, 3.0);
    Frame a = lot.frame(lot.point(half_box));
    if (!draft.masses.empty() && lot.chance(0.25)) a = frame_near_a_mass(draft, lot, size);
    const bool rectangular = draft.coupling == "graviton-map" || draft.coupling == "shortest-path";
    const auto polygon = circles ? rectangle(1.4 * size, 1.4 * size)
                         : rectangular && lot.chance(0.8)
                             ? rectangle(1.4 * size, 1.4 * size * lot.logarithmic(0.25, 1.0))
                             : random_polygon(lot, size);
    add_pair(draft, polygon, a, partner_of(a, lot, size));
    add_weights(draft, lot, heaviest);
    if (circles || (is_rectangle(polygon) && lot.chance(0.3)))
      for (std::size_t k = draft.portals.size() - 2; k < draft.portals.size(); ++k)
        draft.portals[k].round = true;
    for (std::size_t k = draft.portals.size() - 2; k < draft.portals.size(); ++k)
      draft.portals[k].solid_back = lot.chance(0.15);
  }
}

DraftBody random_body(Draft& draft, Lot& lot, double heaviest) {
  DraftBody body;
  body.form = static_cast<Form>(lot.weighted({5, 3, 1, 1}));
  body.center = lot.point(half_box);
  body.size = lot.logarithmic(0.05, 1.5);
  body.turn = lot.point(180.0);
  body.mirror = lot.chance(0.2);
  if (body.form == Form::quad) {
    const Frame frame = lot.frame(body.center);
    for (const Vec3d& corner : rectangle(2.0 * body.size, 2.0 * body.size * lot.uniform(0.2, 1.0)))
      body.corners.push_back(frame.to_world(corner));
  } else if (lot.chance(0.25)) {
    body.weight = random_weight(draft, lot, heaviest * lot.logarithmic(0.03, 1.0));
    if (body.form == Form::sphere)
      body.size = influence_of(draft, body.weight.mass) * lot.uniform(0.1, 0.9);
  }
  return body;
}

void add_surfaces(Draft& draft, Lot& lot, double heaviest) {
  const int count = lot.weighted({5, 2, 2, 1, 1});
  for (int i = 0; i < count; ++i) draft.bodies.push_back(random_body(draft, lot, heaviest));
  if (lot.chance(0.15)) {
    const double y = -half_box * lot.uniform(0.5, 1.2), far = half_box * lot.logarithmic(1.0, 10.0);
    DraftBody floor;
    floor.form = Form::quad;
    floor.corners = {{-far, y, far}, {far, y, far}, {far, y, -far}, {-far, y, -far}};
    draft.bodies.push_back(floor);
  }
}

}  // namespace

Draft free_scene(Lot& lot) {
  static constexpr const char* couplings[] = {"none", "closest-point", "shortest-path",
                                              "graviton-map", "portal-mass"};
  Draft draft;
  const int kind = lot.weighted({0.24, 0.32, 0.1, 0.14, 0.14, 0.06});
  draft.coupling = kind == 0 ? "none" : couplings[kind % 5];
  draft.kind = kind == 0 ? "bare" : draft.coupling;
  draft.depth = lot.weighted({0.3, 6.5, 1.7, 0.8});
  if (draft.coupling == "shortest-path" && lot.chance(0.8)) draft.depth = 1;
  draft.resolution = 4 << lot.whole(1, 3);
  double heaviest = 0.0;
  choose_physics(draft, lot, heaviest);
  const bool through = kind != 0;
  if (!through || lot.chance(0.95)) add_masses(draft, lot, heaviest);
  if (through) add_portals(draft, lot, heaviest);
  add_surfaces(draft, lot, heaviest);
  place_camera(draft, lot, half_box);
  return draft;
}

}  // namespace portalens::differential
