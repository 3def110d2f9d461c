/// \file
/// Taking a picture from camera to film, as `render` does and without it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/image.h"
#include "math/vec3.h"
#include "photon/photon.h"
#include "render/film.h"
#include "render/render.h"
#include "render/sampling_grid.h"
#include "render/wave.h"
#include "support/subject.h"
#include "world/world.h"

namespace portalens::benchmarks {

/// The whole picture by the program, unencoded.
[[nodiscard]] inline RenderResult take_picture(const World& world, int threads = 1,
                                               Engine engine = Engine::automatic,
                                               Photons photons = Photons::all) {
  RenderOptions options;
  options.threads = threads;
  options.engine = engine;
  options.photons = photons;
  return render(world, options);
}

/// Arrivals of the photons of `camera_photons(world, every)`, in the tiles of `render`, which may
/// be interpolated between their neighbours. @pre the world's photons can travel in lanes
inline void interpolate(const World& world, const BeamGuard& guard, int every,
                        std::span<Arrival> arrivals) {
  const Tiling tiles({0, 0, world.film.width, world.film.height}, tile_size_of(world, {}));
  const int columns = (world.film.width + every - 1) / every;
  struct Sampled {
    PixelSample pixel;
    std::size_t index;
  };
  const auto is_above = [](const Sampled& a, const Sampled& b) { return a.pixel < b.pixel; };
  SamplingGrid sampling_grid(world, guard, tiles[0]);
  std::vector<Sampled> sampled;
  std::vector<FilmPlace> places;
  std::vector<Arrival> found;
  Tally tally;
  for (std::size_t t = 0; t < tiles.count(); ++t) {
    const Window tile = tiles[t];
    sampled.clear();
    for (int row = tile.y0 / every; row * every < tile.y1; ++row)
      for (int column = tile.x0 / every; column * every < tile.x1; ++column) {
        const PixelSample pixel = sampled_pixel(world, every, column, row);
        if (tile.holds({pixel.x, pixel.y, pixel.x + 1, pixel.y + 1}))
          sampled.push_back({pixel, static_cast<std::size_t>(row) * columns + column});
      }
    if (!std::is_sorted(sampled.begin(), sampled.end(), is_above))
      std::sort(sampled.begin(), sampled.end(), is_above);
    places.clear();
    for (const auto& [pixel, index] : sampled) places.push_back({pixel.x + 0.5, pixel.y + 0.5});
    found.resize(places.size());
    sampling_grid.lay_over(tile);
    sampling_grid.advance(places, found, tally);
    for (std::size_t i = 0; i < sampled.size(); ++i) arrivals[sampled[i].index] = found[i];
  }
}

/// One pixel of every n × n, shaded by the program, with photons that `ray_state` advances.
/// @param ray_state  called as `ray_state(photons, arrivals)`
template <class RayState>
[[nodiscard]] std::vector<Rgb> take_pixels(const World& world, int every,
                                           const RayState& ray_state) {
  const std::vector<Photon> photons = camera_photons(world, every);
  WaveRoom room;
  std::vector<Rgb> film(photons.size());
  Tally tally;
  carry_light(world.space, world.appearance, photons, room, film, ray_state, tally);
  return film;
}

}  // namespace portalens::benchmarks
