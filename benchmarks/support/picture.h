/// \file
/// Taking a picture from camera to film, as `render` does and without it.
#pragma once

#include <vector>

#include "core/image.h"
#include "math/vec3.h"
#include "photon/photon.h"
#include "render/render.h"
#include "render/wave.h"
#include "support/subject.h"
#include "world/world.h"

namespace portalens::benchmarks {

/// The whole picture by the program, unencoded.
[[nodiscard]] inline RenderResult take_picture(const World& world, int threads = 1,
                                               Engine engine = Engine::automatic) {
  RenderOptions options;
  options.threads = threads;
  options.engine = engine;
  return render(world, options);
}

/// Every n-th pixel each way, shaded by the program, with photons that `travel` advances.
/// @param travel  called as `travel(photons, arrivals)`
template <class Travel>
[[nodiscard]] std::vector<Rgb> take_pixels(const World& world, int every, const Travel& travel) {
  WaveRoom room;
  room.wave = camera_photons(world, every);
  std::vector<Rgb> film(room.wave.size());
  Tally tally;
  carry_light(world.space, world.appearance, room, film, travel, tally);
  return film;
}

}  // namespace portalens::benchmarks
