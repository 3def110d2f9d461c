/// \file
/// `graviton-map`: `closest-point` with what each portal passes on kept in a grid on its face. The
/// future work of Dunigan & Pianta, sec. 8; equations.md, sec. 5.
///
/// Nodes lie on the portal's bounding rectangle in (right, up), corners included,
/// `graviton_resolution` of them along the longer side, at the same or a smaller spacing across;
/// each holds the exact R_A⁻¹ g_{k-1}(T_A q), outside of the polygon too. Between the four nearest
/// it is bilinear. One look-up a portal, whatever the depth; the error falls with the square of the
/// spacing wherever the field is smooth.
///
/// The lines of the grid are decisions only beside cells whose kinks could be felt: where they put
/// the field off by so much that over the whole reach it would turn light by more than a share of
/// the tolerance.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gravity/closest_point_coupling.h"
#include "gravity/graviton_grid.h"

namespace portalens {

/// How far a map is from what it stands for, in the middles of its cells, where it is worst.
struct GravitonMapError {
  double typical = 0.0;  ///< root mean square of the difference over that of the exact field
  double largest = 0.0;  ///< largest difference over the largest exact field
};

class GravitonMapCoupling {
 public:
  static constexpr std::string_view name = "graviton-map";
  static constexpr bool asks_motion = true;

  explicit GravitonMapCoupling(const CouplingInput& input);
  [[nodiscard]] static CouplingCost cost(const CouplingInput& input);

  [[nodiscard]] Pull pull(Vec3d x, Vec3d anchor) const;
  [[nodiscard]] std::uint64_t signature(Vec3d x) const;
  template <class Layout>
  [[nodiscard]] std::string lay_out(Layout& layout) const {
    return layout.maps(*this);
  }
  [[nodiscard]] double distance_to_support(Vec3d x) const { return exact_.distance_to_support(x); }
  /// Of the reaches of all portals, and of sharp cells.
  [[nodiscard]] double distance_to_discontinuity(Vec3d x) const;

  /// One part a portal: its look-up. `places` has the nearest point of the face, `beyond` is that
  /// point moved through, and `distance` how far it is.
  [[nodiscard]] std::vector<PullPart> parts(Vec3d x) const;

  /// The coupling that the map stands for.
  [[nodiscard]] const ClosestPointCoupling& exact() const { return exact_; }
  /// @pre its reach is positive
  [[nodiscard]] const GravitonGrid& grid(std::uint32_t portal) const { return grids_[portal]; }
  /// Compares the map of one portal with `exact()` in the cells whose middle is on the face.
  [[nodiscard]] GravitonMapError error(std::uint32_t portal) const;

 private:
  /// Where on a portal's face a point draws from.
  struct Draw {
    Feature feature;
    GravitonGrid::Cell cell;
    GravitonGrid::Kind kind;
  };

  [[nodiscard]] bool draws(std::uint32_t portal, Vec3d x, Draw& draw) const;
  [[nodiscard]] GravitonGrid grid_on(std::uint32_t portal, const CouplingInput& input) const;

  ClosestPointCoupling exact_;
  std::vector<GravitonGrid> grids_;  ///< one a portal
};

}  // namespace portalens
