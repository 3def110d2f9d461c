#include "world/flush_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/words.h"
#include "world/world.h"

namespace portalens {
namespace {

constexpr std::size_t max_told = 100, max_pairs = 10'000;

/// How large a shape is: the diagonal of its box.
double extent_of(const Shape& shape) {
  const Box box = std::visit([](const auto& one) { return one.bounds(); }, shape);
  return length(box.high - box.low);
}

/// A picture on a wall, not one of two equal surfaces in one place.
bool hangs_on(const Shape& seen, const Shape& hidden) {
  constexpr double clearly = 0.999;
  return extent_of(seen) < clearly * extent_of(hidden);
}

/// Whether a shape is flat, and seen from both sides; any other is seen from outside of its faces.
bool is_flat(const Shape& shape) {
  return std::holds_alternative<Quad>(shape) || std::holds_alternative<Ring>(shape);
}

/// Sorts the pairs of one plane into what was probably meant, and what was not.
class FlushObserver {
 public:
  explicit FlushObserver(const World& world) : world_(world) {}

  void observe(const FlushFaces::Overlap& pair) {
    if (is_portal(pair.hidden))
      about_portals(pair);
    else if (is_portal(pair.seen))
      about_door(pair);
    else
      about_surfaces(pair);
  }
  /// @param all  whether there are no pairs but those observed
  void tell(Observations& observations, bool all) {
    tell(warnings_, observations.warnings, all);
    tell(remarks_, observations.remarks, all);
  }

 private:
  [[nodiscard]] const std::vector<Shape>& shapes() const { return world_.space.surfaces.shapes(); }
  [[nodiscard]] bool is_portal(std::uint32_t object) const { return object >= shapes().size(); }
  [[nodiscard]] const Portal& portal(std::uint32_t object) const {
    return world_.space.portals.portals()[object - shapes().size()];
  }
  [[nodiscard]] std::string name(std::uint32_t object) const {
    return in_quotes(is_portal(object) ? portal(object).name
                                       : world_.appearance.bodies[object].name);
  }
  /// Whether the camera is on the side to which the face that is seen turns its front.
  [[nodiscard]] bool is_before(const FlushFaces::Overlap& pair) const {
    return dot(world_.camera.position, pair.normal) >= pair.height;
  }
  [[nodiscard]] bool faces_camera(const Portal& portal) const {
    return dot(world_.camera.position - portal.frame.origin, portal.frame.normal) > 0.0;
  }
  [[nodiscard]] std::string lies_in(const FlushFaces::Overlap& pair) const {
    return fmt::format("{} lies in the plane of {}", name(pair.seen), name(pair.hidden));
  }

  void about_portals(const FlushFaces::Overlap& pair) {
    const Portal &a = portal(pair.seen), &b = portal(pair.hidden);
    const bool one_way = dot(a.frame.normal, b.frame.normal) > 0.0;
    if (!one_way && !a.has_back() && !b.has_back()) return;  // a door with two sides
    warnings_.push_back(fmt::format(
        "portals {} and {} lie in one plane and overlap: where they do, the first one counts",
        name(pair.seen), name(pair.hidden)));
  }

  void about_door(const FlushFaces::Overlap& pair) {
    const Portal& door = portal(pair.seen);
    const Portal& other = world_.space.portals.portals()[door.pair];
    if (is_before(pair) || door.has_back())
      remarks_.push_back(
          fmt::format("{}: where it is met, {} is not", lies_in(pair), name(pair.hidden)));
    else
      (!faces_camera(other) && is_in_sight(pair) ? warnings_ : remarks_)
          .push_back(fmt::format(
              "{}, and the camera is behind it: from there {} is seen, not the portal; where that "
              "is not meant, list its corners in the other order, or give back = \"portal\"",
              lies_in(pair), name(pair.hidden)));
  }

  /// Whether straight light comes from the camera to the wall where the portal is.
  [[nodiscard]] bool is_in_sight(const FlushFaces::Overlap& pair) const {
    const Vec3d from = world_.camera.position, way = portal(pair.seen).frame.origin - from;
    const double distance = length(way);
    const auto hit =
        world_.space.surfaces.nearest({from, way * (1.0 / distance)}, 0.0, 1.001 * distance);
    return hit && hit->shape == pair.hidden;
  }

  void about_surfaces(const FlushFaces::Overlap& pair) {
    const auto& [seen, hidden, normal, height] = pair;
    if (seen == hidden) {
      warnings_.push_back(
          fmt::format("triangles of {} lie on each other: the later ones are seen", name(seen)));
      return;
    }
    const bool hangs = hangs_on(shapes()[seen], shapes()[hidden]);
    // What stands on a floor turns that face away.
    if (hangs && !is_flat(shapes()[seen]) && !is_before(pair)) return;
    (hangs ? remarks_ : warnings_)
        .push_back(fmt::format("{}: where both are, {} is seen", lies_in(pair), name(seen)));
  }

  static void tell(std::vector<std::string>& told, std::vector<std::string>& to, bool all) {
    // Two objects may share several planes.
    told.erase(std::unique(told.begin(), told.end()), told.end());
    const std::size_t count = told.size();
    told.resize(std::min(count, max_told));
    to.insert(to.end(), told.begin(), told.end());
    if (count > max_told)
      to.push_back(fmt::format("{}{} more pairs lie in one plane and overlap",
                               all ? "" : "at least ", count - max_told));
  }

  const World& world_;
  std::vector<std::string> warnings_, remarks_;
};

}  // namespace

void observe_flush_faces(const World& world, Observations& observations) {
  const auto pairs = world.space.surfaces.flush().overlaps(max_pairs);
  FlushObserver observer(world);
  for (const FlushFaces::Overlap& pair : pairs) observer.observe(pair);
  observer.tell(observations, pairs.size() < max_pairs);
}

}  // namespace portalens
