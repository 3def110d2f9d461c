/// \file
/// Whether the light between neighbouring photons does what they do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "geometry/shape.h"
#include "photon/beam_sections.h"
#include "photon/path_record.h"
#include "photon/photon.h"
#include "photon/space.h"

namespace portalens {

/// Looks for whatever could change the path of the light between four photons: surfaces, portals
/// and horizons that the four did not meet where they are, however small, and borders of the
/// masses' influences that run along between them. Immutable, safe from any thread; borrows the
/// space.
class BeamGuard {
 public:
  /// More would take longer than the photons that are saved.
  static constexpr std::size_t max_obstacles = 256;
  /// Whether there is not too much to look through for every beam.
  [[nodiscard]] static bool can_guard(const Space& space);
  /// Null where it can't.
  [[nodiscard]] static std::optional<BeamGuard> over(const Space& space);
  BeamGuard(BeamGuard&&) = default;

  /// True only if the beam between the four path records meets nothing but what they met. What they
  /// met themselves is the caller's to compare.
  /// @pre the path records are known, and entered the same portals
  /// @param end  how one of them ended
  [[nodiscard]] bool clear(const std::array<const PathRecord*, 4>& records,
                           const Arrival& end) const;

 private:
  /// Something that light can meet, within a ball.
  struct Obstacle {
    const Shape* shape;  ///< null: the ball itself
    Vec3d center;
    double radius;
    Reached near_center;  ///< the same to the next float
    float near_radius;
    /// `portal_back` for either side of a portal; `nothing` for a gap between corners of a portal
    /// that is not convex: light that others enter the portal with may go through it.
    Met kind;
    std::uint32_t index;  ///< of the shape, the portal, or the mass
    /// Of a quad or a portal in whose plane something else lies, else null.
    const FlushFaces::Place* place;
  };

  explicit BeamGuard(const Space& space);

  void add(std::span<const Vec3d> corners, Met kind, std::uint32_t index);
  void add(const Shape* shape, const Box& box, Met kind, std::uint32_t index);
  void add(const Shape* shape, Vec3d center, double radius, Met kind, std::uint32_t index);
  [[nodiscard]] static bool sinks(const Obstacle& obstacle, const BeamSection& section,
                                  const BeamSection& final);
  /// Whether what the light meets there is what the path records tell of.
  /// @param final  the last section of the beam
  [[nodiscard]] bool met(const Obstacle& obstacle, const BeamSection& section,
                         const BeamSection& final, const PathRecord& record,
                         const Arrival& end) const;
  /// Whether it is flat and lies under what the path has met there, in one plane with it, or in the
  /// plane that the path has just left.
  [[nodiscard]] bool hidden(const Obstacle& obstacle, const BeamSection& section,
                            const PathRecord& record, const Arrival& end) const;
  [[nodiscard]] static bool apart(const BeamSection& section, const Obstacle& obstacle);
  [[nodiscard]] static bool touches(const BeamSection& section, const Obstacle& obstacle);
  /// @param escapes  whether it runs off to the sky in the end
  [[nodiscard]] bool along_border(std::span<const BeamSection> beam, bool escapes) const;
  [[nodiscard]] bool is_felt(const Mass& mass, double widest) const;
  [[nodiscard]] static bool along_sphere(std::span<const BeamSection> stretch, const Mass& mass,
                                         double widest, bool runs_off);

  const Space* space_;
  std::vector<Obstacle> obstacles_;
  std::deque<Shape> faces_;  ///< of the portals; they stay where they are when this moves
};

}  // namespace portalens
