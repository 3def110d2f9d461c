#include "render/exposure.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace portalens {
namespace {

/// What is too bright for a float is as bright as one can be.
float as_float(double value) {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::max(std::min(value, most), -most));
}

}  // namespace

Framebuffer::Framebuffer(const Assignment& assignment)
    : window_(assignment.window),
      samples_(assignment.range.count()),
      image_(window_.width(), window_.height(), 3),
      nodes_(assignment.whole_pixels() ? 0 : SampleSum::node_count(assignment.range)),
      channels_(assignment.takes_layers() ? channel_count(assignment.layers) : 0),
      sums_(nodes_ * window_.pixels()),
      layers_(channels_ * window_.pixels()) {}

void Framebuffer::set(int x, int y, const SampleSum& sum) {
  const Rgb mean = sum.total() / samples_;
  set(x, y, std::span(&mean, 1));
  if (nodes_ > 0) set_sums(x, y, sum.nodes());
}

void Framebuffer::set(int x, int y, std::span<const Rgb> samples) {
  float* pixel = image_.at(x - window_.x0, y - window_.y0);
  for (const Rgb& sample : samples) {
    pixel[0] = as_float(sample.x), pixel[1] = as_float(sample.y), pixel[2] = as_float(sample.z);
    pixel += 3;
  }
}

void Framebuffer::restore(int x, int y, std::span<const float> mean, std::span<const Rgb> sums) {
  std::copy(mean.begin(), mean.end(), image_.at(x - window_.x0, y - window_.y0));
  set_sums(x, y, sums);
}

void Framebuffer::set_sums(int x, int y, std::span<const Rgb> sums) {
  std::copy(sums.begin(), sums.end(),
            sums_.begin() + static_cast<std::ptrdiff_t>(nodes_ * index(x, y)));
}

std::span<const float> Framebuffer::means(int x, int y, std::size_t pixels) const {
  return {image_.at(x - window_.x0, y - window_.y0), 3 * pixels};
}

std::span<const Rgb> Framebuffer::sums(int x, int y) const {
  return {sums_.data() + nodes_ * index(x, y), nodes_};
}

std::span<float> Framebuffer::layers(int x, int y) {
  return {layers_.data() + channels_ * index(x, y), channels_};
}

std::span<const float> Framebuffer::layers(int x, int y) const {
  return {layers_.data() + channels_ * index(x, y), channels_};
}

void keep_first(std::vector<PixelSample>& samples) {
  std::sort(samples.begin(), samples.end());
  const auto same_pixel = [](const PixelSample& a, const PixelSample& b) {
    return a.x == b.x && a.y == b.y;
  };
  samples.erase(std::unique(samples.begin(), samples.end(), same_pixel), samples.end());
  if (samples.size() > max_lost) samples.resize(max_lost);
}

TileWork::TileWork(const Assignment& assignment, const Window& its_tile)
    : tile(its_tile),
      samples_each(assignment.range.count()),
      samples(samples_each * tile.pixels()),
      layers(assignment.takes_layers() ? tile.pixels() : 0) {}

std::uint64_t TileWork::lit(std::uint64_t done) const {
  return std::min(done, samples) / samples_each;
}

SampleRange TileWork::begun(std::uint64_t done, const SampleRange& range) const {
  const auto taken = static_cast<std::uint32_t>(std::min(done, samples) % samples_each);
  return {range.begin, range.begin + taken};
}

std::pair<int, int> TileWork::pixel(std::uint64_t number) const {
  const auto width = static_cast<std::uint64_t>(tile.width());
  return {tile.x0 + static_cast<int>(number % width), tile.y0 + static_cast<int>(number / width)};
}

Exposure::Exposure(Assignment assignment)
    : assignment_(std::move(assignment)),
      tiles_(assignment_.window, assignment_.tile_size),
      framebuffer_(assignment_) {
  account_.complete.resize(tiles_.count());
}

Exposure::Exposure(Assignment assignment, Account account, Framebuffer framebuffer)
    : assignment_(std::move(assignment)),
      tiles_(assignment_.window, assignment_.tile_size),
      framebuffer_(std::move(framebuffer)),
      account_(std::move(account)) {}

Account Exposure::account() const {
  const std::lock_guard lock(guard_);
  Account account = account_;
  account.seconds += std::chrono::duration<double>(Clock::now() - start_).count();
  return account;
}

bool Exposure::complete() const {
  const std::lock_guard lock(guard_);
  return account_.pixels == assignment_.window.pixels();
}

double Exposure::share_done() const {
  const Account account = this->account();
  double done = 0.0, total = 0.0;
  for (std::size_t i = 0; i < tiles_.count(); ++i) {
    const auto all = static_cast<double>(work_on(i).total());
    total += all;
    if (account.complete[i]) done += all;
  }
  for (const auto& [tile, progress] : account.begun) done += static_cast<double>(progress.done);
  return done / total;
}

TileProgress Exposure::progress(std::size_t tile) const {
  const std::lock_guard lock(guard_);
  const auto found = account_.begun.find(tile);
  return found == account_.begun.end() ? TileProgress{} : found->second;
}

Standing Exposure::note(std::size_t tile, TileProgress progress, const Tally& tally,
                        const std::vector<PixelSample>& lost) {
  const std::lock_guard lock(guard_);
  account_.tally += tally;
  account_.lost.insert(account_.lost.end(), lost.begin(), lost.end());
  keep_first(account_.lost);
  if (progress.done == work_on(tile).total()) {
    account_.complete[tile] = true;
    account_.pixels += tiles_[tile].pixels();
    account_.begun.erase(tile);
  } else {
    account_.begun[tile] = std::move(progress);
  }
  return {account_.pixels, account_.tally};
}

}  // namespace portalens
