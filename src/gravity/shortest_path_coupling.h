/// \file
/// `shortest-path`: each mass acts along the shortest path to it, directly and through each chain
/// of portals. Ours; equations.md, sec. 5.
///
/// A chain A1 … Ak (never straight back through a pair) is unfolded: the mass and the faces behind
/// A1 are carried to where they seem to be. With D the length of the shortest path over the faces,
/// it adds, where D < R,
///
///     G M D u / (D² + a²)^(3/2)     u = unit vector along which that way sets out
///
/// the gradient of G M / D where a = 0, with kinks where the path changes edges and at D = R.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gravity/coupling_input.h"
#include "gravity/shortest_way.h"

namespace portalens {

class ShortestPathCoupling {
 public:
  static constexpr std::string_view name = "shortest-path";
  static constexpr bool asks_motion = true;

  /// @pre 0 <= depth <= max_chain
  explicit ShortestPathCoupling(const CouplingInput& input);
  [[nodiscard]] static CouplingCost cost(const CouplingInput& input);

  [[nodiscard]] Pull pull(Vec3d x, Vec3d anchor) const;
  [[nodiscard]] std::uint64_t signature(Vec3d x) const;
  template <class Layout>
  [[nodiscard]] std::string lay_out(Layout& layout) const {
    return layout.shortest_paths(*this);
  }
  [[nodiscard]] double distance_to_support(Vec3d x) const;
  [[nodiscard]] double distance_to_discontinuity(Vec3d x) const;

  /// One part a chain and mass. Unfolded, as all looks from x: `places` are the bends of the path,
  /// `beyond` is where the mass seems to be; `distance` is D.
  [[nodiscard]] std::vector<PullPart> parts(Vec3d x) const;

  /// One mass through one chain.
  struct Image {
    Vec3d center;  ///< p', where the mass seems to be
    double gm, core2, influence;
    double beyond;       ///< lower bound of the path from the chain's first face to `center`
    std::uint32_t link;  ///< the last of its chain
    std::uint32_t mass;  ///< index into the masses of the input
  };
  [[nodiscard]] const std::vector<Image>& images() const { return images_; }
  /// The portals of an image's chain, the first one first.
  [[nodiscard]] std::vector<std::uint32_t> chain(const Image& image) const;
  /// The shortest path to one image; its length is infinite where the image doesn't act.
  [[nodiscard]] Way way(const Image& image, Vec3d x) const;

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  /// The last portal of a chain, unfolded.
  struct Link {
    PortalFace face;
    std::uint32_t portal, parent, first, size;  ///< `first` portal of the chain, its length
  };
  /// Where the chains through one portal first can act.
  struct Entrance {
    Vec3d center;
    double radius, reach;
  };
  using Row = std::array<const PortalFace*, max_chain>;

  void add_chains(const CouplingInput& input, std::vector<std::uint32_t>& chain,
                  std::uint32_t parent);
  void add_images(const CouplingInput& input, const std::vector<std::uint32_t>& chain,
                  std::uint32_t link);
  [[nodiscard]] FaceRow faces_of(const Image& image, Row& row) const;
  [[nodiscard]] double distance_to_discontinuity(const Image& image, Vec3d x) const;
  /// What an image adds, its path being known.
  [[nodiscard]] static Vec3d attraction(const Image& image, Vec3d x, const Way& way);
  [[nodiscard]] bool decide(const Image& image, Vec3d x, FaceRow faces, Turns& out) const;

  std::vector<Link> links_;
  std::vector<Image> images_;
  std::vector<Entrance> entrances_;  ///< one a portal
  std::vector<PortalFace> faces_;    ///< where the portals truly are
};

}  // namespace portalens
