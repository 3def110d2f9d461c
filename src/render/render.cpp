#include "render/render.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <span>
#include <utility>

#include "photon/beam.h"
#include "render/batch_size.h"
#include "render/parallel.h"
#include "render/sampling_grid.h"
#include "render/wave.h"

namespace portalens {
namespace {

/// Camera photons that travel together at most: many lanes full, and few enough that they stay in
/// the processor's caches until they are shaded.
constexpr std::uint64_t max_in_wave = 1024;
/// Pixels whose layers are taken at once at most.
constexpr std::uint64_t max_layer_pixels = 4096;

/// Scratch memory for rendering one tile.
struct TileRoom {
  WaveRoom carried;
  std::optional<SamplingGrid>
      sampling_grid;              ///< of the tile that is taken; only where there is a guard
  std::vector<FilmPlace> places;  ///< of the camera photons
  std::vector<Photon> photons;    ///< these, and what is left of those of earlier batches
  std::vector<Rgb> light;
  std::vector<std::uint32_t> lost;
  std::vector<PixelSample> lost_places;
};

/// A pool of scratch memory: as many rooms as were ever in use at once. The next user of one finds
/// what the last left in it, and clears it.
class TileRooms {
 public:
  [[nodiscard]] std::unique_ptr<TileRoom> take() {
    const std::lock_guard lock(guard_);
    if (free_.empty()) return std::make_unique<TileRoom>();
    std::unique_ptr<TileRoom> room = std::move(free_.back());
    free_.pop_back();
    return room;
  }
  void give_back(std::unique_ptr<TileRoom> room) {
    const std::lock_guard lock(guard_);
    free_.push_back(std::move(room));
  }

 private:
  std::mutex guard_;
  std::vector<std::unique_ptr<TileRoom>> free_;
};

/// What the threads share.
struct Shared {
  const World& world;
  Exposure& exposure;
  Engine engine;
  std::optional<BeamGuard> guard;  ///< none: every photon goes its own way
  Progress* progress;
  std::mutex telling{};  ///< held while progress is told: whoever listens may take its time
  BatchSize photons{512, max_in_wave}, layer_pixels{16, max_layer_pixels};
  TileRooms rooms{};
};

/// Takes one tile, or what is left of it. Its camera samples are numbered pixel by pixel, and
/// travel in batches that may begin and end within a pixel; after each batch it is noted what
/// stands.
class TileTaker {
 public:
  TileTaker(Shared& shared, std::size_t tile)
      : shared_(shared),
        world_(shared.world),
        assignment_(shared.exposure.assignment()),
        tile_(tile),
        work_(shared.exposure.work_on(tile)),
        room_(shared.rooms.take()) {
    TileProgress progress = shared.exposure.progress(tile);
    done_ = progress.done;
    sum_ = SampleSum(work_.begun(done_, assignment_.range), progress.sums);
    if (!shared.guard) return;
    if (room_->sampling_grid)
      room_->sampling_grid->lay_over(work_.tile);
    else
      room_->sampling_grid.emplace(world_, *shared.guard, work_.tile);
  }
  TileTaker(const TileTaker&) = delete;
  TileTaker& operator=(const TileTaker&) = delete;
  ~TileTaker() { shared_.rooms.give_back(std::move(room_)); }

  /// Until the tile is complete, or `stop()` says so.
  template <class Stop>
  void take(const Stop& stop) {
    while (done_ < work_.total() && !stop()) {
      Stopwatch watch;
      if (done_ < work_.samples) {
        const std::uint64_t count = std::min(shared_.photons.size(), work_.samples - done_);
        take_samples(count);
        shared_.photons.took(count, watch.lap());
      } else {
        const std::uint64_t count = std::min(shared_.layer_pixels.size(), work_.total() - done_);
        take_layer_pixels(count);
        shared_.layer_pixels.took(count, watch.lap());
      }
    }
  }

 private:
  void take_samples(std::uint64_t count) {
    Tally tally;
    room_->light.assign(count, Rgb{});
    room_->lost.clear();
    room_->lost_places.clear();
    send_camera_photons(count);
    bool from_camera = true;
    const auto advance_wave = [&](std::span<const Photon> photons, std::span<Arrival> arrivals) {
      if (std::exchange(from_camera, false) && room_->sampling_grid)
        room_->sampling_grid->advance(room_->places, arrivals, tally);
      else
        advance(world_.space, photons, arrivals, shared_.engine);
    };
    carry_light(world_.space, world_.appearance, std::span(room_->photons).first(count),
                room_->carried, room_->light, advance_wave, tally, &room_->lost);
    for (const std::uint32_t i : room_->lost) room_->lost_places.push_back(place(done_ + i));
    keep_first(room_->lost_places);
    expose_samples();
    note(count, tally);
  }

