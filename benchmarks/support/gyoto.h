/// \file
/// Running GYOTO (Vincent et al., Class. Quantum Grav. 28, 225011, 2011; Debian's gyoto-bin), and
/// what it should find around a black hole that doesn't rotate.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "math/vec3.h"

namespace portalens::benchmarks {

/// Photons through a square screen that looks at a Schwarzschild hole of mass 1, until they are on
/// their way out beyond `far`, or captured.
struct GyotoScene {
  int side = 0;            ///< pixels
  double distance = 100;   ///< of the screen
  double far = 100;        ///< radius at which photons have escaped
  double view = 0.4;       ///< angle over the screen, radians
  double judged_from = 1;  ///< impact parameter, in those of capture, below which none are judged
  std::string integrator;  ///< as GYOTO calls it
  double tolerance = 0;    ///< relative and absolute, of each step
};

struct GyotoRun {
  double processor_seconds = 0;
  /// For each pixel that shows the sky, the angle between the direction in which the photon leaves
  /// for infinity and the one that it should have, radians.
  std::vector<double> errors;
  int captured = 0;    ///< pixels that show the hole
  int mismatched = 0;  ///< and those that should show the other
};

/// @param program  path of `gyoto`
/// @param folder   for its input and output
/// @throws WorkError if it fails, or its output can't be understood
[[nodiscard]] GyotoRun run_gyoto(const std::string& program, const GyotoScene& scene,
                                 const std::filesystem::path& folder);

/// The hole's pull bends light at the impact parameter b so that it sweeps this angle from radius
/// r, outside of the turning point, outwards to infinity. @pre b > sqrt(27)
[[nodiscard]] double schwarzschild_sweep(double b, double r);
/// From the turning point to infinity.
[[nodiscard]] double schwarzschild_half_sweep(double b);

/// The program of that name: a path that exists, or one found along PATH.
[[nodiscard]] std::optional<std::string> find_program(const std::string& name);

}  // namespace portalens::benchmarks
