#include "render/render.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

#include "render/camera_photon.h"
#include "render/parallel.h"
#include "render/wave.h"

namespace portalens {
namespace {

/// Camera photons that travel together at most.
constexpr std::uint64_t most_in_wave = 8192;

/// Sorts the samples, and leaves the first of each of the first few pixels.
void keep_first(std::vector<PixelSample>& samples) {
  std::sort(samples.begin(), samples.end());
  const auto same_pixel = [](const PixelSample& a, const PixelSample& b) {
    return a.x == b.x && a.y == b.y;
  };
  samples.erase(std::unique(samples.begin(), samples.end(), same_pixel), samples.end());
  if (samples.size() > most_lost) samples.resize(most_lost);
}

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
      lost_here_.clear();
      carry_light(world_.space, world_.appearance, camera_photons(begin, count), light_, engine_,
                  tally_, &lost_here_);
      for (const std::uint32_t i : lost_here_) lost_.push_back(place(begin + i));
      keep_first(lost_);
      for (std::uint64_t i = 0; i < count; ++i) {
        sum += light_[i];
        if ((begin + i + 1) % per_pixel != 0) continue;
        const auto [x, y] = pixel((begin + i) / per_pixel);
        film_.set(x, y, sum / static_cast<double>(per_pixel));
        sum = Rgb{};
      }
    }
    return tally_;
  }

  [[nodiscard]] const std::vector<PixelSample>& lost() const { return lost_; }

 private:
  [[nodiscard]] std::pair<int, int> pixel(std::uint64_t index) const {
    const auto width = static_cast<std::uint64_t>(tile_.width());
    return {tile_.x0 + static_cast<int>(index % width), tile_.y0 + static_cast<int>(index / width)};
  }

  /// The camera sample of that number.
  [[nodiscard]] PixelSample place(std::uint64_t index) const {
    const auto per_pixel = static_cast<std::uint64_t>(world_.sampling.samples);
    const auto [x, y] = pixel(index / per_pixel);
    return {x, y, static_cast<std::uint32_t>(index % per_pixel)};
  }

  [[nodiscard]] std::vector<Photon> camera_photons(std::uint64_t begin, std::uint64_t count) const {
    std::vector<Photon> photons(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      photons[i] = camera_photon(world_, place(begin + i));
      photons[i].sample = photons[i].slot = static_cast<std::uint32_t>(i);
    }
    return photons;
  }

  const World& world_;
  Window tile_;
  Engine engine_;
  Exposure& film_;
  std::vector<Rgb> light_;
  std::vector<std::uint32_t> lost_here_;
  std::vector<PixelSample> lost_;
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
    TileWork taking(world, tile, options.engine, film);
    const Tally tally = taking.take();
    const std::lock_guard lock(guard);
    result.tally += tally;
    result.lost.insert(result.lost.end(), taking.lost().begin(), taking.lost().end());
    keep_first(result.lost);
    done += tile.pixels();
    if (!progress) return;
    progress->tile_taken(tile, film.image(), result.window);
    progress->advanced(done, result.window.pixels(), result.tally);
  };
  const auto stop = [&] { return cancellation && cancellation->requested(); };
  const bool all = parallel_for(tiles.count(), threads, work, stop);

  result.image = std::move(film).release();
  result.completion = all ? Completion::complete : Completion::cancelled;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace portalens
