/// \file
/// Following single photons, in double precision.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "portalens/types.h"
#include "portalens/world.h"

namespace portalens::api {

/// A surface that a photon was mirrored by, on its way.
struct Bounce {
  std::string object;
  Vec3 position;
  Vec3 direction;                      ///< in which it came; length 1
  double length = 0.0, turning = 0.0;  ///< since the start, as in `Trace`
};

/// The way of one photon.
struct Trace {
  Fate fate = Fate::lost;
  std::string object;    ///< what was hit or what swallowed it; empty if nothing
  Vec3 position;         ///< where it ended, in the coordinates of where it ended
  Vec3 direction;        ///< in which it went there; length 1
  double length = 0.0;   ///< of the way
  double turning = 0.0;  ///< by how much it bent in all, radians
  std::uint32_t steps = 0;
  std::vector<std::string> crossings;  ///< the portals that it entered, in order
  std::vector<Bounce> bounces;         ///< at most `TraceOptions::bounces`
  /// The points of the way, one polyline between a portal and the next; if they were asked for.
  std::vector<std::vector<Vec3>> path;
};

struct TraceOptions {
  int bounces = 0;    ///< >= 0; so many surfaces are taken for mirrors, whatever they are made of
  bool path = false;  ///< whether the points of the way are told
  int threads = 0;    ///< >= 0; 0: as many as the machine runs at once
};

/// Follows photons, each by itself; the answers are in the order of the rays.
/// @throws Error (asked) that names every ray with a zero direction or a number that is not finite
[[nodiscard]] std::vector<Trace> trace(const World& world, std::span<const Ray> rays,
                                       const TraceOptions& options = {});
[[nodiscard]] Trace trace(const World& world, const Ray& ray, const TraceOptions& options = {});

/// Rays of one origin, spread evenly about a middle one in one plane.
/// @param across  what the plane is at right angles to, as nearly as the middle ray allows
/// @param spread  degrees between the first and the last, 0 to 360
/// @param count   >= 1
/// @throws Error (asked) if that is no fan
[[nodiscard]] std::vector<Ray> fan(const Ray& middle, Vec3 across, double spread, int count);

/// The camera's ray through a point of the picture.
/// @param x, y  in pixels from its top left corner: the first pixel's centre is (0.5, 0.5)
[[nodiscard]] Ray camera_ray(const World& world, double x, double y);

}  // namespace portalens::api
