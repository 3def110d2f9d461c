/// \file
/// Fewer photons: where the photons of a coarse sampling grid over the picture agree, what those
/// between them would have found is interpolated.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "photon/beam.h"
#include "photon/path_record.h"
#include "photon/photon.h"
#include "render/bicubic.h"
#include "render/camera_photon.h"
#include "render/film.h"
#include "render/grid.h"
#include "render/tally.h"
#include "world/world.h"

namespace portalens {

/// The sampling grid over one tile. Its nodes, and what is decided about its cells, depend on their
/// place in the whole picture alone, so a sample's arrival doesn't depend on the tile, the crop or
/// the other samples. A cell that can't be interpolated from the sixteen probe rays round it is
/// tried with sixteen aside of it; then, if it is of the largest, or nothing but its bend is too
/// large, in quarters; and where all that fails, each photon goes its own way.
class SamplingGrid {
 public:
  /// Borrows both.
  SamplingGrid(const World& world, const BeamGuard& guard, const Window& tile);

  /// Forgets everything, for another tile, but probe rays that both may ask for. Fresh memory costs
  /// more than what is done in it.
  void lay_over(const Window& tile);

  /// Where the photons of camera samples arrive.
  /// @param places  of the samples on the film, within the tile; no row of pixels comes after one
  ///                below it, in other calls neither
  void advance(std::span<const FilmPlace> places, std::span<Arrival> arrivals, Tally& tally);

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  /// A cell, and where those lie that it is interpolated from.
  struct Cell {
    int stride;  ///< nodes from corner to corner
    int column, row;
    bool clear = false;  ///< nothing lies in it but what its probe rays met
    NodeStep aside{};    ///< from the nodes about it to the inner four of the sixteen
  };
  /// A cell that is interpolated.
  struct Patch {
    Bicubic found;
    double left, top, side;  ///< on the film

    explicit Patch(const Cell& cell);
  };
  /// What photons met that can be told by each other: the same kind.
  struct Kind {
    Fate fate;
    Met met;
    std::uint32_t object, face, crossings;
    std::uint64_t portals;  ///< that were entered

    friend bool operator==(const Kind&, const Kind&) = default;
  };
  /// At four by four nodes.
  using Kinds = std::array<std::array<std::uint32_t, 4>, 4>;

  void keep_probe_rays();
  /// Whether samples of the tile may lie in it.
  [[nodiscard]] bool holds_samples(const Cell& cell) const;
  /// Decides what lies in some coarse rows from that one on; those left out before stay undecided.
  void settle_from(int row, Tally& tally);
  void want_probe_rays(bool finest);
  void send_probe_rays(Tally& tally);
  /// @param portals  that its photon entered, as a path record tells them
  [[nodiscard]] std::uint32_t kind_of(const Arrival& arrival, std::uint64_t portals);
  void decide(const Cell& cell);
  void look_aside(const Cell& cell, const Kinds& kinds);
  void halve(const Cell& cell, bool clear);
  /// Along the edge of a coarse cell where it is least.
  [[nodiscard]] const PixelSpan& pixel_in(int column, int row);

  /// The probe ray that went through that very place, if there was one.
  [[nodiscard]] std::uint32_t probe_ray_at(const FilmPlace& place) const;
  /// Null where there is none.
  [[nodiscard]] const Patch* patch_at(const FilmPlace& place) const;
  void send_left(std::span<const FilmPlace> places, std::span<Arrival> arrivals);

  const World& world_;
  const BeamGuard& guard_;
  PhotonSource source_;
  Window tile_;
  int settled_ = 0;                           ///< the coarse row down to which is decided
  Grid<std::uint32_t> nodes_, nodes_before_;  ///< the probe rays at them, here and a tile before
  Grid<PixelSpan> pixels_;                    ///< in coarse cells; below 0 until asked for
  Grid<std::uint32_t> cells_;                 ///< the patches that the smallest cells lie in
  std::vector<Patch> patches_;
  std::vector<Cell> undecided_, next_;

  std::vector<FilmPlace> aims_;  ///< where photons go through that have not been sent yet
  std::vector<Photon> probe_rays_;
  std::vector<Arrival> arrivals_;     ///< of the probe rays
  std::vector<PathRecord> records_;   ///< of the probe rays, and room for more
  std::vector<std::uint32_t> kinds_;  ///< of the probe rays; `none` if nobody else can tell it
  std::vector<Kind> known_kinds_;
  /// A probe ray of the tile before, and the node that it is at.
  struct Kept {
    std::uint32_t probe_ray;
    std::uint32_t* node;
  };
  std::vector<Kept> kept_;

  std::vector<std::uint32_t> left_;  ///< samples of a call whose photons go their own path
  std::vector<Photon> own_;          ///< these
  std::vector<Arrival> found_;       ///< and what they found
};

}  // namespace portalens
