/// \file
/// Where the picture is taken from.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/parameters.h"
#include "geometry/ray.h"

namespace portalens {

enum class Projection { perspective, orthographic };

/// Which side of the film the field of view spans.
enum class FovAxis { x, y, smaller, larger };

/// `right = forward × up`; pixel (0, 0) is top left. Immutable.
struct Camera {
  Projection projection = Projection::perspective;
  Vec3d position;
  Vec3d right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  ///< orthonormal
  double fov = 40.0;                                     ///< degrees; perspective
  FovAxis fov_axis = FovAxis::y;
  double size = 1.0;  ///< height of the view, length; orthographic

  /// The `[camera]` table.
  /// @param whole  if given, a missing position, look_at or size is chosen so that this box is seen
  ///               whole from +z; if not, they are required
  static Camera from(Parameters& parameters, const std::optional<Box>& whole = std::nullopt);

  /// The ray through a point of the film: (0, 0) is its top left corner, (width, height) its bottom
  /// right one, so the centre of the first pixel is (0.5, 0.5).
  [[nodiscard]] Ray ray(double film_x, double film_y, int width, int height) const;
};

/// A point of the film, in pixels from its upper left corner.
struct FilmPlace {
  double x = 0.0, y = 0.0;
};

/// A camera with a film of some size: for many rays, what they share is worked out once. Borrows
/// the camera.
class FilmCamera {
 public:
  FilmCamera(const Camera& camera, int width, int height);

  /// As `Camera::ray`.
  [[nodiscard]] Ray ray(double film_x, double film_y) const;

  static constexpr std::size_t max_rays = 64;
  /// The same rays for many places, sooner: they are worked out side by side.
  /// @pre places.size() <= max_rays, rays.size() >= places.size()
  void rays(std::span<const FilmPlace> places, std::span<Ray> rays) const;

 private:
  const Camera& camera_;
  double width_, height_, aspect_;
  double half_height_;  ///< of the view: an angle's tangent, or a length
};

}  // namespace portalens
