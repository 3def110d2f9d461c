/// \file
/// A hierarchy of boxes: which of many items may a ray meet, which may be near a point. Embree is
/// behind it, and nowhere else: it walks boxes in float; what is in them is decided in double by
/// whoever asks. So answers never depend on how the tree was built, nor on the processor.
#pragma once

#include <cstdint>
#include <memory>

#include "geometry/ray.h"

namespace portalens {

/// Where trees are built. Trees keep it alive.
class TreeBuilder {
 public:
  /// @throws WorkError if Embree doesn't start
  TreeBuilder();
  ~TreeBuilder();
  TreeBuilder(TreeBuilder&&) noexcept;
  TreeBuilder& operator=(TreeBuilder&&) noexcept;

 private:
  friend class BoxTree;
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Immutable, safe from any thread.
///
/// Float coordinates are relative to the middle of the tree, rays are clipped to it in double
/// first, and every box is grown by what float may lose: items are visited too often, never too
/// seldom.
class BoxTree {
 public:
  /// @param box_of  the box of each item, by its index below `count`; finite, within ±1e13
  /// @throws WorkError if memory runs out
  template <class BoxOf>
  BoxTree(const TreeBuilder& builder, std::uint32_t count, const BoxOf& box_of)
      : BoxTree(builder, count, &box_of, [](const void* function, std::uint32_t item) {
          return (*static_cast<const BoxOf*>(function))(item);
        }) {}
  ~BoxTree();
  BoxTree(BoxTree&&) noexcept;
  BoxTree& operator=(BoxTree&&) noexcept;

  [[nodiscard]] const Box& bounds() const { return bounds_; }

  /// Calls `visit(item)` for the items that the ray may meet between `low` and `high`, some others,
  /// and roughly the near ones first. It returns the new `high`, not above the last; below `low`
  /// ends the walk soon.
  template <class Visit>
  void along(const Ray& ray, double low, double high, const Visit& visit) const {
    walk(ray, low, high, &visit, &forward<Visit>);
  }

  /// Calls `visit(item)` for the items within `radius` of `x`, and some others. It returns the new
  /// radius, not above the last; 0 or less ends the walk soon.
  /// @pre `x` is within 1e6 diagonals of the tree; `radius` may be infinite
  template <class Visit>
  void around(Vec3d x, double radius, const Visit& visit) const {
    search(x, radius, &visit, &forward<Visit>);
  }

 private:
  using GetBox = Box (*)(const void*, std::uint32_t);
  using Call = double (*)(const void*, std::uint32_t);
  struct Implementation;

  BoxTree(const TreeBuilder& builder, std::uint32_t count, const void* function, GetBox get_box);
  template <class Visit>
  static double forward(const void* visit, std::uint32_t item) {
    return (*static_cast<const Visit*>(visit))(item);
  }
  void walk(const Ray& ray, double low, double high, const void* visit, Call call) const;
  void search(Vec3d x, double radius, const void* visit, Call call) const;

  Box bounds_;
  Vec3d middle_;
  double slack_ = 0.0;  ///< how much larger each box is than its item's
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace portalens
