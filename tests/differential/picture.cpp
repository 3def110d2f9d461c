#include "differential/picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "differential/free_scene.h"
#include "differential/pieces.h"
#include "differential/way.h"
#include "portal/portal.h"
#include "render/render.h"
#include "render/sampling_grid.h"

namespace portalens::differential {
namespace {

/// The camera of a draft, as a place to put things before.
struct View {
  Frame frame;   ///< its normal points to what is seen
  double pixel;  ///< angle, radians
  Vec3d half;    ///< of the picture, as tangents

  explicit View(const Draft& draft) {
    const DraftCamera& camera = draft.camera;
    const Vec3d forward = normalize(camera.target - camera.position);
    const Vec3d right = normalize(cross(forward, camera.up));
    frame = {camera.position, right, cross(right, forward), forward};
    const double angle = camera.fov * std::numbers::pi / 180.0;
    pixel = angle / draft.height;
    const double high = std::tan(0.5 * angle);
    half = {high * draft.width / draft.height, high, 1.0};
  }
  /// Anywhere in the picture, that far off.
  [[nodiscard]] Vec3d place(Lot& lot, double distance) const {
    const double x = lot.uniform(-0.9, 0.9), y = lot.uniform(-0.9, 0.9);
    return frame.to_world(distance * Vec3d{x * half.x, y * half.y, 1.0});
  }
};

/// Anywhere in the picture, behind a mass that bends its image to an arc, or before a portal.
Vec3d place_of_ball(const Draft& draft, Lot& lot, const View& view, double far) {
  const auto any_of = [&](std::size_t count) {
    return static_cast<std::size_t>(lot.whole(0, static_cast<int>(count) - 1));
  };
  const int where = lot.weighted({0.5, 0.3, 0.2});
  if (where == 1 && !draft.masses.empty()) {
    const DraftMass& mass = draft.masses[any_of(draft.masses.size())];
    const double influence = influence_of(draft, mass.weight.mass);
    const Vec3d behind = normalize(mass.center - view.frame.origin);
    return mass.center + influence * (lot.logarithmic(0.3, 4.0) * behind + lot.point(0.1));
  }
  if (where == 2 && !draft.portals.empty()) {
    const std::vector<Vec3d>& corners = draft.portals[any_of(draft.portals.size())].corners;
    const Frame frame = polygon_frame(corners);
    const double size = length(corners[1] - corners[0]);
    return frame.origin + size * (lot.logarithmic(0.5, 5.0) * frame.normal + lot.point(0.3));
  }
  return view.place(lot, far * lot.logarithmic(0.2, 3.0));
}

void add_balls(Draft& draft, Lot& lot, const View& view, double far) {
  for (int i = lot.whole(4, 12); i > 0; --i) {
    DraftBody ball;
    ball.center = place_of_ball(draft, lot, view, far);
    const double distance = length(ball.center - view.frame.origin);
    ball.size = std::min(0.5 * distance, distance * view.pixel * lot.logarithmic(0.4, 3.0));
    draft.bodies.push_back(ball);
  }
}

void add_strips(Draft& draft, Lot& lot, const View& view, double far) {
  for (int i = lot.whole(1, 4); i > 0; --i) {
    const double distance = far * lot.logarithmic(0.2, 3.0), pixel = distance * view.pixel;
    const Frame frame = lot.frame(view.place(lot, distance), -view.frame.normal);
    DraftBody strip;
    strip.form = Form::quad;
    for (const Vec3d& corner :
         rectangle(pixel * lot.logarithmic(10.0, 200.0), pixel * lot.logarithmic(0.4, 3.0)))
      strip.corners.push_back(frame.to_world(corner));
    draft.bodies.push_back(strip);
  }
}

void add_far_portals(Draft& draft, Lot& lot, const View& view, double far) {
  if (draft.portals.size() > 4 || lot.chance(0.5)) return;
  const double distance = far * lot.logarithmic(1.0, 5.0);
  const double size = distance * view.pixel * lot.logarithmic(3.0, 30.0);
  const Vec3d towards = normalize(-view.frame.normal + 0.7 * lot.direction());
  add_pair(draft, rectangle(size, size * lot.uniform(0.5, 1.0)),
           lot.frame(view.place(lot, distance), towards),
           lot.frame(view.place(lot, far * lot.logarithmic(0.5, 5.0))));
}

/// The places of its pixels' centres.
std::vector<FilmPlace> places_of(const Film& film) {
  std::vector<FilmPlace> places;
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x) places.push_back({x + 0.5, y + 0.5});
  return places;
}

/// Whether one of the photons through a pixel and its neighbours went that way.
bool is_known(const Arrival& arrival, const std::vector<Arrival>& all, const Film& film, int x,
              int y) {
  for (int v = std::max(0, y - 1); v <= std::min(film.height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(film.width - 1, x + 1); ++u)
      if (same_way(arrival, all[static_cast<std::size_t>(v) * film.width + u])) return true;
  return false;
}

/// Whether the same surface was hit at another place, farther off than this share of the path.
bool is_misplaced(const Arrival& found, const Arrival& own, double share) {
  return own.fate == Fate::hit && length(found.position - own.position) > share * own.length;
}

}  // namespace

Draft random_picture(std::uint64_t seed, std::uint64_t index) {
  Lot lot(seed, index);
  Draft draft = free_scene(lot);
  draft.width = 480;
  draft.height = 270;
  const View view(draft);
  const double far = length(draft.camera.target - draft.camera.position);
  add_balls(draft, lot, view, far);
  add_strips(draft, lot, view, far);
  add_far_portals(draft, lot, view, far);
  place_somewhere(draft, lot);
  return draft;
}

PictureComparison compare_pictures(const Stage& stage) {
  PictureComparison comparison;
  const World& world = stage.own;
  comparison.interpolates = interpolates(world, {});
  if (!comparison.interpolates) return comparison;
  std::vector<Arrival> all(stage.photons.size()), fewer(stage.photons.size());
  advance(world.space, stage.photons, all);
  const auto guard = BeamGuard::over(world.space);
  Tally tally;
  const Film& film = world.film;
  SamplingGrid(world, *guard, {0, 0, film.width, film.height})
      .advance(places_of(film), fewer, tally);
  comparison.pixels = all.size();
  comparison.interpolated = tally.interpolated;
  const double tolerance = world.space.physics.tolerance;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int x = static_cast<int>(i) % film.width, y = static_cast<int>(i) / film.width;
    const bool other_way = !same_way(fewer[i], all[i]);
    const bool far_off = !other_way && direction_apart(fewer[i], all[i]) > 10.0 * tolerance;
    const bool stranger = other_way && !is_known(fewer[i], all, film, x, y);
    comparison.other_way += other_way;
    comparison.over10 += far_off;
    comparison.misplaced += !other_way && is_misplaced(fewer[i], all[i], 10.0 * tolerance);
    comparison.strangers += stranger;
    if ((stranger && comparison.strangers == 1) ||
        ((other_way || far_off) && comparison.worst_x < 0)) {
      comparison.worst_x = x;
      comparison.worst_y = y;
    }
  }
  return comparison;
}

}  // namespace portalens::differential
