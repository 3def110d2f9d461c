/// \file
/// Random rooms whose walls bear doors, pictures, mirrors and rugs in their own planes, with boxes
/// that stand on them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "support/random.h"
#include "support/spaces.h"

namespace portalens::test {

/// A rectangle, or any convex polygon, in the plane of a wall.
struct Hung {
  std::vector<Vec3d> vertices;  ///< counter-clockwise seen from where the wall's normal points
  bool portal = false;
  bool faces_out = false;   ///< of a portal: its front looks against the wall's normal
  bool two_sided = false;   ///< of a portal
  bool mirror = false;      ///< of a surface
  double extent = 0.0;      ///< of a surface: the diagonal of its box
  std::size_t item = 0;     ///< of a surface: which of the shapes, before they are put in order
  std::uint32_t index = 0;  ///< among the shapes, or among the portals
  std::uint32_t pair = 0;   ///< of a portal: the index of the other
};

struct Wall {
  Vec3d origin, right, up, normal;
  std::vector<Hung> things;  ///< itself among them
};

struct FlatRoom {
  std::vector<Wall> walls;
  std::vector<Shape> shapes;
  std::vector<Portal> portals;
  std::vector<bool> mirrors;  ///< of each shape
  double size = 1.0;          ///< half an edge
  Vec3d middle;
};

/// A room that is turned at random, of that size and about that far from the origin.
class RoomBuilder {
 public:
  RoomBuilder(std::uint64_t seed, double size, double away) : random_(seed) {
    room_.size = size;
    room_.middle = random_.direction() * away;
    const Vec3d x = random_.direction(), y = normalize(cross(x, random_.direction()));
    axes_ = {x, y, cross(x, y)};
  }

  [[nodiscard]] FlatRoom build() && {
    for (int i = 0; i < 6; ++i) add_wall(i);
    const int pairs = pick(4), pictures = 2 + pick(6);
    for (int i = 0; i < pairs; ++i) add_pair();
    for (int i = 0; i < pictures; ++i) hang_picture();
    for (int i = pick(3); i > 0; --i) stand_box();
    list_shapes();
    return std::move(room_);
  }

 private:
  struct Rectangle {
    double x, y, half_width, half_height;  ///< shares of the wall's half edge
  };

  int pick(int count) { return static_cast<int>(random_.uniform(0, count)); }

  void add_wall(int which) {
    const double sign = which % 2 == 0 ? 1.0 : -1.0;
    const int a = which / 2;
    Wall wall;
    wall.normal = axes_[a] * -sign;
    wall.right = axes_[(a + 1) % 3];
    wall.up = cross(wall.normal, wall.right);
    wall.origin = room_.middle + axes_[a] * (sign * room_.size);
    room_.walls.push_back(wall);
    hang_quad(room_.walls.back(), {0, 0, 1, 1}, false);
  }

  void hang_quad(Wall& wall, const Rectangle& rectangle, bool mirror) {
    Hung thing;
    thing.mirror = mirror;
    thing.item = items_.size();
    items_.emplace_back(Quad(hang(wall, rectangle, thing).vertices));
  }

