/// \file
/// Shapes to try things on.
#pragma once

#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/shape.h"
#include "support/list_types.h"
#include "support/random.h"

namespace portalens::test {

/// A sphere of triangles: `bands` from pole to pole, twice as many around.
[[nodiscard]] inline Triangles globe(int bands, Vec3d center, double radius, bool smooth) {
  Triangles globe;
  const int around = 2 * bands;
  const auto index = [&](int band, int step) {
    return static_cast<std::uint32_t>(band * around + step % around);
  };
  for (int band = 0; band <= bands; ++band)
    for (int step = 0; step < around; ++step) {
      const double polar = std::numbers::pi * band / bands, turn = std::numbers::pi * step / bands;
      const double across = band == 0 || band == bands ? 0.0 : std::sin(polar);
      const Vec3d normal{across * std::sin(turn), std::cos(polar), across * std::cos(turn)};
      globe.positions.push_back(center + normal * radius);
      if (smooth) globe.normals.push_back(normal);
    }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    globe.corners.push_back({{{a, a, 0}, {b, b, 0}, {c, c, 0}}});
  };
  for (int band = 0; band < bands; ++band)
    for (int step = 0; step < around; ++step) {
      const auto a = index(band, step), b = index(band, step + 1);
      const auto c = index(band + 1, step), d = index(band + 1, step + 1);
      add(a, c, d);
      add(a, d, b);
    }
  return globe;
}

/// A box of twelve triangles, outward.
[[nodiscard]] inline Triangles crate(Vec3d low, Vec3d high) {
  Triangles crate;
  for (int i = 0; i < 8; ++i)
    crate.positions.push_back(
        {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    crate.corners.push_back({{{a, 0, 0}, {b, 0, 0}, {c, 0, 0}}});
    crate.corners.push_back({{{a, 0, 0}, {c, 0, 0}, {d, 0, 0}}});
  };
  add(0, 4, 6, 2), add(1, 3, 7, 5), add(0, 1, 5, 4), add(2, 6, 7, 3), add(0, 2, 3, 1);
  add(4, 5, 7, 6);
  return crate;
}

/// Some shapes of each type in the list, about `at`, no larger than 4.
template <class Type>
struct Samples {
  static std::vector<Type> about(Vec3d at) {
    const auto point = [&](double x, double y, double z) {
      return value_of({at.x + x, at.y + y, at.z + z});
    };
    Table table{std::string(Type::name), {}, {}};
    table.set("center", point(0, 0, 0));
    table.set("base", point(0, -0.5, 0));
    table.set("vertices", {Value::List{point(-1, 0, 1), point(1, 0, 1), point(1, 0, -1)}, {}});
    for (const char* key : {"radius", "outer_radius", "height", "size"})
      table.set(key, value_of(1.0));
    for (const char* key : {"inner_radius", "tube_radius", "thickness"})
      table.set(key, value_of(0.4));
    return from_common_keys<Type>(table);
  }
};

template <>
struct Samples<Sphere> {
  static std::vector<Sphere> about(Vec3d at) {
    return {Sphere(at, 1.5), Sphere(at + Vec3d{0.3, -0.2, 0.5}, 0.01)};
  }
};
template <>
struct Samples<Quad> {
  static std::vector<Quad> about(Vec3d at) {
    const auto quad = [&](std::vector<Vec3d> vertices) {
      for (Vec3d& vertex : vertices) vertex += at;
      return Quad(vertices);
    };
    return {quad({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}),
            quad({{-1, -1, 0.5}, {1.5, -0.5, 0.5}, {1, 1, 0.5}, {-0.5, 0.5, 0.5}}),
            quad({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})};
  }
};
template <>
struct Samples<Cube> {
  static std::vector<Cube> about(Vec3d at) {
    return {Cube(at, {2, 2, 2}, {}), Cube(at, {0.5, 2, 1}, {20, 50, -75})};
  }
};
template <>
struct Samples<Cone> {
  static std::vector<Cone> about(Vec3d at) {
    return {Cone(at, 2, 0.7, {}), Cone(at, 0.4, 1.5, {120, 10, 30})};
  }
};
template <>
struct Samples<Cylinder> {
  static std::vector<Cylinder> about(Vec3d at) {
    return {Cylinder(at, 2, 0.7, {}), Cylinder(at, 0.4, 1.5, {120, 10, 30})};
  }
};
template <>
struct Samples<Ring> {
  static std::vector<Ring> about(Vec3d at) {
    return {Ring(at, 0.3, 0.8, 1.5, {}), Ring(at, 2, 0.9, 1, {120, 10, 30}),
            Ring(at, 1, 0, 1, {5, 6, 7})};
  }
};
template <>
struct Samples<Disk> {
  static std::vector<Disk> about(Vec3d at) {
    return {Disk(at, {0, 1, 0}, 1.5), Disk(at, normalize(Vec3d{1, -2, 0.5}), 0.7)};
  }
};
template <>
struct Samples<Mesh> {
  static std::vector<Mesh> about(Vec3d at) {
    return {Mesh(crate(at - Vec3d{1, 0.5, 1}, at + Vec3d{1, 1, 0.7})),
            Mesh(globe(5, at, 1.2, true))};
  }
};

/// Calls `use` with each sample of each type in the list.
template <class Use, class... Types>
void for_each_sample_of(std::variant<Types...>*, Vec3d at, const Use& use) {
  const auto all_of = [&](const auto& samples) {
    for (const auto& shape : samples) use(shape);
  };
  (all_of(Samples<Types>::about(at)), ...);
}
template <class Use>
void for_each_sample(Vec3d at, const Use& use) {
  for_each_sample_of(static_cast<Shape*>(nullptr), at, use);
}

/// A ray from about 4 away (or from within) to somewhere on or near the shape.
template <class Type>
[[nodiscard]] Ray ray_towards(const Type& shape, Random& random) {
  const Vec3d target = random.uniform(0, 1) < 0.7
                           ? shape.sample(random.uniform(0, 1), random.uniform(0, 1)).position
                           : shape.bounds().middle() + random.point(2);
  const Vec3d from = shape.bounds().middle() + random.point(random.uniform(0, 1) < 0.5 ? 4 : 0.7);
  return {from, normalize(target - from)};
}

}  // namespace portalens::test
