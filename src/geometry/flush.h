/// \file
/// Flat faces that lie in one plane: a door or a picture on a wall, a cube on a floor. Which of
/// them is met there, and which are behind whoever leaves one. equations.md, sec. 6.
///
/// All is told once, from where the faces lie; nothing is ever told from distances along a ray,
/// which rounding puts in any order.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/ray.h"
#include "geometry/shape.h"

namespace portalens {

inline constexpr std::uint32_t no_object = 0xffffffffu;

/// The face that a path starts on. Within `reach` of its start the path can't meet that face again
/// in the direction in which it left (rounding would let it); in the opposite direction it can. The
/// same holds for all faces in its plane.
struct SelfIntersectionGuard {
  std::uint32_t shape = no_object;  ///< or a opening: their numbers follow those of the shapes
  std::uint32_t face = 0;
  double side = 0.0;   ///< sign of (direction · geometric normal) when it left
  double reach = 0.0;  ///< length of path, from the start of the ray, within which this holds
};

/// How far a self-intersection guard holds from places of that size: the longer the more it grazes,
/// since faces of one plane may be apart by a billionth of it.
/// @param slope  (direction · normal)
[[nodiscard]] inline double guard_reach(double size, double slope) {
  return 1e-6 * size / std::max(std::fabs(slope), 1e-3);
}

/// A face: of a shape, or a opening as a whole.
struct FaceId {
  std::uint32_t object = no_object, face = 0;

  friend bool operator==(const FaceId&, const FaceId&) = default;
  friend auto operator<=>(const FaceId&, const FaceId&) = default;
};

/// A flat face that is no shape and is met before shapes: a portal.
struct Opening {
  std::span<const Vec3d> vertices;  ///< span it
  Vec3d normal;
  std::vector<std::vector<Vec3d>> pieces;  ///< convex polygons that make it up
};

/// A mesh of a scene, with a tree over its triangles.
struct MeshTriangles {
  std::uint32_t shape;
  const Mesh* mesh;
  const BoxTree* tree;
};

/// The plane that a path has just left; `no_plane` if nothing else lies in it.
struct LeftPlane {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t plane = none;
  double side = 0.0;  ///< of the plane's normal on which it left: 1 or -1
  double reach = 0.0;
};

/// Immutable, safe from any thread.
class FlushFaces {
 public:
  /// Where a face lies.
  struct Place {
    FaceId face;
    std::uint32_t plane;
    double side;  ///< 1 if its normal is the plane's, -1 if it is opposite
    std::uint32_t first_over, end_over;
  };
  /// What faces of one plane share.
  struct Plane {
    Vec3d normal;
    double height = 0.0;     ///< along the normal, from the origin
    double thickness = 0.0;  ///< no two of them are further apart
  };
  /// Objects that share an area in one plane.
  struct Overlap {
    std::uint32_t seen, hidden;  ///< there
    Vec3d normal;                ///< of the face that is seen
    double height;               ///< of the plane along it, from the origin
  };

  FlushFaces() = default;
  /// @param meshes  ascending by shape; those without triangles may be left out
  FlushFaces(const std::vector<Shape>& shapes, std::span<const MeshTriangles> meshes,
             std::span<const Opening> openings);

  /// Null for a face of a shape with which nothing lies in one plane. Openings all have a place.
  [[nodiscard]] const Place* find(std::uint32_t object, std::uint32_t face) const {
    if (object >= object_count_ || first_[object] == first_[object + 1]) return nullptr;
    return find_among(first_[object], first_[object + 1], face);
  }
  [[nodiscard]] const Plane& plane(std::uint32_t index) const { return planes_[index]; }
  [[nodiscard]] std::uint32_t plane_count() const {
    return static_cast<std::uint32_t>(planes_.size());
  }
  /// The faces that are met in place of this one where they reach, the first that does: openings,
  /// then what is smaller (of the same size: listed later). Of an opening, other openings that
  /// share some of its area, by their index.
  [[nodiscard]] std::span<const FaceId> over(const Place& place) const {
    return std::span(over_).subspan(place.first_over, place.end_over - place.first_over);
  }
  /// Objects that share an area in one plane, by the pair. Of two openings the first is said to be
  /// seen.
  /// @param most  no more are looked for
  [[nodiscard]] std::vector<Overlap> overlaps(std::size_t most) const;
  /// Whether any shape lies in the plane of something else.
  [[nodiscard]] bool any_shapes() const { return any_shapes_; }
  [[nodiscard]] LeftPlane left_by(const SelfIntersectionGuard& guard) const;

  /// Whether a ray meets this face only since rounding lets it: the ray starts on that plane, or no
  /// further beside it than its thickness, and leaves it.
  [[nodiscard]] bool is_behind(const LeftPlane& left, const Place& place, const Ray& ray,
                               double distance) const {
    if (place.plane != left.plane) return false;
    const Plane& plane = planes_[left.plane];
    const double slope = dot(ray.direction, plane.normal) * left.side;
    return slope > 0.0 && (distance <= left.reach || distance * slope <= 2.0 * plane.thickness);
  }

 private:
  friend class FlushBuilder;

  [[nodiscard]] const Place* find_among(std::uint32_t begin, std::uint32_t end,
                                        std::uint32_t face) const;

  std::uint32_t object_count_ = 0;
  std::vector<std::uint32_t> first_;  ///< of each object's places; and one end more
  std::vector<Place> places_;         ///< by object, then face
  std::vector<Plane> planes_;
  std::vector<FaceId> over_;
  bool any_shapes_ = false;
};

}  // namespace portalens
