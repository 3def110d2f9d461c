/// \file
/// The list of BSDFs: how surfaces answer light. equations.md, sec. 7. To add one: a header beside
/// this one, and a word in `Bsdf`.
///
/// Light comes two ways. Lamps are asked from a surface, and `value` answers them; all else that
/// a surface reflects is found by a photon, sent where `sample` says, which sees lamps, too. So
/// what is told by one of the two must not be told by the other; but what `glossy` tells is told by
/// both, each with its share (shading/lamp_share.h).
///
/// Each type has
///   static constexpr std::string_view name;               `type` in a [[material]]
///   static T from(Parameters&, const ImageLoader&);       faults are collected there
///   std::vector<const Texture*> textures() const;         all that `at` looks at
///   Rgb max_reflected() const;
///       what it gives back of light from all round, where it gives back most, or a little more
///   Rgb color() const;                                    what it is drawn with
///   bool answers() const;                     whether `value` or `glossy` gives something
///   bool sends() const;                                   whether `sample` gives something
///   a type T::Here, and Here at(const SurfacePoint&) const;
///       the same BSDF at one place, its textures looked up
/// and is immutable; and `Here`, of few numbers and for unit directions away from the surface, on
/// the side of the unit `normal`, has
///   Rgb albedo(Vec3d normal, Vec3d out) const;
///       what `value` gives back of light that is the same from all round
///   Rgb value(Vec3d normal, Vec3d out, Vec3d in) const;
///       the reflectance factor: pi times the BRDF
///   std::optional<BsdfSample> sample(Vec3d normal, Vec3d out, double u1, double u2) const;
///       where light comes from that leaves along `out`; nothing if what was drawn is black
/// and, if its mirrors are rough enough that lamps are asked for what they show,
///   Glossy glossy(Vec3d normal, Vec3d out, Vec3d in) const;
///       what `sample` gives of that pair of directions: its color * weight is value cos /
///       (pi density)
///   Rgb glossy_albedo(Vec3d normal, Vec3d out) const;
///       what all samples give back of light that is the same from all round
#pragma once

#include <variant>

#include "shading/diffuse_mirror.h"
#include "shading/metallic_roughness.h"

namespace portalens {

using Bsdf = std::variant<DiffuseMirror, MetallicRoughness>;

/// Whether lamps are asked for what the photons of it find.
template <class Here>
concept HasGlossy = requires(const Here& here, Vec3d w) {
  here.glossy(w, w, w);
};

}  // namespace portalens
