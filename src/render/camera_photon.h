/// \file
/// The photons that the camera sends: where each sample of a pixel begins.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>

#include "photon/photon.h"
#include "render/sampler.h"
#include "world/world.h"

namespace portalens {

/// One camera sample; pixels are counted from the top left.
struct PixelSample {
  int x = 0, y = 0;
  std::uint32_t sample = 0;

  /// Row by row from the top left.
  friend bool operator<(const PixelSample& a, const PixelSample& b) {
    return std::tie(a.y, a.x, a.sample) < std::tie(b.y, b.x, b.sample);
  }
};

/// A point of the film, in pixels from its upper left corner.
struct FilmPlace {
  double x = 0.0, y = 0.0;
};

/// Where `render` sends that sample through: the pixel's centre if there is but one.
[[nodiscard]] inline FilmPlace film_place(const World& world, const PixelSampler& sampler,
                                          const PixelSample& at) {
  const auto [u, v] =
      world.sampling.samples == 1 ? std::array<double, 2>{0.5, 0.5} : sampler.position(at.sample);
  return {at.x + u, at.y + v};
}

[[nodiscard]] inline PixelSampler sampler_of(const World& world, const PixelSample& at) {
  return {static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y),
          static_cast<std::uint64_t>(world.sampling.seed)};
}

/// The photon of that sample, as `render` sends it through that place. `sample` and `slot` are left
/// 0.
/// @param view  the world's camera behind its film
[[nodiscard]] inline Photon camera_photon(const PixelSampler& sampler, const FilmCamera& view,
                                          const FilmPlace& place, std::uint32_t sample) {
  const Ray ray = view.ray(place.x, place.y);
  Photon photon;
  photon.position = ray.origin;
  photon.direction = ray.direction;
  photon.random_key = sampler.random_key(sample);
  return photon;
}
[[nodiscard]] inline Photon camera_photon(const World& world, const PixelSample& at) {
  const PixelSampler sampler = sampler_of(world, at);
  return camera_photon(sampler, FilmCamera(world.camera, world.film.width, world.film.height),
                       film_place(world, sampler, at), at.sample);
}

/// The photon through a pixel's centre, with the random numbers of its first sample.
[[nodiscard]] inline Photon central_photon(const World& world, int x, int y) {
  Photon photon = camera_photon(world, {x, y, 0});
  const Ray ray = world.camera.ray(x + 0.5, y + 0.5, world.film.width, world.film.height);
  photon.position = ray.origin;
  photon.direction = ray.direction;
  return photon;
}

}  // namespace portalens
