/// \file
/// The list of apertures: the faces that portals may have. equations.md, sec. 4. To add one: a
/// header beside this one, and a word in `Aperture`; what a scene says of it comes by `FaceInput`,
/// which `world/face_reader.h` reads. The types are asked in the list's order, and the first whose
/// `from` takes the input is the face: a special kind stands before a general one.
///
/// Coordinates are those of the portal's frame: x along `right`, y along `up`, z the height over
/// the plane. Each type has
///   static constexpr std::string_view name;          for people
///   static constexpr bool curved;                    whether its rim has no edges and vertices
///   static std::optional<T> from(const FaceInput&);  nothing where the input is none of its kind
///   T carried(std::vector<Vec3d> outline) const;     the same where its outline has these points
///   bool within(double x, double y, double slack) const;
///       whether a point of the plane lies inside, or no further than `slack` (>= 0, some rounding)
///       from it
///   bool covers(double x, double y) const;           the same without slack, as `nearest` says it
///   Feature nearest(Vec3d local, double tolerance) const;
///       what of the face is nearest, by the one-sided rule: from in front of the plane (heights
///       down to -tolerance) of the face, from behind of its rim. Of places as near the first wins
///   Feature follow(Feature, Vec3d local) const;
///       the same feature, as it is for another place: a piece of a curved rim is followed from
///       where it was found
///   Vec3d place(Feature, Vec3d local) const;
///       the point of that feature nearest to `local`, for which it was found, or followed: an edge
///       counts as its whole line. So this is smooth in `local`
///   Pace pace(Feature, Vec3d local) const;           how that point runs as `local` does
///   double distance_to_discontinuity(Vec3d local, double tolerance) const;
///       a lower bound of the distance from `local` to where the nearest point jumps
///   double still(Feature, Vec3d local) const;
///       within this distance it does not move at all, unless it jumps
///   edges() const;     in order, none of what is curved
///   outline() const;   corners, counter-clockwise; of a curved rim, those of a polygon around it
///   std::vector<std::vector<Vec3d>> pieces() const;  convex polygons that make up the outline
///   std::vector<std::vector<Vec3d>> gaps() const;    those that it lacks to be convex itself
///   PlaneBox box() const;                            just around it
///   double size() const;                             its longest edge, or diameter
///   double area() const;
///   double mismatch(const T& pair) const;
///       by how much the pair's face differs from this one turned about `up`, as a share of its
///       size
/// It may have
///   template <class Layout> void lay_out(Layout& layout) const;
///       how lanes hold it: as what `OutlineLayout` in lanes/face_plan.cpp offers (a polygon, an
///       ellipse). What has none is left to the scalar engine, and all of its scene with it
/// and is immutable.
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "portal/concave_polygon.h"
#include "portal/convex_polygon.h"
#include "portal/ellipse.h"

namespace portalens {

using Aperture = std::variant<ConvexPolygon, ConcavePolygon, Ellipse>;

/// The first of the list that the input is.
[[nodiscard]] std::optional<Aperture> aperture_from(const FaceInput& input);

/// Asks an aperture as `std::visit` does. Most are convex polygons: those first, and without a
/// call, for gravity asks in every step.
template <class Question>
[[nodiscard]] [[gnu::always_inline]] inline auto ask(const Aperture& aperture,
                                                     const Question& question) {
  if (const auto* convex = std::get_if<ConvexPolygon>(&aperture)) return question(*convex);
  return std::visit(question, aperture);
}

[[nodiscard]] std::string_view name_of(const Aperture& aperture);
[[nodiscard]] inline bool within(const Aperture& aperture, double x, double y, double slack) {
  return ask(aperture, [&](const auto& a) { return a.within(x, y, slack); });
}
[[nodiscard]] bool is_curved(const Aperture& aperture);
[[nodiscard]] std::vector<Vec3d> outline_of(const Aperture& aperture);
[[nodiscard]] PlaneBox box_of(const Aperture& aperture);
[[nodiscard]] double size_of(const Aperture& aperture);
[[nodiscard]] double area_of(const Aperture& aperture);
/// Infinite for two of different kinds.
[[nodiscard]] double mismatch(const Aperture& aperture, const Aperture& pair);

}  // namespace portalens
