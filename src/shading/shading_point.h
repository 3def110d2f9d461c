/// \file
/// The place where a photon met something solid, as shading sees it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "photon/photon.h"
#include "photon/space.h"
#include "shading/appearance.h"

namespace portalens {

struct ShadingPoint {
  Vec3d position;  ///< where rays start
  Vec3d normal;    ///< unit; like the next one on the viewer's side
  Vec3d outward;   ///< unit; of the surface itself, where a mesh interpolates `normal`
  std::uint32_t material = 0;
  std::uint32_t shape = no_object;  ///< or a portal, by the number of its opening
  std::uint32_t face = 0;
  double front = 1.0;  ///< 1 where `outward` is the surface's own normal, -1 against it
  double size = 0.0;   ///< of the place and the scene, for self-intersection guards
  Vec3d bulge;         ///< from `position` to where a smooth mesh's surface is meant to be

  /// How a ray in `direction`, of any length, leaves this point.
  [[nodiscard]] SelfIntersectionGuard leaving(Vec3d direction) const {
    const double slope = dot(direction, outward);
    return {shape, face, front * slope < 0.0 ? -1.0 : 1.0,
            guard_reach(size, std::clamp(slope, -1.0, 1.0))};
  }

  /// Where shadow rays start: on a smooth mesh over its face, which so casts no shadow on itself.
  [[nodiscard]] Vec3d lit_at() const { return position + bulge; }
  [[nodiscard]] bool bulges() const { return bulge != Vec3d{}; }
  /// How a shadow ray leaves. From over the face it leaves outwards, even if it passes its plane.
  [[nodiscard]] SelfIntersectionGuard leaving_to_light(Vec3d direction) const {
    SelfIntersectionGuard guard = leaving(direction);
    if (bulges()) guard.side = front;
    return guard;
  }
};

/// With what textures ask for.
struct ShadedSurface {
  ShadingPoint point;
  SurfacePoint surface;
};

/// Where arrivals have met something. Borrows both.
class ShadingPoints {
 public:
  ShadingPoints(const Space& space, const Appearance& appearance)
      : space_(space),
        appearance_(appearance),
        shapes_(space.surfaces.shapes()),
        extent_(space.surfaces.bounds().diagonal()) {}

  /// @pre the arrival has met a surface or a portal's back
  [[nodiscard]] ShadedSurface at(const Arrival& arrival) const;

  /// The quad that was met, if its material asks for no texture coordinates. Most of what is met in
  /// most scenes is one: it is told apart here, so that its path is short.
  [[nodiscard]] const Quad* plain_quad(const Arrival& arrival) const {
    if (arrival.met != Met::surface) return nullptr;
    const auto* quad = std::get_if<Quad>(&shapes_[arrival.object]);
    return quad && !appearance_.materials[material_of(arrival)].uses_coordinates() ? quad : nullptr;
  }
  /// The same as `at`, where there is one; all of it may stay in registers.
  [[nodiscard]] ShadedSurface on(const Quad& quad, const Arrival& arrival) const {
    return on_surface(arrival, quad.place_at(arrival.position));
  }

 private:
  [[nodiscard]] std::uint32_t material_of(const Arrival& arrival) const {
    return appearance_.bodies[arrival.object].material_of(arrival.face);
  }
  [[nodiscard]] ShadedSurface on_back(const Arrival& arrival) const;

  /// At the edge of its silhouette a mesh may be seen where its smooth normal looks away: there it
  /// is bent until it looks aside.
  [[nodiscard]] static Vec3d seen_normal(Vec3d normal, Vec3d incoming) {
    constexpr double least_cosine = 1e-3;
    const double away = dot(incoming, normal);
    return away < 0.0 ? normal : normalize(normal - incoming * (away + least_cosine));
  }

  [[nodiscard]] ShadedSurface on_surface(const Arrival& arrival,
                                         const SurfacePoint& surface) const {
    const std::uint32_t material = material_of(arrival);
    const bool behind = dot(arrival.direction, surface.geometric_normal) > 0.0;
    const double front = behind ? -1.0 : 1.0;
    const Vec3d outward = surface.geometric_normal * front, normal = surface.normal * front;
    return {{arrival.position,
             seen_normal(normal, arrival.direction),
             outward,
             material,
             arrival.object,
             arrival.face,
             front,
             length(arrival.position) + extent_,
             {}},
            surface};
  }

  const Space& space_;
  const Appearance& appearance_;
  const std::vector<Shape>& shapes_;
  double extent_;  ///< of the surfaces
};

/// What a surface's BSDF answers of light that is the same from all round.
[[nodiscard]] Rgb albedo_of(const Appearance& appearance, const ShadedSurface& place, Vec3d out);

/// Of one.
[[nodiscard]] inline ShadedSurface shaded_surface(const Space& space, const Appearance& appearance,
                                                  const Arrival& arrival) {
  return ShadingPoints(space, appearance).at(arrival);
}

}  // namespace portalens
