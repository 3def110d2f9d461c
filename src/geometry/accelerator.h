/// \file
/// Finding the surface a segment meets, among all the surfaces of a scene.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/flush.h"
#include "geometry/ray.h"
#include "geometry/shape.h"

namespace portalens {

/// Where a ray met a surface: which shape of the accelerator's list, and where on it.
struct SurfaceHit {
  std::uint32_t shape = no_object;
  std::uint32_t face = 0;
  double distance = 0.0;
};

/// Immutable after construction, safe from any thread. Trees of boxes give the candidates, every
/// answer is computed in double. Of flat faces in one plane `FlushFaces` says which is met; else at
/// exactly equal distances the later shape is, and of one shape the lower face. A ray that is not
/// finite meets nothing.
class Accelerator {
 public:
  /// @param openings  what else may lie in the plane of a shape's face; no query meets them
  /// @throws WorkError if memory runs out
  explicit Accelerator(std::vector<Shape> shapes, std::span<const Opening> openings = {});
  ~Accelerator();
  Accelerator(Accelerator&&) noexcept;
  Accelerator& operator=(Accelerator&&) noexcept;

  [[nodiscard]] const std::vector<Shape>& shapes() const;
  [[nodiscard]] const Box& bounds() const;
  [[nodiscard]] const FlushFaces& flush() const;

  /// The nearest contact at low <= distance <= high. The self-intersection guard holds for any face
  /// of its shape and beyond its reach where the ray started no more than rounding away from that
  /// face: a path may start on an edge, or graze; and for all faces in its plane.
  [[nodiscard]] std::optional<SurfaceHit> nearest(const Ray& ray, double low, double high,
                                                  const SelfIntersectionGuard& guard = {}) const;
  /// Whether anything lies at low <= distance <= high.
  [[nodiscard]] bool blocked(const Ray& ray, double low, double high,
                             const SelfIntersectionGuard& guard = {}) const;
  /// A lower bound of the distance from `x` to any surface, at most `limit`. By how much it falls
  /// short of a mesh, `DistanceGrid` tells.
  [[nodiscard]] double clearance(Vec3d x, double limit) const;
  /// False only if no surface lies within `radius` of the segment.
  [[nodiscard]] bool near(const Segment& segment, double radius) const;

  /// The contact of this shape nearest to distance 0 with |distance| <= `reach`, either way along
  /// the ray, or nothing. For polishing a hit that is known to be close; of a mesh, `face` is tried
  /// before the other triangles.
  [[nodiscard]] std::optional<Contact> contact_near(std::uint32_t shape, std::uint32_t face,
                                                    const Ray& ray, double reach) const;
  /// The hit, or what is met in its place: a surface whose face lies in one plane with it.
  /// @param ray  meets it at its distance
  [[nodiscard]] SurfaceHit uppermost(const SurfaceHit& hit, const Ray& ray) const;
  [[nodiscard]] SurfacePoint surface_at(std::uint32_t shape, std::uint32_t face, Vec3d x) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace portalens
