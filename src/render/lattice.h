/// \file
/// Fewer photons: where the photons of a coarse lattice over the picture agree, what those between
/// them would have found is interpolated.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
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

  /// Null where the guides differ in more than a smooth function of their place would, or end in
  /// what can't be interpolated: the third differences may be this share of a pixel.
  /// @param most  third difference, pixels
  [[nodiscard]] static std::unique_ptr<const Bicubic> through(const Space& space,
                                                              const Guides& guides,
                                                              const PixelSpan& pixel, double most);

  /// What a photon would have found at that share of the cell, from its upper left corner.
  [[nodiscard]] Arrival at(const Space& space, double u, double v) const;

 private:
  /// What is interpolated: homogeneous coordinates of the place, which over a plane are linear
  /// where light is straight, the direction, and how far and how much the way turned; all relative
  /// to the model, so that floats are enough. The rest is 0.
  using Values = std::array<float, 12>;

  Arrival model_;  ///< one of the guides
  std::array<Values, 16> values_{};
};

/// The lattice over one tile. Its nodes, and what is decided about its cells, depend on their place
/// in the whole picture alone, so a sample's arrival doesn't depend on the tile, the crop or the
/// other samples. Cells that can't be interpolated are tried again at half their size, and where
/// that fails, too, each photon goes its own way.
class Lattice {
 public:
  /// Borrows both.
  Lattice(const World& world, const BeamGuard& guard, const Window& tile);

  /// Where camera photons arrive.
  /// @param photons  where they begin is not looked at: it follows from their places
  /// @param places   of the photons on the film, within the tile
  void advance(std::span<const Photon> photons, std::span<const FilmPlace> places,
               std::span<Arrival> arrivals, Tally& tally);

 private:
  struct Node {
    bool known = false;
    Arrival arrival;
    Trail trail;
  };
  struct Cell {
    bool decided = false;
    std::unique_ptr<const Bicubic> smooth;
  };
  /// Cells of one size: their column and row are counted from that of the first.
  struct Level {
    int stride;  ///< nodes from corner to corner
    int first_column, first_row, columns, rows;
    std::vector<Cell> cells;
  };

  [[nodiscard]] static Level level(const Window& tile, int stride);
  [[nodiscard]] Node& node(int column, int row) {
    return nodes_[static_cast<std::size_t>(row - first_row_) * columns_ +
                  static_cast<std::size_t>(column - first_column_)];
  }
  /// A sample in its cell.
  struct Spot {
    std::uint32_t sample;
    std::uint32_t cell;
    double u, v;  ///< shares of the cell, from its upper left corner
  };

  [[nodiscard]] static Spot spot_in(const Level& level, const FilmPlace& place,
                                    std::uint32_t sample);
  void settle(Level& level, const std::vector<Spot>& spots, Tally& tally);
  void send_guides(const Level& level, const std::vector<std::size_t>& cells, Tally& tally);
  void decide(Level& level, std::size_t cell);
  /// At the corner of the cell where it is least.
  [[nodiscard]] PixelSpan pixel_in(const Level& level, int column, int row) const;
  /// @return the samples that could not be
  [[nodiscard]] std::vector<std::uint32_t> interpolate(const Level& level,
                                                       const std::vector<Spot>& spots,
                                                       std::span<Arrival> arrivals) const;

  const World& world_;
  const BeamGuard& guard_;
  FilmCamera view_;
  Level coarse_, fine_;
  int first_column_, first_row_;
  std::size_t columns_;
  std::vector<Node> nodes_;
};

}  // namespace portalens
