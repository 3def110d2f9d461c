#include "world/image_store.h"

#include <optional>
#include <string>
#include <utility>

#include "core/words.h"
#include "io/image.h"

namespace portalens {
namespace {

constexpr std::size_t budget = std::size_t{2} << 30;

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
