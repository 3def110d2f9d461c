/// \file
/// A quick look along shadow rays. Most paths to a light pass everything by far: that is seen from
/// planes, balls and boxes around what a scene holds, with a few products each, and `visible` need
/// not be asked. Most of these in turn lie far from all paths of a batch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shading/shadow.h"

namespace portalens {

/// Holds what can lie across a path, unless that is much: then a tree is quicker. Immutable, safe
/// from any thread, and quickly made: for a few hundred queries it pays.
class OcclusionPretest {
 public:
  OcclusionPretest() = default;  ///< nothing is surely free
  explicit OcclusionPretest(const Space& space);

  /// True only if `visible(space, query)` is. What comes through a portal is left to that.
  [[nodiscard]] bool surely_free(const ShadowQuery& query) const;

  /// Makes this a screen for those queries alone, of what `whole` holds near any of them.
  void narrow(const OcclusionPretest& whole, std::span<const ShadowQuery> queries);

 private:
  /// Of an obstacle: with the coordinates' own rounding, by how much a path must miss it.
  struct Block {
    Vec3d middle, half;  ///< a box around it
    double slack = 0.0;
    std::uint32_t shape = no_object;  ///< or a portal, by the number of its opening
  };
  /// A polygon: its plane is where dot(normal, x) == offset.
  struct Plane {
    Vec3d normal;
    double offset = 0.0;
    double rounding = 0.0;  ///< how far off the plane points on it may lie
    Block block;
    /// Where it lies in one plane with others: on which side of that plane's normal its own is, and
    /// how far off points of the others may lie.
    std::uint32_t plane = LeftPlane::none;
    double side = 1.0, thickness = 0.0;
  };
  struct Ball {
    Vec3d center;
    double radius = 0.0, slack = 0.0;
    std::uint32_t shape = no_object;
  };
  struct Way;

  template <class Vertices>
  void add_plane(const Vertices& vertices, Vec3d normal, std::uint32_t shape);
  void add_ball(Vec3d center, double radius, std::uint32_t shape);

  [[nodiscard]] static bool misses(const Way& way, const Plane& plane);
  /// Whether a path that ends at that height over the plane has begun on it, or on what lies in it.
  [[nodiscard]] static bool has_left(const Plane& plane, double begin, double end,
                                     const SelfIntersectionGuard& guard, const LeftPlane& left);
  [[nodiscard]] static bool misses(const Way& way, const Ball& ball);
  [[nodiscard]] static bool misses(const Way& way, const Block& block);
  [[nodiscard]] bool is_left(const Plane& plane, const Way& way,
                             std::span<const ShadowQuery> queries) const;

  bool complete_ = false;
  const FlushFaces* flush_ = nullptr;  ///< null where no shape lies in the plane of something else
  std::vector<Plane> planes_;
  std::vector<Ball> balls_;
  std::vector<Block> blocks_;
};

}  // namespace portalens
