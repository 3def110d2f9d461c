#include "app/ring_size.h"

#include <cmath>

#include "gravity/mass.h"

namespace portalens {

std::optional<double> ring_pixels(const World& world, const Mass& mass) {
  constexpr double widest = 0.3;  // radians, of its radius
  const Camera& camera = world.camera;
  const double distance = length(mass.center - camera.position);
  const double m =
      world.space.medium.far_weight * gravitational_radius(mass.gm, world.space.physics.c);
  if (camera.projection != Projection::perspective || !(m > 0.0)) return std::nullopt;
  const double angle = std::sqrt(2.0 * m / distance);
  if (!(angle < widest) || !(angle * distance < mass.influence)) return std::nullopt;
  const Film& film = world.film;
  const auto through = [&](double aside) {
    return camera.ray(0.5 * film.width + aside, 0.5 * film.height, film.width, film.height)
        .direction;
  };
  return 2.0 * angle / length(through(0.5) - through(-0.5));
}

}  // namespace portalens
