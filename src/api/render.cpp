#include "portalens/render.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <string>
#include <utility>

#include "api/access.h"
#include "render/render.h"

namespace portalens::api {
namespace {

static_assert(static_cast<int>(Layer::position) + 1 == layer_count);
static_assert(static_cast<int>(Fate::lost) + 1 == fate_count);

Window outward(const portalens::Window& w) { return {w.x0, w.y0, w.x1, w.y1}; }

/// Tells the caller how far the picture is. What the caller throws is kept, and ends the render.
class Teller : public portalens::Progress, public Cancellation {
 public:
  explicit Teller(const RenderOptions& options) : options_(options) {}

  void tile_taken(const portalens::Window& tile, const Image& film,
                  const portalens::Window& window) override {
    tile_ = tile;
    film_ = &film;
    window_ = window;
  }
  void advanced(std::size_t done, std::size_t total, const Tally& tally) override {
    if (!options_.progress || failed_) return;
    try {
      options_.progress(
          {done, total, tally.photons, outward(window_), outward(tile_), film_->pixels});
    } catch (...) {
      failure_ = std::current_exception();
      failed_ = true;
    }
  }
  [[nodiscard]] bool requested() const override {
    return failed_ || (options_.cancelled && options_.cancelled());
  }
  /// @throws what the caller threw
  void raise() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const RenderOptions& options_;
  portalens::Window tile_, window_;
  const Image* film_ = nullptr;
  std::exception_ptr failure_;
  std::atomic<bool> failed_{false};
};

portalens::Window checked_crop(const Window& crop, const portalens::World& world) {
  const portalens::Window window{crop.x0, crop.y0, crop.x1, crop.y1};
  const portalens::Window film{0, 0, world.film.width, world.film.height};
  if (window.empty() || !film.holds(window))
    throw asked("the crop is no part of the picture",
                "0 <= x0 < x1 <= " + std::to_string(film.x1) +
                    " and 0 <= y0 < y1 <= " + std::to_string(film.y1) + " are needed");
  return window;
}

portalens::RenderOptions inward(const RenderOptions& options, const portalens::World& world) {
  check_threads(options.threads);
  portalens::RenderOptions result;
  result.threads = options.threads;
  result.engine =
      options.engine == Engine::scalar ? portalens::Engine::scalar : portalens::Engine::automatic;
  result.photons =
      options.photons == Photons::all ? portalens::Photons::all : portalens::Photons::fewer;
  if (options.crop) result.crop = checked_crop(*options.crop, world);
  for (const Layer layer : options.layers)
    result.layers.push_back(static_cast<portalens::Layer>(layer));
  std::sort(result.layers.begin(), result.layers.end());
  result.layers.erase(std::unique(result.layers.begin(), result.layers.end()), result.layers.end());
  return result;
}

Rendering outward(RenderResult result) {
  Rendering rendering;
  rendering.window = outward(result.window);
  rendering.picture.width = result.window.width();
  rendering.picture.height = result.window.height();
  rendering.picture.rgb = std::move(result.image.pixels);
  for (portalens::Channel& layer : result.layers)
    rendering.picture.layers.push_back({std::move(layer.name), std::move(layer.values)});
  rendering.complete = result.completion == Completion::complete;
  rendering.fates = result.tally.fates;
  rendering.photons = result.tally.photons;
  rendering.seconds = result.seconds;
  return rendering;
}

}  // namespace

Rendering render(const World& world, const RenderOptions& options) {
  Teller teller(options);
  Rendering rendering = guarded([&] {
    const portalens::World& scene = inside(world);
    return outward(portalens::render(scene, inward(options, scene), &teller, &teller));
  });
  teller.raise();
  return rendering;
}

std::vector<std::string> layer_objects(const World& world) { return object_names(inside(world)); }

}  // namespace portalens::api
