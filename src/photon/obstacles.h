/// \file
/// The first surface or portal that a curve meets.
#pragma once

#include <cmath>
#include <optional>

#include "geometry/accelerator.h"
#include "photon/curve.h"
#include "portal/portal_set.h"

namespace portalens {

/// What a path meets, and where on the curve.
struct Encounter {
  /// `portal_back` is solid, `portal_through_back` that of a two-sided portal.
  enum class Kind : std::uint8_t { surface, portal_front, portal_back, portal_through_back };
  double distance = 0.0;  ///< arc length on the curve
  Kind kind = Kind::surface;
  std::uint32_t object = no_object;
  std::uint32_t face = 0;

  /// Whether the path goes on through it.
  [[nodiscard]] bool leads_on() const {
    return kind == Kind::portal_front || kind == Kind::portal_through_back;
  }
};

/// Where a path began, and what it may not meet at once.
struct PathStart {
  SelfIntersectionGuard guard;  ///< `reach` counted from the start of the curve

  /// The same for the rest of the path, after `length` of it.
  [[nodiscard]] PathStart after(double length) const {
    PathStart rest = *this;
    rest.guard.reach -= length;
    if (rest.guard.reach <= 0.0) rest.guard = SelfIntersectionGuard{};
    return rest;
  }
};

/// Surfaces and portals of a scene, asked along curves. Borrows both.
class Obstacles {
 public:
  Obstacles(const Accelerator& surfaces, const PortalSet& portals)
      : surfaces_(surfaces), portals_(portals) {}

  /// The first encounter at 0 <= s <= length. Sections of the curve whose chord passes within their
  /// sagitta of something are halved until the sagitta is below `flatness`; the hit is then refined
  /// on the curve itself.
  /// @param free  nothing is met before
  [[nodiscard]] std::optional<Encounter> first(const Curve& curve, double free, double flatness,
                                               const PathStart& start) const;

  /// The first encounter on a straight path; `high` may be infinite.
  [[nodiscard]] std::optional<Encounter> first(const Ray& ray, double high,
                                               const PathStart& start) const;

  /// What is met in the place of a surface: a portal in whose plane its face lies, where there is
  /// one, or the surface.
  /// @param ray  at `distance` it meets the surface
  [[nodiscard]] Encounter uppermost(const SurfaceHit& hit, const Ray& ray) const;

  /// What meeting that portal from that side is.
  [[nodiscard]] Encounter at_portal(std::uint32_t portal, PortalSide side, double distance) const;

  /// A lower bound of the distance to anything, at most `limit`.
  [[nodiscard]] double clearance(Vec3d x, double limit) const {
    return portals_.clearance(x, surfaces_.clearance(x, limit));
  }

 private:
  struct Section {
    double s0, s1;
    Vec3d x0, x1;
  };
  [[nodiscard]] std::optional<Encounter> in_section(const Curve& curve, const Section& section,
                                                    double flatness, const PathStart& start) const;
  /// Whether it is the face that the path has just left, met by rounding.
  [[nodiscard]] bool left_behind(const Curve& curve, const Encounter& met,
                                 const SelfIntersectionGuard& guard) const;
  [[nodiscard]] std::optional<Encounter> refine(const Curve& curve, const Section& section,
                                                Encounter found) const;

  const Accelerator& surfaces_;
  const PortalSet& portals_;
};

}  // namespace portalens
