/// \file
/// Lights to try things on.
#pragma once

#include <memory>
#include <vector>

#include "shading/light.h"
#include "support/list_types.h"
#include "support/random.h"
#include "support/spaces.h"

namespace portalens::test {

/// A w × h rectangle in the plane y = `height`, one corner above the origin, as two triangles whose
/// texture coordinates are their place over w and h.
[[nodiscard]] inline Mesh rectangle_mesh(double w, double h, double height) {
  Triangles triangles;
  triangles.positions = {{0, height, 0}, {w, height, 0}, {w, height, h}, {0, height, h}};
  triangles.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  triangles.corners = {{{{0, 0, 0}, {1, 0, 1}, {2, 0, 2}}}, {{{0, 0, 0}, {2, 0, 2}, {3, 0, 3}}}};
  return Mesh(triangles);
}

/// Both triangles emit the same.
[[nodiscard]] inline MeshLight panel(double w, double h, double height, const Texture& emitted) {
  return MeshLight(rectangle_mesh(w, h, height), {emitted}, [](std::uint32_t) { return 0u; });
}

/// The same rectangle, as the back of a portal: its front looks up, and so its back shines down.
[[nodiscard]] inline PortalBackLight back(double w, double h, double height,
                                          const Texture& emitted) {
  const std::vector<Vec3d> a{{0, height, h}, {w, height, h}, {w, height, 0}, {0, height, 0}};
  const std::vector<Vec3d> b{
      {0, height, 50}, {w, height, 50}, {w, height, 50 + h}, {0, height, 50 + h}};
  return PortalBackLight(portal_pair(a, b)[0], emitted);
}

[[nodiscard]] inline Picture gradient() {
  auto image = std::make_shared<Image>(3, 2, 3);
  for (int i = 0; i < 6; ++i)
    for (int c = 0; c < 3; ++c) image->at(i % 3, i / 3)[c] = static_cast<float>((i * i + c) % 7);
  return {image};
}

/// A sky of random pixels, some of them black and some a hundred times brighter than others.
[[nodiscard]] inline Environment random_sky(int width, int height, std::uint64_t seed) {
  Random random(seed);
  auto image = std::make_shared<Image>(width, height, 3);
  for (float& value : image->pixels) {
    value = static_cast<float>(random.uniform(0, 1));
    if (random.uniform(0, 1) < 0.2) value = 0.0f;
    if (random.uniform(0, 1) < 0.1) value *= 100.0f;
  }
  Environment sky;
  sky.image = std::move(image);
  sky.scale = random.point(1) + Vec3d{1.5, 1.5, 1.5};
  sky.rotation = random.uniform(-400, 400);
  return sky;
}

/// One colour all round.
[[nodiscard]] inline Environment even_sky(Rgb color) {
  Environment sky;
  sky.color = color;
  return sky;
}

/// Some lights of each type, within 4 of (0, 3, 0), and of each the share of its power that samples
/// tell from outside: of a closed shape what shines inwards may be missing.
template <class Type>
struct LightSamples {
  static double share_outside(std::size_t /*which*/) { return 1.0; }
  static std::vector<Type> all() {
    Table table{"light", {}, {}};
    table.set("position", value_of({0, 3, 0}));
    table.set("direction", value_of({0, -1, 0}));
    table.set("up", value_of({0, 0, 1}));
    for (const char* key : {"intensity", "color"}) table.set(key, value_of({2, 3, 4}));
    for (const char* key : {"radius", "blend"}) table.set(key, value_of(0.5));
    table.set("angle", value_of(40));
    table.set("size", value_of(1.5));
    return from_common_keys<Type>(table);
  }
};
template <>
struct LightSamples<ShapeLight> {
  static double share_outside(std::size_t which) { return which < 3 ? 0.5 : 1.0; }
  static std::vector<ShapeLight> all() {
    const Texture tiles = Checker{{5, 1, 0}, {0, 2, 1}, 0.3};
    return {ShapeLight(Sphere({0, 3, 0}, 1), Constant{{1, 2, 3}}),
            ShapeLight(Sphere({0, 3, 0}, 1), tiles),
            ShapeLight(Cube({0, 3, 0}, {1, 2, 1}, {10, 20, 30}), tiles),
            ShapeLight(Cylinder({0, 2, 0}, 2, 1, {}), gradient())};
  }
};
template <>
struct LightSamples<MeshLight> {
  static double share_outside(std::size_t /*which*/) { return 1.0; }
  static std::vector<MeshLight> all() {
    return {panel(2, 1, 3, Constant{{1, 2, 3}}), panel(2, 1, 3, gradient()),
            MeshLight(rectangle_mesh(2, 2, 3), {Constant{{5, 0, 0}}, gradient()},
                      [](std::uint32_t face) { return face; }),
            MeshLight(rectangle_mesh(2, 2, 3), {gradient()}, [](std::uint32_t face) {
              return face == 0 ? std::nullopt : std::optional<std::uint32_t>(0);
            })};
  }
};
template <>
struct LightSamples<PortalBackLight> {
  static double share_outside(std::size_t /*which*/) { return 1.0; }
  static std::vector<PortalBackLight> all() {
    return {back(2, 1, 3, Constant{{1, 2, 3}}), back(2, 1, 3, gradient())};
  }
};
template <>
struct LightSamples<SkyLight> {
  static double share_outside(std::size_t /*which*/) { return 1.0; }
  static std::vector<SkyLight> all() {
    return {SkyLight(random_sky(16, 8, 1)), SkyLight(random_sky(7, 5, 2)),
            SkyLight(random_sky(1, 1, 3)), SkyLight(random_sky(2, 3, 4)),
            SkyLight(even_sky({1, 2, 3}))};
  }
};

}  // namespace portalens::test
