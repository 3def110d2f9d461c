/// \file
/// All the portals of a scene, and the first of them that a segment crosses.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/flush.h"
#include "geometry/ray.h"
#include "portal/portal.h"

namespace portalens {

inline constexpr std::uint32_t no_portal = 0xffffffffu;

/// In which of the planes that `FlushFaces` tells apart a portal lies, and whether its front looks
/// along the plane's normal (1) or against it (-1).
struct PortalPlane {
  std::uint32_t plane;
  double side;
};

enum class PortalSide : std::uint8_t { front, back };

struct PortalContact {
  std::uint32_t portal = 0;
  PortalSide side = PortalSide::front;
  double distance = 0.0;
};

/// Immutable; safe from any thread.
class PortalSet {
 public:
  PortalSet() = default;
  /// Each in a plane of its own.
  explicit PortalSet(std::vector<Portal> portals);
  /// @param flush  has them as openings, after `shape_count` shapes
  PortalSet(std::vector<Portal> portals, const FlushFaces& flush, std::uint32_t shape_count);

  [[nodiscard]] std::span<const Portal> portals() const { return portals_; }
  [[nodiscard]] bool empty() const { return portals_.empty(); }

  /// The nearest front, or back that light meets, at low <= distance <= high. A front is met only
  /// by a ray that goes against its normal, a back by one that goes along it. Of portals in one
  /// plane that both are met where they overlap, fronts and two-sided backs come before other
  /// backs, and then the first.
  /// @param left  the plane that the ray has just left: what lies in it is behind
  [[nodiscard]] std::optional<PortalContact> nearest(const Ray& ray, double low, double high,
                                                     const LeftPlane& left = {}) const;
  /// Whether a ray may meet that portal at a place of its plane, and from which side.
  [[nodiscard]] std::optional<PortalSide> met_at(std::uint32_t index, const Ray& ray,
                                                 Vec3d place) const;
  /// What is met in the place of a contact: it, or another portal that lies in its plane.
  /// @param ray  at its distance it meets the portal
  [[nodiscard]] PortalContact uppermost(const PortalContact& contact, const Ray& ray) const;
  [[nodiscard]] const PortalPlane& plane_of(std::uint32_t portal) const { return planes_[portal]; }
  /// A lower bound of the distance from `x` to any portal, at most `limit`.
  [[nodiscard]] double clearance(Vec3d x, double limit) const;
  /// False only if no portal lies within `radius` of the segment.
  [[nodiscard]] bool near(const Segment& segment, double radius) const;
  /// Contact of the ray's line with the portal's plane nearest to distance 0, if within its
  /// face.
  [[nodiscard]] std::optional<double> contact_near(std::uint32_t index, const Ray& ray,
                                                   double reach) const;

 private:
  std::vector<Portal> portals_;
  std::vector<PortalPlane> planes_;
  std::vector<std::vector<std::uint32_t>> overlapping_;  ///< others in its plane; empty if none has
  std::vector<Box> boxes_;
};

}  // namespace portalens
