/// \file
/// Fewer photons: where the photons of a coarse lattice over the picture agree, what those between
/// them would have found is interpolated.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "photon/beam.h"
#include "photon/photon.h"
#include "photon/trail.h"
#include "render/camera_photon.h"
#include "render/film.h"
#include "render/tally.h"
#include "world/world.h"

namespace portalens {

/// How far the photons of neighbouring pixels begin apart.
struct PixelSpan {
  double angle = 0.0;  ///< of their directions, radians
  double aside = 0.0;  ///< of their places
};

/// The photons about a cell of the lattice that agree, four each way, and the polynomial of the
/// third degree each way through what they found.
class Bicubic {
 public:
  using Guides = std::array<std::array<const Arrival*, 4>, 4>;
  class Row;

  /// Whether they met the same, and it is something that can be interpolated.
  [[nodiscard]] static bool agree(const Space& space, const Guides& guides);
  /// False where the guides differ in more than a smooth function of their place would.
  /// @param most  third difference, pixels
  /// @pre they agree
  [[nodiscard]] bool through(const Space& space, const Guides& guides, const PixelSpan& pixel,
                             double most);

 private:
  /// What is interpolated: homogeneous coordinates of the place, which over a plane are linear
  /// where light is straight, the direction, and how far and how much the way turned; all relative
  /// to the model, so that floats are enough. The rest is 0.
  using Values = std::array<float, 12>;
  /// Coefficients of a polynomial of the third degree, from that of the constant.
  using Cubic = std::array<Values, 4>;

  [[nodiscard]] static Cubic cubic_through(const Values& before, const Values& first,
                                           const Values& second, const Values& after);
  [[nodiscard]] static Values value(const Cubic& cubic, float at);

  Arrival model_;                   ///< one of the guides
  const Sphere* sphere_ = nullptr;  ///< that it is on
  /// By the share of the cell from the left, and their coefficients by that from above.
  std::array<Cubic, 4> cubics_{};
};

/// What photons would have found along a row of a cell. Borrows the cell.
class Bicubic::Row {
 public:
  /// @param v  share of the cell, from its upper edge
  Row(const Bicubic& cell, double v);
  /// @param u  share of the cell, from its left edge
  void tell(double u, Arrival& arrival) const;

 private:
  const Bicubic& cell_;
  Cubic cubic_;
};

/// The lattice over one tile. Its nodes, and what is decided about its cells, depend on their place
/// in the whole picture alone, so a sample's arrival doesn't depend on the tile, the crop or the
/// other samples. Cells that can't be interpolated are tried again at half their size, and where
/// that fails, too, each photon goes its own way.
class Lattice {
 public:
  /// Borrows both.
  Lattice(const World& world, const BeamGuard& guard, const Window& tile);

  /// Forgets everything, for another tile. Fresh memory costs more than what is done in it.
  void lay_over(const Window& tile);

  /// Where the photons of camera samples arrive.
  /// @param places  of the samples on the film, within the tile; no row of pixels comes after one
  ///                below it, in other calls neither
  void advance(std::span<const FilmPlace> places, std::span<Arrival> arrivals, Tally& tally);

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  /// Cells of one size: their column and row are counted from that of the first.
  struct Level {
    int stride;  ///< nodes from corner to corner
    int first_column = 0, first_row = 0, columns = 0, rows = 0;
    std::vector<std::uint32_t> smooth{};  ///< the polynomial of each cell, if there is one

    /// So many cells, none of them smooth.
    void clear(int first_column, int first_row, int columns, int rows);
  };
  struct Cell {
    int column, row;
  };
  /// A place in its cell.
  struct Spot {
    std::size_t cell;
    double u, v;  ///< shares of the cell, from its upper left corner
  };

  /// Which guide is at a node.
  [[nodiscard]] std::uint32_t& node(int column, int row) {
    return nodes_[static_cast<std::size_t>(row - first_row_) * columns_ +
                  static_cast<std::size_t>(column - first_column_)];
  }
  [[nodiscard]] static Spot spot_in(const Level& level, const FilmPlace& place);
  void settle_from(int row, Tally& tally);
  void settle(Level& level, Tally& tally);
  void send_guides(const Level& level, Tally& tally);
  void decide(Level& level, const Cell& cell);
  [[nodiscard]] const PixelSpan& pixel_at(int column, int row);
  /// At the corner of the cell where it is least.
  [[nodiscard]] PixelSpan pixel_in(const Level& level, const Cell& cell);
  /// @return the polynomial for that place, and puts into `spot` where that is
  [[nodiscard]] std::uint32_t smooth_at(const FilmPlace& place, Spot& spot) const;
  void send_left(std::span<const FilmPlace> places, std::span<Arrival> arrivals);

  const World& world_;
  const BeamGuard& guard_;
  FilmCamera view_;
  Window tile_;
  Level coarse_{2}, fine_{1};
  double settled_ = 0.0;  ///< the place on the film down to where cells are decided
  int first_column_ = 0, first_row_ = 0;
  std::size_t columns_ = 0;
  std::vector<std::uint32_t> nodes_;
  std::vector<Photon> guides_;
  std::vector<PixelSpan> pixels_;  ///< of the guides; less than 0 until they are asked for
  std::vector<Arrival> arrivals_;  ///< of the guides
  std::vector<Trail> trails_;      ///< of the guides, and room for more
  std::vector<Bicubic> smooth_;
  std::vector<Cell> undecided_;
  std::vector<std::uint32_t> left_;  ///< samples whose photons go their own way
  std::vector<Photon> own_;          ///< these
  std::vector<Arrival> found_;       ///< and what they found
};

}  // namespace portalens
