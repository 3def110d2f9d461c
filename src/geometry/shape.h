/// \file
/// The list of shapes. To add one: a header beside this one, and a word in `Shape`.
///
/// Each type has
///   static constexpr std::string_view name;            its table's kind in a scene file
///   static T from(Parameters&);                        faults are collected there
///       neither, if no table makes it
///   Box bounds() const;
///   std::optional<Contact> intersect(const Ray&, double low, double high) const;
///       the nearest contact at low <= distance <= high; both sides of a surface count
///   SurfacePoint surface_at(Vec3d x, std::uint32_t face) const;   x lies on that face
///   double clearance(const Segment&) const;
///       a lower bound of the distance between the segment and the surface, 0 if unsure
///   Vec3d center_of_mass() const;                      equations.md, section 2
///   double area() const;
///   SurfacePoint sample(double u1, double u2) const;   uniform by area
///   std::vector<FlatFace> flat_faces() const;          the flat ones of its faces; none if curved
/// It may have
///   SeenSurface sample_seen(Vec3d x, double u1, double u2) const;
///       a point of what is seen of it from x, were it alone, about uniform by solid angle: as a
///       lamp it makes less noise. What has none is sampled by area, its far side, too
///   template <class Layout> bool lay_out(Layout& layout) const;
///       how lanes hold it: as what `ShapeLayout` in lanes/surface_plan.cpp offers (a polygon of 3
///       or 4 corners, a ball); false where that has no room. What has none, or no room, is held by
///       its box: the scalar engine takes the steps in there
/// and is immutable. A contact doesn't depend, to the bit, on `low` and `high`, which only select:
/// so asking again with `low` just beyond a contact gives the next one. `Mesh` tries its triangles
/// one by one; the accelerator finds the few that matter.
#pragma once

#include <variant>

#include "geometry/cone.h"
#include "geometry/cube.h"
#include "geometry/cylinder.h"
#include "geometry/disk.h"
#include "geometry/mesh.h"
#include "geometry/quad.h"
#include "geometry/ring.h"
#include "geometry/sphere.h"

namespace portalens {

using Shape = std::variant<Sphere, Quad, Cube, Cone, Cylinder, Ring, Disk, Mesh>;

}  // namespace portalens
