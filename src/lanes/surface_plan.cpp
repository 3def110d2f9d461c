#include "lanes/surface_plan.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "lanes/narrow.h"
#include "photon/space.h"

namespace portalens {
namespace {

Vec3d lowest(Vec3d a, Vec3d b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3d highest(Vec3d a, Vec3d b) { return -lowest(-a, -b); }

/// A flat face with edges: a polygon or a portal.
struct Thin {
  std::span<const Vec3d> vertices;
  Vec3d normal;
  std::uint32_t plane;  ///< its index in `FlushFaces`; `LeftPlane::none` if nothing shares it
  Box box;

  /// Whether all its corners lie that close to the plane of another.
  [[nodiscard]] bool hugs(const Thin& other, double distance) const {
    return std::all_of(vertices.begin(), vertices.end(), [&](const Vec3d& vertex) {
      return std::fabs(dot(vertex - other.vertices[0], other.normal)) <= distance;
    });
  }
};

/// What a shape's `lay_out` (geometry/shape.h) is given: it writes the polygons and balls that the
/// shape reports into the plan of the lanes.
class ShapeLayout {
 public:
  ShapeLayout(const Space& space, LanePlan& plan) : space_(space), plan_(plan) {}

  /// Adds the shape of that number.
  void add(std::uint32_t index, const Shape& shape) {
    index_ = index;
    const auto tell = [&](const auto& known) {
      if constexpr (requires { known.lay_out(*this); })
        if (known.lay_out(*this)) return;
      plan_.boxed.push_back(index);
      add_box(known.bounds(), false);
    };
    std::visit(tell, shape);
  }

  /// A convex polygon of 3 or 4 corners in one plane, counter-clockwise about the normal.
  /// @return whether there is room
  [[nodiscard]] bool polygon(std::span<const Vec3d> vertices, Vec3d normal) {
    LaneScene& scene = plan_.scene;
    if (scene.polygon_count == max_lane_polygons) return false;
    const FlushFaces::Place* place = space_.surfaces.flush().find(index_, 0);
    Box box;
    for (const Vec3d& vertex : vertices) box.add(vertex);
    faces_.push_back({vertices, normal, place ? place->plane : LeftPlane::none, box});
    fill(scene.polygons[scene.polygon_count++], faces_.back(), place);
    return true;
  }

  /// @return whether there is room
  [[nodiscard]] bool ball(Vec3d center, double radius) {
    LaneScene& scene = plan_.scene;
    if (scene.sphere_count == max_lane_spheres) return false;
    scene.spheres[scene.sphere_count++] = {narrow(center - plan_.center),
                                           static_cast<float>(radius), static_cast<int>(index_)};
    return true;
  }

  /// Adds a box wherever two faces are too close for floats to tell which of them comes first:
  /// steps in there are left to the scalar engine.
  void add_narrow_gaps() {
    for (std::uint32_t i = 0; i < space_.portals.portals().size(); ++i) {
      const Portal& portal = space_.portals.portals()[i];
      Box box;
      for (const Vec3d& vertex : portal.vertices) box.add(vertex);
      faces_.push_back(
          {portal.vertices, portal.frame.normal, space_.portals.plane_of(i).plane, box});
    }
    Box all;
    for (const Thin& face : faces_) all.add(face.box);
    if (space_.viewpoint) all.add(*space_.viewpoint);
    if (all.empty()) return;
    const double closest = 1e-6 * (length(all.middle() - plan_.center) + all.diagonal());
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Thin &a = faces_[i], &b = faces_[j];
        if (a.plane == b.plane && a.plane != LeftPlane::none) continue;
        const bool a_is_smaller = a.box.diagonal() < b.box.diagonal();
        if (!(a_is_smaller ? a.hugs(b, closest) : b.hugs(a, closest))) continue;
        const Vec3d low = highest(a.box.low, b.box.low), high = lowest(a.box.high, b.box.high);
        const Box shared = Box{low, high}.grown(closest);
        if (shared.low == lowest(shared.low, shared.high)) add_box(shared, true);
      }
  }

 private:
  /// @param narrow_gap  as `narrow` of a `LaneBox`
  void add_box(const Box& box, bool narrow_gap) {
    LaneScene& scene = plan_.scene;
    // Rounded outwards, and joined to the last where there is no room.
    const double slack = 1e-6 * (length(box.low - plan_.center) + length(box.high - plan_.center));
    const Vec3d more{slack, slack, slack};
    const LaneVec low = narrow(box.low - plan_.center - more),
                  high = narrow(box.high - plan_.center + more);
    if (scene.box_count < max_lane_boxes) {
      scene.boxes[scene.box_count++] = {low, high, narrow_gap};
      return;
    }
    LaneBox& last = scene.boxes[max_lane_boxes - 1];
    last.narrow = last.narrow || narrow_gap;
    last.low = {std::min(last.low.x, low.x), std::min(last.low.y, low.y),
                std::min(last.low.z, low.z)};
    last.high = {std::max(last.high.x, high.x), std::max(last.high.y, high.y),
                 std::max(last.high.z, high.z)};
  }

  void fill(LanePolygon& lane, const Thin& face, const FlushFaces::Place* place) const {
    const auto vertices = face.vertices;
    const Vec3d normal = face.normal, center = plan_.center;
    lane.normal = narrow(normal);
    lane.distance = static_cast<float>(dot(vertices[0] - center, normal));
    lane.shape = static_cast<int>(index_);
    lane.leaves = place ? LanePlan::departed_from(place->plane) : static_cast<float>(lane.shape);
    lane.facing = place ? static_cast<float>(place->side) : 1.0f;
    const Vec3d middle = face.box.middle();
    double radius = 0.0;
    for (const Vec3d& vertex : vertices) radius = std::max(radius, length(vertex - middle));
    lane.middle = narrow(middle - center);
    lane.radius = static_cast<float>(radius + 1e-6 * (radius + length(middle - center)));
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t k = i % vertices.size();
      const Vec3d from = vertices[k], to = vertices[(k + 1) % vertices.size()];
      const Vec3d inwards = normalize(cross(normal, to - from));
      lane.edge_normal[i] = narrow(inwards);
      // A little generous: the hit is computed again in double.
      const double slack = 1e-6 * (length(from - center) + length(to - from));
      lane.edge_distance[i] = static_cast<float>(dot(from - center, inwards) - slack);
    }
  }

  const Space& space_;
  LanePlan& plan_;
  std::uint32_t index_ = 0;  ///< of the shape that speaks
  std::vector<Thin> faces_;
};

}  // namespace

void add_surfaces(const Space& space, LanePlan& plan) {
  ShapeLayout layout(space, plan);
  const auto& shapes = space.surfaces.shapes();
  for (std::size_t i = 0; i < shapes.size(); ++i)
    layout.add(static_cast<std::uint32_t>(i), shapes[i]);
  layout.add_narrow_gaps();
}

}  // namespace portalens
