/// \file
/// The list of lights: what is asked for light from elsewhere. To add one: a header beside this
/// one, and a word in `Light`. It has three kinds: those that [[light]] tables make, those that are
/// made from surfaces that emit, and the sky (world/light_list.h).
///
/// Each type has
///   static constexpr bool is_delta;
///       whether it shines from one place or direction: then one sample tells all of it, and takes
///       no random numbers; of another, `shadow_samples` are taken
///   LightSample sample(Vec3d x, double u1, double u2) const;
///       one point of it as seen from x, in the light's own world: x is not on this side of a
///       portal if the light isn't. u1 and u2 are uniform in [0, 1), and over them `irradiance` has
///       the mean that the light gives where nothing is in the way; what the light itself hides
///       may be left out of it.
///   Rgb power() const;
///       W, of all that leaves it, on each side that shines; a texture's by many points of it; of
///       what is infinitely far W/m²: of a surface that faces it, or, of what is all round, in the
///       mean over all directions that a surface may face
/// and is immutable. What photons find, too, shares the light of glossy surfaces with them
/// (shading/lamp_share.h), if it has
///   double found_area() const;           of what can be met of it; 0 if nothing
///   double density(Vec3d direction) const;
///       or, if it is infinitely far, of the directions it draws, per solid angle; infinite if it
///       is not seen
/// else such surfaces ask it for all its light if it is delta, and leave it to photons if not. What
/// may be a thing of its own has
///   std::optional<Shape> body() const;                   nothing if it shall not be met
///   Rgb radiance() const;                                of its front; behind it is black
/// what is infinitely far
///   static constexpr bool is_distant = true;
/// and if it shines from about one direction
///   Vec3d towards() const;                               unit vector to its middle
///   std::optional<SkyDisc> disc() const;                 what is seen of it where light escapes
/// and what a [[light]] table may be
///   static constexpr std::string_view name;              its `type` there
///   static T from(Parameters&);                          faults are collected there
#pragma once

#include <type_traits>
#include <variant>

#include "shading/area_light.h"
#include "shading/mesh_light.h"
#include "shading/point_light.h"
#include "shading/portal_back_light.h"
#include "shading/shape_light.h"
#include "shading/sky_light.h"
#include "shading/spot_light.h"
#include "shading/sun_light.h"

namespace portalens {

using Light = std::variant<PointLight, ShapeLight, MeshLight, PortalBackLight, SpotLight, SunLight,
                           SkyLight, RectangleLight, DiscLight, SphereLight>;

/// Whether a light is infinitely far.
template <class Any>
concept Distant = requires {
  std::remove_cvref_t<Any>::is_distant;
};

/// Whether it shines from about one direction, too.
template <class Any>
concept Directed = Distant<Any> && requires(const Any& light) {
  light.towards();
};

}  // namespace portalens