  /// Puts what has reached the samples from `done_` on where it belongs.
  void expose_samples() {
    if (assignment_.samples == 1) return expose_pixels();
    Framebuffer& framebuffer = shared_.exposure.framebuffer();
    PixelSample at = place(done_);
    for (const Rgb& light : room_->light) {
      sum_.add(light);
      if (at.sample + 1 == assignment_.range.end) {
        framebuffer.set(at.x, at.y, sum_);
        sum_.restart(assignment_.range.begin);
      }
      go_on(at);
    }
  }

  /// The same, where each sample is a pixel: row by row.
  void expose_pixels() {
    std::span<const Rgb> light = room_->light;
    for (std::uint64_t at = done_; !light.empty();) {
      const auto [x, y] = work_.pixel(at);
      const std::size_t count = std::min(light.size(), static_cast<std::size_t>(work_.tile.x1 - x));
      shared_.exposure.framebuffer().set(x, y, light.first(count));
      light = light.subspan(count);
      at += count;
    }
  }

  void take_layer_pixels(std::uint64_t count) {
    const std::uint64_t first = work_.layered(done_);
    for (std::uint64_t i = first; i < first + count; ++i) {
      const auto [x, y] = work_.pixel(i);
      take_layers(world_, x, y, assignment_.layers, shared_.exposure.framebuffer().layers(x, y));
    }
    room_->lost_places.clear();
    note(count, {});
  }

  void note(std::uint64_t count, const Tally& tally) {
    done_ += count;
    TileProgress progress{done_, {}};
    if (!work_.begun(done_, assignment_.range).empty())
      progress.sums.assign(sum_.nodes().begin(), sum_.nodes().end());
    const bool told = shared_.progress && done_ == work_.total();
    std::unique_lock<std::mutex> lock;
    if (told) lock = std::unique_lock(shared_.telling);
    const Standing standing =
        shared_.exposure.note(tile_, std::move(progress), tally, room_->lost_places);
    if (!told) return;
    shared_.progress->tile_taken(work_.tile, shared_.exposure.framebuffer().image(),
                                 assignment_.window);
    shared_.progress->advanced(standing.pixels, assignment_.window.pixels(), standing.tally);
  }

  /// The camera sample of that number.
  [[nodiscard]] PixelSample place(std::uint64_t number) const {
    const auto [x, y] = work_.pixel(number / work_.samples_each);
    return {x, y,
            assignment_.range.begin + static_cast<std::uint32_t>(number % work_.samples_each)};
  }

  /// To the camera sample with the next number.
  void go_on(PixelSample& at) const {
    if (++at.sample != assignment_.range.end) return;
    at.sample = assignment_.range.begin;
    if (++at.x != work_.tile.x1) return;
    at.x = work_.tile.x0;
    ++at.y;
  }

  void send_camera_photons(std::uint64_t count) {
    std::vector<Photon>& photons = room_->photons;
    std::vector<FilmPlace>& places = room_->places;
    // In any batch they differ in nothing but ray and random numbers.
    while (photons.size() < count) {
      const auto number = static_cast<std::uint32_t>(photons.size());
      photons.emplace_back().sample = number;
      photons.back().slot = number;
    }
    places.resize(count);
    const PhotonSource source(world_);
    const bool random = uses_random_numbers(world_.appearance);
    PixelSample at = place(done_);
    for (std::uint64_t i = 0; i < count; ++i, go_on(at)) {
      places[i] = source.place(at);
      if (!random) continue;
      photons[i].random_key = source.random_key(at);
      photons[i].pixel_sample = at.sample;
    }
    if (room_->sampling_grid) return;  // it sends few
    source.send(places, std::span(photons).first(count));
  }

