/// \file
/// The paper's method, faithfully: one photon at a time in double, explicit Euler in fixed steps,
/// every mass and portal asked at every step, every surface tried on every segment. What the
/// program is compared with. Dunigan & Pianta, sec. 4 to 6.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "photon/photon.h"
#include "photon/space.h"

namespace portalens::reference {

class PaperMethod {
 public:
  /// @param depth  of gravity through portals (closest point); 0 leaves it out
  PaperMethod(const Space& space, double step, int depth);

  [[nodiscard]] Arrival advance(const Photon& photon) const;

 private:
  /// What a segment meets: a portal, else a surface; `distance` is that of the step if neither.
  struct Meeting {
    double distance = 0.0;
    std::uint32_t surface = no_object;
    std::optional<std::uint32_t> entered = std::nullopt;
  };

  [[nodiscard]] Vec3d acceleration(Vec3d x, int depth, std::uint32_t left_out) const;
  /// @param left  the portal that it comes out of
  [[nodiscard]] Meeting first_met(const Ray& ray, std::uint32_t left) const;
  [[nodiscard]] std::optional<std::uint32_t> horizon_about(Vec3d x) const;
  [[nodiscard]] bool beyond_everything(Vec3d x, Vec3d direction) const;

  const Space& space_;
  double step_;
  int depth_;
  std::vector<double> reach_;  ///< [depth][portal]: within it the portal acts
  struct Ball {
    Vec3d center;
    double radius;
  };
  std::vector<Ball> balls_;  ///< outside all of them nothing bends and nothing is met
};

}  // namespace portalens::reference
