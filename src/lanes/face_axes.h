/// \file
/// Over lanes: places and paths in the axes of a flat face, and how far a path is from one.
#pragma once

#include "lanes/path.h"
#include "lanes/scene.h"
#include "math/multiply_add.h"
#include "math/vec3.h"

namespace portalens {

template <class R>
Vec3<R> spread(LaneVec v) {
  return {R(v.x), R(v.y), R(v.z)};
}

/// In local coordinates of a frame.
template <class R>
Vec3<R> to_axes(Vec3<R> d, LaneVec right, LaneVec up, LaneVec normal) {
  return {dot(d, spread<R>(right)), dot(d, spread<R>(up)), dot(d, spread<R>(normal))};
}

/// A direction from the axes of a face.
template <class R, class Face>
Vec3<R> to_world(const Face& face, Vec3<R> local) {
  const Vec3<R> level = multiply_add(spread<R>(face.up), local.y, spread<R>(face.right) * local.x);
  return multiply_add(spread<R>(face.normal), local.z, level);
}

/// A place in the local coordinates of a face.
template <class R>
Vec3<R> local_in(const LaneFace& face, Vec3<R> x) {
  return to_axes(x - spread<R>(face.origin), face.right, face.up, face.normal);
}

/// A step's path in the local coordinates of a face.
template <class R>
struct LocalPath {
  LaneQuintic<R, R> x, y, z;

  /// @param face  has `origin`, `right`, `up`, `normal`
  template <class Face>
  [[nodiscard]] static LocalPath over(const Face& face, const LanePath<R>& path) {
    const Vec3<R> start =
        to_axes(path.place.c0 - spread<R>(face.origin), face.right, face.up, face.normal);
    return {path.height(start.x, spread<R>(face.right)), path.height(start.y, spread<R>(face.up)),
            path.height(start.z, spread<R>(face.normal))};
  }
};

/// The square of a path's distance from a face, less that of the face's reach. Where the face acts,
/// it is the distance from the feature held over the step; elsewhere from the nearest feature at
/// each place, and jumps where the path passes the face's plane from behind.
template <class R, class Face, class Nearest>
struct LaneApart {
  const Face& face;  ///< has `reach2`
  LocalPath<R> path;
  const Nearest& held;
  typename R::Mask acts;

  [[nodiscard]] R at(R u) const {
    const Vec3<R> from = from_face(u);
    return dot(from, from) - R(face.reach2);
  }
  [[nodiscard]] R slope(R u) const {
    const Vec3<R> way{path.x.slope(u), path.y.slope(u), path.z.slope(u)};
    // What its nearest point moves by is at right angles to that.
    return R(2) * dot(from_face(u), way);
  }
  /// The height over the face's plane.
  [[nodiscard]] const LaneQuintic<R, R>& plane() const { return path.z; }

 private:
  [[nodiscard]] Vec3<R> from_face(R u) const {
    const Vec3<R> local{path.x.at(u), path.y.at(u), path.z.at(u)};
    Nearest nearest_point = held;
    if (any(!acts)) nearest_point.take(!acts, Nearest::on(face, local));
    return local - nearest_point.place(local);
  }
};

}  // namespace portalens