  Shared& shared_;
  const World& world_;
  const Assignment& assignment_;
  std::size_t tile_;
  TileWork work_;
  std::uint64_t done_ = 0;
  SampleSum sum_;
  std::unique_ptr<TileRoom> room_;
};

/// Empty channels of that many pixels for the layers.
std::vector<Channel> empty_channels(const std::vector<Layer>& layers, std::size_t pixels) {
  std::vector<Channel> channels;
  for (const Layer layer : layers)
    for (std::string& name : channel_names(layer))
      channels.push_back({std::move(name), std::vector<float>(pixels)});
  return channels;
}

/// Copies what is done of a tile.
void copy_tile(const Exposure& exposure, std::size_t tile, std::uint64_t done,
               RenderResult& result) {
  const TileWork work = exposure.work_on(tile);
  const Window& window = result.window;
  const Framebuffer& framebuffer = exposure.framebuffer();
  const std::uint64_t lit = work.lit(done);
  const auto width = static_cast<std::uint64_t>(work.tile.width());
  for (std::uint64_t first = 0; first < lit; first += width) {
    const auto [x, y] = work.pixel(first);
    const auto row = framebuffer.means(x, y, std::min(width, lit - first));
    std::copy(row.begin(), row.end(), result.image.at(x - window.x0, y - window.y0));
  }
  for_first_pixels(work, work.layered(done), [&](int x, int y) {
    const std::size_t at =
        static_cast<std::size_t>(y - window.y0) * static_cast<std::size_t>(window.width()) +
        static_cast<std::size_t>(x - window.x0);
    const auto values = framebuffer.layers(x, y);
    for (std::size_t c = 0; c < values.size(); ++c) result.layers[c].values[at] = values[c];
  });
}

}  // namespace

int tile_size_of(const World& world, const RenderOptions& options) {
  if (options.tile_size) return *options.tile_size;
  constexpr int small = 32, large = 64;
  // A sampling grid reaches beyond its tile: of small ones more probe rays are sent twice. Where
  // samples are many, probe rays are few beside them.
  constexpr std::int64_t few_samples = 4;
  return interpolates(world, options) && world.sampling.samples <= few_samples ? large : small;
}

Assignment assignment_of(const World& world, const RenderOptions& options) {
  const Window film{0, 0, world.film.width, world.film.height};
  const auto samples = static_cast<std::uint32_t>(world.sampling.samples);
  return {film,           options.crop.value_or(film),
          samples,        options.samples.value_or(SampleRange{0, samples}),
          options.layers, tile_size_of(world, options)};
}

bool interpolates(const World& world, const RenderOptions& options) {
  return options.photons == Photons::fewer && takes_lanes(world.space, options.engine) &&
         BeamGuard::can_guard(world.space);
}

void expose(const World& world, Exposure& exposure, const RenderOptions& options,
            Progress* progress, const Cancellation* cancellation) {
  Shared shared{world, exposure, options.engine,
                interpolates(world, options) ? BeamGuard::over(world.space) : std::nullopt,
                progress};
  std::vector<std::size_t> left;
  const Account account = exposure.account();
  for (std::size_t i = 0; i < account.complete.size(); ++i)
    if (!account.complete[i]) left.push_back(i);
  const auto stop = [&] { return cancellation && cancellation->requested(); };
  parallel_for(
      left.size(), options.threads > 0 ? options.threads : available_threads(),
      [&](std::size_t i) { TileTaker(shared, left[i]).take(stop); }, stop);
}

RenderResult result_of(const Exposure& exposure) {
  const Account account = exposure.account();
  const Assignment& assignment = exposure.assignment();
  RenderResult result;
  result.window = assignment.window;
  result.samples = assignment.range;
  result.image = Image(result.window.width(), result.window.height(), 3);
  if (assignment.takes_layers())
    result.layers = empty_channels(assignment.layers, result.window.pixels());
  for (std::size_t i = 0; i < account.complete.size(); ++i)
    if (account.complete[i]) copy_tile(exposure, i, exposure.work_on(i).total(), result);
  for (const auto& [tile, progress] : account.begun)
    copy_tile(exposure, tile, progress.done, result);
  result.tally = account.tally;
  result.lost = account.lost;
  result.seconds = account.seconds;
  const bool all = account.pixels == assignment.window.pixels();
  result.completion = all ? Completion::complete : Completion::cancelled;
  return result;
}

RenderResult render(const World& world, const RenderOptions& options, Progress* progress,
                    const Cancellation* cancellation) {
  Exposure exposure(assignment_of(world, options));
  expose(world, exposure, options, progress, cancellation);
  return result_of(exposure);
}

}  // namespace portalens
