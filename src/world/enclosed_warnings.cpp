#include "world/enclosed_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <variant>

#include "core/words.h"
#include "world/world.h"

namespace portalens {
namespace {

constexpr std::size_t max_told = 20;
/// So many things are asked about, times as many shapes as there are: all of these may lie in one
/// place, and a ray from there then meets each.
constexpr std::size_t max_asked = 2000, max_asked_times_shapes = 2'000'000;
constexpr double far = std::numeric_limits<double>::infinity();

/// The first that the ray meets but `own`; nothing also where that takes many hits.
std::optional<std::uint32_t> first_other(const Accelerator& surfaces, const Ray& ray,
                                         std::uint32_t own) {
  double low = 1e-9 * length(ray.origin) + std::numeric_limits<double>::min();
  for (int hits = 0; hits < 8; ++hits) {
    const auto hit = surfaces.nearest(ray, low, far);
    if (!hit) return std::nullopt;
    if (hit->shape != own) return hit->shape;
    low = hit->distance * (1.0 + 1e-9) + std::numeric_limits<double>::min();
  }
  return std::nullopt;
}

/// What is met first in every one of some directions, four of them the corners of a tetrahedron.
std::optional<std::uint32_t> shape_around(const Accelerator& surfaces, Vec3d place,
                                          std::uint32_t own = no_object) {
  constexpr Vec3d directions[] = {{0.57, 0.58, 0.58},   {0.57, -0.58, -0.58}, {-0.57, 0.58, -0.58},
                                  {-0.57, -0.58, 0.58}, {0.1, 0.98, 0.17},    {-0.15, -0.97, 0.19}};
  std::optional<std::uint32_t> found;
  for (const Vec3d& direction : directions) {
    const auto met = first_other(surfaces, {place, normalize(direction)}, own);
    if (!met || (found && *met != *found)) return std::nullopt;
    found = met;
  }
  return found;
}

/// Of a light that shines from one place.
std::optional<Vec3d> place_of(const Light& light) {
  return std::visit(
      [](const auto& one) -> std::optional<Vec3d> {
        if constexpr (requires { one.position; })
          return one.position;
        else
          return std::nullopt;
      },
      light);
}

class EnclosureObserver {
 public:
  EnclosureObserver(const World& world, Observations& observations)
      : world_(world),
        surfaces_(world.space.surfaces),
        to_(world.space.portals.empty() ? observations.warnings : observations.remarks) {
    const auto around = shape_around(surfaces_, world.camera.position);
    // Rooms are often a mesh.
    if (around && !std::holds_alternative<Mesh>(surfaces_.shapes()[*around]))
      observations.remarks.push_back(
          fmt::format("the camera lies within {}: it sees the inside", name(*around)));
  }

  void about_lights() {
    const Appearance& look = world_.appearance;
    for (std::size_t i = 0; i < std::min(asked(), look.lights.size()); ++i) {
      const auto place = place_of(look.lights[i]);
      if (!place) continue;
      const auto around = shape_around(surfaces_, *place);
      if (!around || may_hold_camera(*around)) continue;
      tell(
          fmt::format("light {} lies within {}, and lights nothing but its inside; move it out, "
                      "or let the surface shine by itself (emitted, in its material)",
                      in_quotes(look.light_names[i]), name(*around)));
    }
  }

  void about_bodies() {
    const auto& shapes = surfaces_.shapes();
    for (std::uint32_t i = 0; i < std::min(asked(), shapes.size()); ++i) {
      const Box box = box_of(i);
      const auto around = shape_around(surfaces_, box.middle(), i);
      if (!around || may_hold_camera(*around) || !holds(box_of(*around), box)) continue;
      tell(fmt::format("{} lies within {}: it is not seen from outside", name(i), name(*around)));
    }
  }

 private:
  [[nodiscard]] std::size_t asked() const {
    const std::size_t shapes = std::max<std::size_t>(1, surfaces_.shapes().size());
    return std::min(max_asked, max_asked_times_shapes / shapes);
  }
  [[nodiscard]] std::string name(std::uint32_t shape) const {
    return in_quotes(world_.appearance.bodies[shape].name);
  }
  [[nodiscard]] Box box_of(std::uint32_t shape) const {
    return std::visit([](const auto& one) { return one.bounds(); }, surfaces_.shapes()[shape]);
  }
  /// What else is in a room may hide its walls from the camera.
  [[nodiscard]] bool may_hold_camera(std::uint32_t shape) const {
    return holds(box_of(shape), {world_.camera.position, world_.camera.position});
  }
  static bool holds(const Box& outer, const Box& inner) {
    return outer.low.x < inner.low.x && inner.high.x < outer.high.x && outer.low.y < inner.low.y &&
           inner.high.y < outer.high.y && outer.low.z < inner.low.z && inner.high.z < outer.high.z;
  }
  void tell(std::string sentence) {
    if (told_++ < max_told) to_.push_back(std::move(sentence));
  }

  const World& world_;
  const Accelerator& surfaces_;
  std::vector<std::string>& to_;
  std::size_t told_ = 0;
};

}  // namespace

void observe_enclosed(const World& world, Observations& observations) {
  EnclosureObserver observer(world, observations);
  observer.about_lights();
  observer.about_bodies();
}

}  // namespace portalens
