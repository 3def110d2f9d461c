#include "render/render.h"

#include <chrono>
#include <mutex>
#include <utility>

#include "render/parallel.h"
#include "render/sampler.h"
#include "render/wave.h"

namespace portalens {
namespace {

/// Camera photons that travel together at most.
constexpr std::uint64_t most_in_wave = 8192;

/// Takes one tile. Its camera samples are numbered pixel by pixel, and travel in batches that may
/// begin and end within a pixel.
class TileWork {
 public:
  TileWork(const World& world, const Window& tile, Engine engine, Exposure& film)
      : world_(world), tile_(tile), engine_(engine), film_(film) {}

  Tally take() {
    const auto per_pixel = static_cast<std::uint64_t>(world_.sampling.samples);
    const std::uint64_t total = tile_.pixels() * per_pixel;
    Rgb sum;
    for (std::uint64_t begin = 0; begin < total; begin += most_in_wave) {
      const std::uint64_t count = std::min(most_in_wave, total - begin);
      light_.assign(count, Rgb{});
      carry_light(world_.space, world_.appearance, camera_photons(begin, count), light_, engine_,
                  tally_);
      for (std::uint64_t i = 0; i < count; ++i) {
        sum += checked(light_[i]);
        if ((begin + i + 1) % per_pixel != 0) continue;
        const auto [x, y] = pixel((begin + i) / per_pixel);
        film_.set(x, y, sum / static_cast<double>(per_pixel));
        sum = Rgb{};
      }
    }
    return tally_;
  }

 private:
  [[nodiscard]] std::pair<int, int> pixel(std::uint64_t index) const {
    const auto width = static_cast<std::uint64_t>(tile_.width());
    return {tile_.x0 + static_cast<int>(index % width), tile_.y0 + static_cast<int>(index / width)};
  }

  [[nodiscard]] std::vector<Photon> camera_photons(std::uint64_t begin, std::uint64_t count) const {
    const auto per_pixel = static_cast<std::uint64_t>(world_.sampling.samples);
    std::vector<Photon> photons(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto [x, y] = pixel((begin + i) / per_pixel);
      const auto sample = static_cast<std::uint32_t>((begin + i) % per_pixel);
      const PixelSampler sampler(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                 static_cast<std::uint64_t>(world_.sampling.seed));
      const auto [u, v] =
          per_pixel == 1 ? std::array<double, 2>{0.5, 0.5} : sampler.position(sample);
      const Ray ray = world_.camera.ray(x + u, y + v, world_.film.width, world_.film.height);
      Photon& photon = photons[i];
      photon.position = ray.origin;
      photon.direction = ray.direction;
      photon.sample = photon.slot = static_cast<std::uint32_t>(i);
      photon.random_key = sampler.random_key(sample);
    }
    return photons;
  }

  /// Light that is not a number would spoil its pixel unseen: it is counted, and shown as lost.
  [[nodiscard]] Rgb checked(Rgb light) {
    if (is_finite(light)) return light;
    ++tally_.not_finite;
    return world_.appearance.limits.lost_color;
  }

  const World& world_;
  Window tile_;
  Engine engine_;
  Exposure& film_;
  std::vector<Rgb> light_;
  Tally tally_;
};

}  // namespace

RenderResult render(const World& world, const RenderOptions& options, Progress* progress,
                    const Cancellation* cancellation) {
  const auto start = std::chrono::steady_clock::now();
  RenderResult result;
  result.window = options.crop.value_or(Window{0, 0, world.film.width, world.film.height});
  Exposure film(result.window);
  const Tiling tiles(result.window, options.tile_size);
  const int threads = options.threads > 0 ? options.threads : available_threads();

  std::mutex guard;
  std::size_t done = 0;
  const auto work = [&](std::size_t i) {
    const Window tile = tiles[i];
    const Tally tally = TileWork(world, tile, options.engine, film).take();
    const std::lock_guard lock(guard);
    result.tally += tally;
    done += tile.pixels();
    if (progress) progress->advanced(done, result.window.pixels(), result.tally);
  };
  const auto stop = [&] { return cancellation && cancellation->requested(); };
  const bool all = parallel_for(tiles.count(), threads, work, stop);

  result.image = std::move(film).release();
  result.completion = all ? Completion::complete : Completion::cancelled;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace portalens
