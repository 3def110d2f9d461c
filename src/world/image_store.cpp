#include "world/image_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "core/words.h"
#include "io/image.h"

namespace portalens {
namespace {

constexpr std::size_t budget = std::size_t{2} << 30;

/// Makes negative values 0.
/// @return what to tell of it; nothing if there were none
std::optional<std::string> without_negatives(Image& image, const std::string& name) {
  std::size_t count = 0, lowest = 0;
  float least = 0.0F;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    float& value = image.pixels[i];
    if (value >= 0.0F) continue;
    if (value < least) lowest = i;
    least = std::min(least, value);
    ++count;
    value = 0.0F;
  }
  if (count == 0) return std::nullopt;
  const std::size_t pixel = lowest / 3, width = static_cast<std::size_t>(image.width);
  return fmt::format(
      "the image {} has {} negative {}, taken for 0: the least is {:.4g}, at pixel ({}, {})",
      in_quotes(name), count, count == 1 ? "value" : "values", least, pixel % width, pixel / width);
}

}  // namespace

ImageLoader ImageStore::loader(const std::filesystem::path& file) {
  return [this, file](const std::string& name, const Location& asked_at) {
    return load(file, name, asked_at);
  };
}

std::shared_ptr<const Image> ImageStore::load(const std::filesystem::path& file,
                                              const std::string& name, const Location& asked_at) {
  const auto path = resolve_file(file, name, containment_, asked_at, *faults_);
  if (!path) return nullptr;
  const auto [place, is_new] = images_.emplace(*path, nullptr);
  if (!is_new) return place->second;
  std::optional<Image> image;
  if (bytes_ <= budget) {
    image = read_image(*path, asked_at, *faults_, digests_);
    if (!image) return nullptr;
    bytes_ += image->pixels.size() * sizeof(float);
    if (auto warning = without_negatives(*image, name)) warnings_.push_back(std::move(*warning));
  }
  if (bytes_ > budget) {
    faults_->add(asked_at, "no memory is left for the image " + in_quotes(name),
                 "use smaller images: together at most 2 GiB, 12 bytes a pixel");
    return nullptr;
  }
  place->second = std::make_shared<const Image>(std::move(*image));
  return place->second;
}

}  // namespace portalens
