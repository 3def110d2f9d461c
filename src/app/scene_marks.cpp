#include "app/scene_marks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/outline.h"
#include "app/portal_color.h"

namespace portalens {
namespace {

/// Names at the places of things are left out of a drawing with more of them.
constexpr std::size_t max_names = 40;

Color faint_color(const Material& material) {
  const Rgb color = std::visit([](const auto& bsdf) { return bsdf.color(); }, material.bsdf());
  return color_from_linear(color + brightest(material.emitted())).with_alpha(0.13);
}

void add_surfaces(const World& world, Sheet& sheet) {
  const auto& shapes = world.space.surfaces.shapes();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Outline outline = outline_of(shapes[i], sheet.view());
    const Body& body = world.appearance.bodies[i];
    const Color fill = faint_color(world.appearance.materials[body.material]);
    for (const auto& face : outline.faces) sheet.add_area(face, fill, "surface");
    sheet.add_lines(outline.grid, {ink::surface.with_alpha(0.45), 0.7}, "surface grid");
    sheet.add_lines(outline.edges, {ink::surface, 1.1}, "surface");
  }
}

void add_influences(const World& world, Sheet& sheet) {
  for (const Mass& mass : world.space.masses) {
    if (!(mass.influence > 0.0) || std::isinf(mass.influence)) continue;
    sheet.add_lines({sheet.view().silhouette(mass.center, mass.influence)},
                    {ink::influence, 1.1, 5.0}, "influence");
  }
}

/// Keeps labels off a line.
void keep_free(Vec3d from, Vec3d to, Sheet& sheet) {
  constexpr int points = 8;
  for (int i = 0; i <= points; ++i)
    if (const auto at =
            sheet.view().project(from + (to - from) * (static_cast<double>(i) / points)))
      sheet.keep_free(*at);
}

/// The portal's name, over its highest edge that is seen.
void add_name(const Portal& portal, const Color& color, Sheet& sheet) {
  std::optional<Point> highest;
  for (std::size_t i = 0; i < portal.vertices.size(); ++i) {
    const Vec3d next = portal.vertices[(i + 1) % portal.vertices.size()];
    const auto at = sheet.view().project((portal.vertices[i] + next) * 0.5);
    if (at && (!highest || at->y < highest->y)) highest = at;
  }
  if (highest)
    sheet.add_label(*highest + Point{0, -13.0 * sheet.unit()}, 1.0, portal.name, color,
                    "portal name", 1.0, Anchor::middle);
}

void add_portals(const World& world, Sheet& sheet) {
  const auto portals = world.space.portals.portals();
  for (std::uint32_t i = 0; i < portals.size(); ++i) {
    const Portal& portal = portals[i];
    const Color color = portal_color(portals, i);
    sheet.add_area(portal.vertices, color.with_alpha(0.22), "portal");
    std::vector<Vec3d> loop = portal.vertices;
    loop.push_back(loop.front());
    sheet.add_lines({loop}, {color, 2.4}, "portal");
    const Vec3d middle = portal.frame.origin;
    for (const double side : {1.0, -1.0}) {
      if (side < 0.0 && !portal.two_sided) continue;
      const Vec3d tip = middle + portal.frame.normal * (side * 0.22 * portal.longest_edge);
      sheet.add_arrow(middle, tip, color, "portal normal");
      keep_free(middle, tip, sheet);
    }
    if (portals.size() <= max_names) add_name(portal, color, sheet);
  }
}

void add_masses(const World& world, Sheet& sheet) {
  for (const Mass& mass : world.space.masses) {
    const bool black = mass.horizon && mass.horizon_radius > 0.0;
    if (black) {
      const auto edge = sheet.view().silhouette(mass.center, mass.horizon_radius);
      sheet.add_area(edge, {0, 0, 0}, "horizon");
    }
    const auto at = sheet.view().project(mass.center);
    if (!at) continue;
    const double least = 2.0 * sheet.unit();
    const double radius =
        black ? mass.horizon_radius * sheet.view().pixels_per_length(mass.center) : 0.0;
    if (radius < least) sheet.add(Disc{*at, least, {0, 0, 0}, {}, "mass"});
    const Point beside = *at + Point{0, std::min(radius, 0.25 * sheet.view().height())};
    if (world.space.masses.size() <= max_names)
      sheet.add_label(beside, 10.0, mass.name, ink::black, "mass name");
  }
}

}  // namespace

void add_scene(const World& world, Sheet& sheet) {
  add_surfaces(world, sheet);
  add_influences(world, sheet);
  add_portals(world, sheet);
  add_masses(world, sheet);
}

void add_camera(const World& world, double size, Sheet& sheet) {
  const Camera& camera = world.camera;
  const double w = world.film.width, h = world.film.height;
  std::vector<std::vector<Vec3d>> lines(1);
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {w, 0.0}, {w, h}, {0.0, h}, {0.0, 0.0}}) {
    const Ray ray = camera.ray(x, y, world.film.width, world.film.height);
    const Vec3d corner = ray.at(size / dot(ray.direction, camera.forward));
    lines.front().push_back(corner);
    lines.push_back({ray.origin, corner});
  }
  sheet.add_lines(lines, {ink::black, 1.0}, "camera");
  if (const auto at = sheet.view().project(camera.position))
    sheet.add_label(*at, 8.0, "camera", ink::black, "camera name");
}

}  // namespace portalens
