/// \file
/// A picture under way: the framebuffer, and the account of what stands on it. Whoever looks at it
/// sees pixels that are complete, while others still are being taken.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "core/image.h"
#include "render/assignment.h"
#include "render/camera_photon.h"
#include "render/sample_sum.h"
#include "render/tally.h"

namespace portalens {

/// What has reached each pixel of a window. Different pixels may be set by different threads; only
/// one that was set may be read.
class Framebuffer {
 public:
  explicit Framebuffer(const Assignment& assignment);

  /// The pixel's samples, all those of the range.
  /// @pre (x, y) lies in the window
  void set(int x, int y, const SampleSum& sum);
  /// The only sample of each of so many pixels of a row, one after the other.
  /// @pre all of them lie in the window
  void set(int x, int y, std::span<const Rgb> samples);
  /// The same from the sums as `sums` gave them, and the mean as the picture has it.
  void restore(int x, int y, std::span<const float> mean, std::span<const Rgb> sums);
  [[nodiscard]] std::span<float> layers(int x, int y);

  /// Linear radiance; the mean of the pixel's samples.
  [[nodiscard]] const Image& image() const { return image_; }
  [[nodiscard]] std::span<const float> mean(int x, int y) const { return means(x, y, 1); }
  /// Those of so many pixels of a row, one after the other.
  [[nodiscard]] std::span<const float> means(int x, int y, std::size_t pixels) const;
  /// What `SampleSum::nodes` gave; empty where whole pixels are taken, which nobody adds to.
  [[nodiscard]] std::span<const Rgb> sums(int x, int y) const;
  [[nodiscard]] std::span<const float> layers(int x, int y) const;

 private:
  void set_sums(int x, int y, std::span<const Rgb> sums);
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - window_.y0) * static_cast<std::size_t>(window_.width()) +
           static_cast<std::size_t>(x - window_.x0);
  }

  Window window_;
  double samples_;
  Image image_;
  std::size_t nodes_, channels_;
  std::vector<Rgb> sums_;
  std::vector<float> layers_;
};

/// How far a tile is. The work on it is counted first in camera samples, pixel by pixel, and then
/// in the pixels whose layers are taken.
struct TileProgress {
  std::uint64_t done = 0;
  std::vector<Rgb> sums;  ///< of the pixel that was begun, if one was: `SampleSum::nodes`
};

/// What stands of a picture, and what it took.
struct Account {
  std::vector<bool> complete;                 ///< of each tile
  std::size_t pixels = 0;                     ///< of the complete tiles
  std::map<std::size_t, TileProgress> begun;  ///< tiles of which something stands, but not all
  Tally tally;
  /// The first sample of which a photon was lost, of each of the first few such pixels.
  std::vector<PixelSample> lost;
  double seconds = 0.0;  ///< of wall time
};

/// How many pixels with lost photons are remembered.
inline constexpr std::size_t max_lost = 8;

/// Sorts the samples, and leaves the first of each of the first few pixels.
void keep_first(std::vector<PixelSample>& samples);

/// What there is to do for a tile.
struct TileWork {
  Window tile;
  std::uint64_t samples_each;  ///< camera samples a pixel
  std::uint64_t samples;       ///< camera samples
  std::uint64_t layers;        ///< pixels whose layers are taken

  TileWork(const Assignment& assignment, const Window& its_tile);
  [[nodiscard]] std::uint64_t total() const { return samples + layers; }
  /// How many pixels' light is complete when so much is done.
  [[nodiscard]] std::uint64_t lit(std::uint64_t done) const;
  /// How many pixels' layers are.
  [[nodiscard]] std::uint64_t layered(std::uint64_t done) const {
    return done > samples ? done - samples : 0;
  }
  /// The samples of the pixel that was begun.
  [[nodiscard]] SampleRange begun(std::uint64_t done, const SampleRange& range) const;
  /// The place of a pixel of that number.
  [[nodiscard]] std::pair<int, int> pixel(std::uint64_t number) const;
};

/// An account in brief.
struct Standing {
  std::size_t pixels = 0;  ///< of the complete tiles
  Tally tally;
};

class Exposure {
 public:
  /// Of which nothing stands yet.
  explicit Exposure(Assignment assignment);
  /// That goes on from what stands.
  Exposure(Assignment assignment, Account account, Framebuffer framebuffer);

  [[nodiscard]] const Assignment& assignment() const { return assignment_; }
  [[nodiscard]] const Tiling& tiles() const { return tiles_; }
  [[nodiscard]] TileWork work_on(std::size_t tile) const { return {assignment_, tiles_[tile]}; }

  /// A copy, with the time until now. What it says is done may be read from the framebuffer from
  /// then on.
  [[nodiscard]] Account account() const;
  [[nodiscard]] const Framebuffer& framebuffer() const { return framebuffer_; }
  /// Whether nothing is left to do.
  [[nodiscard]] bool complete() const;
  /// How much of the work is done, from 0 to 1.
  [[nodiscard]] double share_done() const;

  /// For whoever takes a tile: the only one at that time.
  [[nodiscard]] Framebuffer& framebuffer() { return framebuffer_; }
  [[nodiscard]] TileProgress progress(std::size_t tile) const;
  /// Notes how far a tile is now, and what that took since the last time.
  /// @return what stands then
  Standing note(std::size_t tile, TileProgress progress, const Tally& tally,
                const std::vector<PixelSample>& lost);

 private:
  using Clock = std::chrono::steady_clock;

  Assignment assignment_;
  Tiling tiles_;
  Framebuffer framebuffer_;
  mutable std::mutex guard_;
  Account account_;
  Clock::time_point start_ = Clock::now();
};

/// Calls `visit(x, y)` for each pixel of a tile whose number is below `count`.
template <class Visit>
void for_first_pixels(const TileWork& work, std::uint64_t count, const Visit& visit) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto [x, y] = work.pixel(i);
    visit(x, y);
  }
}

}  // namespace portalens
