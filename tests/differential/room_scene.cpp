#include "differential/room_scene.h"

#include <cmath>

#include "differential/pieces.h"
#include "differential/random_scene.h"

namespace portalens::differential {
namespace {

/// A wall's inner side: x to the right along the floor, y up, z into the room; the origin is the
/// middle of its lower edge.
struct Wall {
  Frame frame;
  double width, height;
};

struct Room {
  double width, height, depth;

  /// Of four, in turn.
  [[nodiscard]] Wall wall(int which) const {
    const double w = 0.5 * width, d = 0.5 * depth;
    const Vec3d up{0, 1, 0};
    switch (which) {
      case 0:
        return {{{0, 0, -d}, {1, 0, 0}, up, {0, 0, 1}}, width, height};
      case 1:
        return {{{w, 0, 0}, {0, 0, 1}, up, {-1, 0, 0}}, depth, height};
      case 2:
        return {{{0, 0, d}, {-1, 0, 0}, up, {0, 0, -1}}, width, height};
      default:
        return {{{-w, 0, 0}, {0, 0, -1}, up, {1, 0, 0}}, depth, height};
    }
  }
};

DraftBody quad(const Frame& frame, double width, double height) {
  DraftBody body;
  body.form = Form::quad;
  for (const Vec3d& corner : rectangle(width, height))
    body.corners.push_back(frame.to_world(corner));
  return body;
}

void add_walls(Draft& draft, const Room& room) {
  for (int i = 0; i < 4; ++i) {
    Wall wall = room.wall(i);
    wall.frame.origin += 0.5 * wall.height * wall.frame.up;
    draft.bodies.push_back(quad(wall.frame, wall.width, wall.height));
  }
  const Vec3d right{1, 0, 0}, back{0, 0, -1}, up{0, 1, 0};
  draft.bodies.push_back(quad({{}, right, back, up}, room.width, room.depth));
  draft.bodies.push_back(quad({{0, room.height, 0}, right, -back, -up}, room.width, room.depth));
}

/// The frame of something `width` by `height` that is flush in the wall.
/// @param lift  of its lower edge above the floor
Frame flush(const Wall& wall, Lot& lot, double width, double height, double lift) {
  const double free = 0.5 * (wall.width - width);
  Frame frame = wall.frame;
  frame.origin += lot.uniform(-free, free) * frame.right + (lift + 0.5 * height) * frame.up;
  return frame;
}

/// Doors, on two walls; a few are windows with more corners, or stand upright in the room.
void add_doors(Draft& draft, const Room& room, Lot& lot) {
  const int pairs = 1 + lot.weighted({3, 1});
  const int first = lot.whole(0, 3);
  for (int i = 0; i < pairs; ++i) {
    const double width = lot.uniform(0.8, 1.3), height = lot.uniform(1.6, 2.2);
    const double lift = lot.chance(0.6) ? 0.0 : lot.uniform(0.05, 0.3);
    const Wall from = room.wall((first + i) % 4), to = room.wall((first + i + 2) % 4);
    const Frame a = flush(from, lot, width, height, lift), b = flush(to, lot, width, height, lift);
    add_pair(draft, rectangle(width, height), a, b);
    if (lot.chance(0.3))
      draft.portals.back().solid_back = draft.portals[draft.portals.size() - 2].solid_back = true;
  }
}

void add_pictures(Draft& draft, const Room& room, Lot& lot) {
  const int count = lot.whole(0, 3);
  for (int i = 0; i < count; ++i) {
    const double size = lot.uniform(0.3, 0.7);
    const Wall wall = room.wall(lot.whole(0, 3));
    DraftBody picture = quad(flush(wall, lot, size, 0.6 * size, 2.3), size, 0.6 * size);
    picture.mirror = lot.chance(0.5);
    // Before the walls or behind them in the list: which of two is shown may not hang on that.
    draft.bodies.insert(lot.chance(0.5) ? draft.bodies.begin() : draft.bodies.end(), picture);
  }
}

void add_contents(Draft& draft, const Room& room, Lot& lot) {
  const auto somewhere = [&](double margin) {
    return Vec3d{lot.uniform(margin - 0.5 * room.width, 0.5 * room.width - margin),
                 lot.uniform(margin, room.height - margin),
                 lot.uniform(margin - 0.5 * room.depth, 0.5 * room.depth - margin)};
  };
  const double influence = lot.logarithmic(0.7, 6.0), compactness = lot.logarithmic(0.003, 0.06);
  const double heaviest = compactness * influence * light_speed2;
  draft.min_force = heaviest / (influence * influence);
  for (int i = lot.whole(1, 3); i > 0; --i) {
    DraftWeight weight{heaviest * lot.logarithmic(0.1, 1.0)};
    if (lot.chance(0.5)) weight.core = influence * lot.logarithmic(0.02, 0.3);
    draft.masses.push_back({somewhere(0.6), weight});
  }
  for (int i = lot.whole(0, 2); i > 0; --i) {
    DraftBody ball;
    ball.size = lot.uniform(0.1, 0.4);
    ball.center = somewhere(0.5);
    if (lot.chance(0.5)) ball.center.y = ball.size;  // it lies on the floor
    draft.bodies.push_back(ball);
  }
}

}  // namespace

Draft room_scene(Lot& lot) {
  static constexpr const char* couplings[] = {"closest-point", "none", "shortest-path",
                                              "graviton-map", "portal-mass"};
  Draft draft;
  draft.kind = room_kind;
  draft.coupling = couplings[lot.weighted({5, 2, 1, 1, 1})];
  draft.depth = 1 + lot.weighted({5, 1});
  draft.tolerance = std::pow(10.0, -lot.whole(3, 5));
  draft.resolution = 8 << lot.whole(0, 2);
  const Room room{lot.uniform(4.0, 8.0), lot.uniform(3.0, 4.0), lot.uniform(4.0, 8.0)};
  add_walls(draft, room);
  add_pictures(draft, room, lot);
  add_contents(draft, room, lot);
  add_doors(draft, room, lot);
  DraftCamera& camera = draft.camera;
  camera.position = {lot.uniform(-0.4, 0.4) * room.width, lot.uniform(0.3, 0.7) * room.height,
                     lot.uniform(-0.4, 0.4) * room.depth};
  const Wall seen = room.wall(lot.whole(0, 3));
  camera.target = seen.frame.origin + lot.uniform(0.5, 2.0) * seen.frame.up +
                  lot.uniform(-0.3, 0.3) * seen.width * seen.frame.right;
  camera.fov = lot.uniform(45.0, 80.0);
  return draft;
}

}  // namespace portalens::differential
