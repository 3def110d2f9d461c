/// \file
/// The photons that the camera sends: where each sample of a pixel begins.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
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

/// What the photons of a film's samples share, worked out once. Borrows the world.
class PhotonSource {
 public:
  explicit PhotonSource(const World& world)
      : view_(world.camera, world.film.width, world.film.height),
        key_(static_cast<std::uint64_t>(world.sampling.seed)),
        central_(world.sampling.samples == 1) {}

  /// Where `render` sends that sample through: the pixel's centre if there is but one.
  [[nodiscard]] FilmPlace place(const PixelSample& at) const {
    if (central_) return {at.x + 0.5, at.y + 0.5};
    const auto [u, v] = sampler(at).position(at.sample);
    return {at.x + u, at.y + v};
  }
  [[nodiscard]] Ray ray(const FilmPlace& place) const { return view_.ray(place.x, place.y); }
  /// Puts photons on the rays of those places.
  /// @pre as many of both
  void send(std::span<const FilmPlace> places, std::span<Photon> photons) const {
    std::array<Ray, FilmCamera::max_rays> rays;
    for (std::size_t begin = 0; begin < places.size(); begin += rays.size()) {
      const auto some = places.subspan(begin, std::min(rays.size(), places.size() - begin));
      view_.rays(some, rays);
      for (std::size_t i = 0; i < some.size(); ++i) {
        photons[begin + i].position = rays[i].origin;
        photons[begin + i].direction = rays[i].direction;
      }
    }
  }
  [[nodiscard]] std::uint64_t random_key(const PixelSample& at) const {
    return sampler(at).random_key();
  }

 private:
  [[nodiscard]] PixelSampler sampler(const PixelSample& at) const {
    return {key_, static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y)};
  }

  FilmCamera view_;
  FilmKey key_;
  bool central_;  ///< a pixel's only sample lies in its centre
};

/// The photon of that sample, as `render` sends it. `sample` and `slot` are left 0.
[[nodiscard]] inline Photon camera_photon(const World& world, const PixelSample& at) {
  const PhotonSource source(world);
  const Ray ray = source.ray(source.place(at));
  Photon photon;
  photon.position = ray.origin;
  photon.direction = ray.direction;
  photon.random_key = source.random_key(at);
  photon.pixel_sample = at.sample;
  return photon;
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
