// Builds without libraries of pictures (PORTALENS_PORTABLE) read no pictures, and say so.
#include "io/image.h"

namespace portalens {
namespace {

void refuse(const std::filesystem::path& file, const Location& asked_at, Faults& faults) {
  faults.add(asked_at,
             "the picture " + file.filename().string() +
                 " can't be read: this portalens was built without libraries of pictures",
             "give a color or a checker, or use a build with them (PORTALENS_PORTABLE=OFF)");
}

}  // namespace

std::optional<Image> read_image(const std::filesystem::path& file, const Location& asked_at,
                                Faults& faults, Digests* /*digests*/) {
  refuse(file, asked_at, faults);
  return std::nullopt;
}

std::optional<ChannelPicture> read_channels(const std::filesystem::path& file,
                                            const Location& asked_at, Faults& faults) {
  refuse(file, asked_at, faults);
  return std::nullopt;
}

}  // namespace portalens
