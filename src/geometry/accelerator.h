/// \file
/// Finding the surface a segment meets, among all the surfaces of a scene.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/ray.h"
#include "geometry/shape.h"

namespace portalens {

inline constexpr std::uint32_t no_object = 0xffffffffu;

/// Where a ray met a surface: which shape of the accelerator's list, and where on it.
struct SurfaceHit {
  std::uint32_t shape = no_object;
  std::uint32_t face = 0;
  double distance = 0.0;
};

/// The surface that a path starts on. Within `reach` of its start the path can't meet that face
/// again in the direction in which it left (rounding would let it); in the opposite direction it
/// can.
struct Departure {
  std::uint32_t shape = no_object;
  std::uint32_t face = 0;
  double side = 0.0;   ///< sign of (direction · geometric normal) when it left
  double reach = 0.0;  ///< length of path, from the start of the ray, within which this holds
};

/// Immutable after construction, safe from any thread. Trees of boxes give the candidates, every
/// answer is computed in double. At exactly equal distances the lower (shape, face) is the nearest.
/// A ray that is not finite meets nothing.
class Accelerator {
 public:
  /// @throws WorkError if memory runs out
  explicit Accelerator(std::vector<Shape> shapes);
  ~Accelerator();
  Accelerator(Accelerator&&) noexcept;
  Accelerator& operator=(Accelerator&&) noexcept;

  [[nodiscard]] const std::vector<Shape>& shapes() const;
  [[nodiscard]] const Box& bounds() const;

  /// The nearest contact at low <= distance <= high. The departure holds for any face of its shape
  /// and beyond its reach where the ray started no more than rounding away from that face: a path
  /// may start on an edge, or graze.
  [[nodiscard]] std::optional<SurfaceHit> nearest(const Ray& ray, double low, double high,
                                                  const Departure& departure = {}) const;
  /// Whether anything lies at low <= distance <= high.
  [[nodiscard]] bool blocked(const Ray& ray, double low, double high,
                             const Departure& departure = {}) const;
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
  [[nodiscard]] SurfacePoint surface_at(std::uint32_t shape, std::uint32_t face, Vec3d x) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace portalens