  [[nodiscard]] std::vector<Vec3d> corners(const Wall& wall, const Rectangle& r) const {
    std::vector<Vec3d> v;
    for (const auto& [i, j] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      v.push_back(wall.origin + wall.right * (room_.size * (r.x + i * r.half_width)) +
                  wall.up * (room_.size * (r.y + j * r.half_height)));
    return v;
  }

  static Hung& hang(Wall& wall, std::vector<Vec3d> vertices, Hung thing) {
    thing.vertices = std::move(vertices);
    Box box;
    for (const Vec3d& vertex : thing.vertices) box.add(vertex);
    thing.extent = box.diagonal();
    return wall.things.emplace_back(std::move(thing));
  }
  Hung& hang(Wall& wall, const Rectangle& rectangle, const Hung& thing) {
    return hang(wall, corners(wall, rectangle), thing);
  }

  /// Somewhere on the wall; now and then down to its lower edge.
  Rectangle place(double half_width, double half_height) {
    const double x = random_.uniform(half_width - 1, 1 - half_width);
    const bool on_the_floor = pick(3) == 0;
    const double y =
        on_the_floor ? half_height - 1 : random_.uniform(half_height - 1, 1 - half_height);
    return {x, y, half_width, half_height};
  }

  void hang_picture() {
    const Rectangle rectangle = place(random_.uniform(0.1, 0.6), random_.uniform(0.1, 0.6));
    hang_quad(room_.walls[pick(6)], rectangle, pick(3) == 0);
  }

  /// The wall in that plane, which is added if there is none.
  Wall& wall_along(Vec3d place, Vec3d normal) {
    for (Wall& wall : room_.walls)
      if (std::fabs(dot(wall.normal, normal)) > 0.9 &&
          std::fabs(dot(place - wall.origin, wall.normal)) < 1e-5 * room_.size)
        return wall;
    return room_.walls.emplace_back(Wall{place, {}, {}, normal, {}});
  }

  /// Of triangles; its bottom lies in the plane of a wall.
  void stand_box() {
    const auto on = static_cast<std::size_t>(pick(6));
    const Rectangle box = place(random_.uniform(0.1, 0.3), random_.uniform(0.1, 0.3));
    const std::vector<Vec3d> bottom = corners(room_.walls[on], box);
    const Vec3d upwards = room_.walls[on].normal, rise = upwards * (0.5 * room_.size);
    Hung thing;
    thing.item = items_.size();
    Triangles sides;
    const auto add = [&](std::vector<Vec3d> face, Vec3d outwards) {
      const auto first = static_cast<std::uint32_t>(sides.positions.size());
      sides.positions.insert(sides.positions.end(), face.begin(), face.end());
      for (const std::uint32_t k : {1u, 2u})
        sides.corners.push_back({{{first, 0, 0}, {first + k, 0, 0}, {first + k + 1, 0, 0}}});
      Wall& wall = wall_along(face[0], outwards);
      if (dot(wall.normal, outwards) < 0.0) std::reverse(face.begin(), face.end());
      hang(wall, std::move(face), thing);
    };
    add(bottom, upwards);
    std::vector<Vec3d> top;
    for (const Vec3d& corner : bottom) top.push_back(corner + rise);
    add(top, upwards);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t k = (i + 1) % 4;
      add({bottom[i], bottom[k], top[k], top[i]}, normalize(cross(bottom[k] - bottom[i], upwards)));
    }
    items_.emplace_back(Mesh(std::move(sides)));
  }

  void add_pair() {
    const double half_width = random_.uniform(0.1, 0.4), half_height = random_.uniform(0.1, 0.4);
    const auto first = static_cast<std::uint32_t>(room_.portals.size());
    const bool two_sided = pick(3) == 0;
    room_.portals.resize(first + 2);
    for (std::uint32_t i = first; i < first + 2; ++i) {
      Hung thing;
      thing.portal = true;
      thing.faces_out = pick(4) == 0;
      thing.two_sided = two_sided;
      thing.index = i;
      thing.pair = i == first ? first + 1 : first;
      const Hung& hung = hang(room_.walls[pick(6)], place(half_width, half_height), thing);
      Portal& portal = room_.portals[i];
      std::vector<Vec3d> corners = hung.vertices;
      if (hung.faces_out) std::reverse(corners.begin(), corners.end());
      // A rectangle keeps its size that way, but its first edge must be one of the same length.
      portal.two_sided = two_sided;
      portal.pair = thing.pair;
      give_face(portal, polygon_input(std::move(corners)));
    }
    for (std::uint32_t i = first; i < first + 2; ++i)
      room_.portals[i].passage = RigidPassage(
          motion_through(room_.portals[i].frame, room_.portals[room_.portals[i].pair].frame));
  }

  /// In any order.
  void list_shapes() {
    std::vector<std::size_t> order(items_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[random_.bits() % i]);
    std::vector<std::uint32_t> index(items_.size());
    for (const std::size_t item : order) {
      index[item] = static_cast<std::uint32_t>(room_.shapes.size());
      room_.shapes.push_back(items_[item]);
    }
    room_.mirrors.resize(items_.size());
    for (Wall& wall : room_.walls)
      for (Hung& thing : wall.things) {
        if (thing.portal) continue;
        thing.index = index[thing.item];
        if (thing.mirror) room_.mirrors[thing.index] = true;
      }
  }

  Random random_;
  std::array<Vec3d, 3> axes_;
  std::vector<Shape> items_;
  FlatRoom room_;
};

}  // namespace portalens::test
