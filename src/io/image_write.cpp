// Pictures out, encoded in memory; the bytes are written by replace_file, because libraries report
// a full disk as success.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <string_view>
#include <vector>

#include "io/files.h"
#include "io/image.h"
#include "io/image_encode.h"

namespace portalens {
namespace {

namespace fs = std::filesystem;

enum class Target { exr, png, jpeg };

Target target_of(const fs::path& file) {
  if (file == standard_stream) return Target::png;
  std::string suffix = file.extension().string();
  for (char& letter : suffix) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  if (suffix == ".exr") return Target::exr;
  if (suffix == ".png") return Target::png;
  if (suffix == ".jpg" || suffix == ".jpeg") {
    if (encodes_jpeg()) return Target::jpeg;
    refuse("can't write " + file.string() + ": this build writes no JPEG",
           "name a .png file, or take a build with libjpeg-turbo");
  }
  refuse("can't write " + file.string() + ": its kind is not known",
         "a picture's name ends in .exr, .png or .jpg");
}

void check_values(const EncodedPicture& picture) {
  const std::size_t count = picture.row() * static_cast<std::size_t>(picture.height);
  for (const ChannelView& channel : picture.channels) {
    if (picture.width < 1 || picture.height < 1 ||
        (channel.values.size() + channel.step - 1) / channel.step != count) {
      throw WorkError("can't write " + picture.file.string() + ": channel " + channel.name +
                      " is not of the picture's size");
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (std::isfinite(channel.values[i * channel.step])) continue;
      throw WorkError("can't write " + picture.file.string() + ": channel " + channel.name +
                      " is not finite at pixel (" + std::to_string(i % picture.row()) + ", " +
                      std::to_string(i / picture.row()) + ")");
    }
  }
}

}  // namespace

std::array<const ChannelView*, 3> colors_of(const EncodedPicture& picture) {
  std::array<const ChannelView*, 3> colors{};
  for (std::size_t c = 0; c < 3; ++c) {
    constexpr std::string_view names[] = {"R", "G", "B"};
    const auto channel = std::find_if(picture.channels.begin(), picture.channels.end(),
                                      [&](const ChannelView& one) { return one.name == names[c]; });
    if (channel == picture.channels.end()) {
      throw WorkError("can't write " + picture.file.string() + ": there is no channel " +
                      std::string(names[c]));
    }
    colors[c] = &*channel;
  }
  return colors;
}

void write_image(const fs::path& file, int width, int height, const std::vector<Channel>& channels,
                 const Metadata& metadata) {
  std::vector<ChannelView> views;
  for (const Channel& channel : channels) views.push_back({channel.name, channel.values});
  write_views(file, width, height, views, metadata, Packing::small);
}

void write_views(const fs::path& file, int width, int height,
                 const std::vector<ChannelView>& channels, const Metadata& metadata,
                 Packing packing) {
  const Target target = target_of(file);
  if (channels.empty()) throw WorkError("can't write " + file.string() + ": no channels");
  const EncodedPicture picture{file, width, height, channels, metadata, packing};
  check_values(picture);
  std::vector<unsigned char> bytes;
  try {
    bytes = target == Target::exr   ? encode_exr(picture)
            : target == Target::png ? encode_png(picture)
                                    : encode_jpeg(picture);
  } catch (const WorkError&) {
    throw;
  } catch (const std::exception& error) {
    throw WorkError("can't encode " + file.string() + ": " + error.what());
  }
  replace_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

bool keeps_light(const fs::path& file) { return target_of(file) == Target::exr; }

void check_writable(const fs::path& file) {
  target_of(file);
  check_replaceable(file);
}

}  // namespace portalens
