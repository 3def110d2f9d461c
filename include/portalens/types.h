/// \file
/// Small values that several headers share.
#pragma once

namespace portalens::api {

/// A place or a direction, right-handed; lengths are in the scene's own unit.
struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;

  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// Where a photon starts, and where to. The direction need not be of length 1, only not zero.
struct Ray {
  Vec3 origin, direction;
};

/// Pixels x0 <= x < x1, y0 <= y < y1, counted from the top left of the whole picture.
struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  [[nodiscard]] int width() const { return x1 - x0; }
  [[nodiscard]] int height() const { return y1 - y0; }
  friend bool operator==(const Window&, const Window&) = default;
};

/// How a photon ends: on a surface; in a mass; far away; by never coming to an end, as round a
/// black hole; or by a step that could not be computed.
enum class Fate { hit, absorbed, escaped, trapped, lost };

/// "hit", "absorbed", "escaped", "trapped", "lost".
[[nodiscard]] const char* to_string(Fate fate) noexcept;

}  // namespace portalens::api
