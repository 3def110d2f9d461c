/// \file
/// All the portals of a scene, and the first of them that a segment crosses.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/ray.h"
#include "portal/portal.h"

namespace portalens {

inline constexpr std::uint32_t no_portal = 0xffffffffu;

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
  explicit PortalSet(std::vector<Portal> portals);

  [[nodiscard]] std::span<const Portal> portals() const { return portals_; }
  [[nodiscard]] bool empty() const { return portals_.empty(); }

  /// The nearest front, or back with a material, at low <= distance <= high. A front is met only by
  /// a ray that goes against its normal, so one that has just left through it doesn't meet it.
  /// @param underfoot  the portal just entered: at distances up to `within` neither it is met
  ///                   (a pair's members may lie in one place), nor the back of its pair
  [[nodiscard]] std::optional<PortalContact> nearest(const Ray& ray, double low, double high,
                                                     std::uint32_t underfoot = no_portal,
                                                     double within = 0.0) const;
  /// A lower bound of the distance from `x` to any portal, at most `limit`.
  [[nodiscard]] double clearance(Vec3d x, double limit) const;
  /// False only if no portal lies within `radius` of the segment.
  [[nodiscard]] bool near(const Segment& segment, double radius) const;
  /// Contact of the ray's line with the portal's plane nearest to distance 0, if within its
  /// polygon.
  [[nodiscard]] std::optional<double> contact_near(std::uint32_t portal, const Ray& ray,
                                                   double reach) const;

 private:
  std::vector<Portal> portals_;
  std::vector<Box> boxes_;
};

}  // namespace portalens
