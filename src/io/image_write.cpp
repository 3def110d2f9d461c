// Pictures out, through OpenImageIO into memory; the bytes are written by replace_file, because the
// library reports a full disk as success.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <string_view>
#include <vector>

#include "io/files.h"
#include "io/image.h"
#include "io/srgb_bytes.h"

namespace portalens {
namespace {

namespace fs = std::filesystem;

enum class Target { exr, png };

Target target_of(const fs::path& file) {
  std::string suffix = file.extension().string();
  for (char& letter : suffix) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  if (suffix == ".exr") return Target::exr;
  if (suffix == ".png") return Target::png;
  throw SceneError({{Location{}, "can't write " + file.string() + ": its kind is not known",
                     "a picture's name ends in .exr or .png"}});
}

/// What there is to write.
struct Picture {
  const fs::path& file;
  int width, height;
  const std::vector<ChannelView>& channels;
  const Metadata& metadata;
  Packing packing;

  [[nodiscard]] std::size_t row() const { return static_cast<std::size_t>(width); }
};

void check_values(const Picture& picture) {
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

/// As `fill(y, values)` gives one row of it after the other, pixel by pixel.
template <class Value, class Fill>
std::vector<unsigned char> encode(const Picture& picture, const char* name,
                                  const OIIO::ImageSpec& spec, const Fill& fill) {
  constexpr std::size_t at_once = std::size_t{1} << 25;  // bytes; rows are packed by all threads
  const std::size_t row = picture.row() * static_cast<std::size_t>(spec.nchannels);
  const int rows = static_cast<int>(std::clamp<std::size_t>(
      at_once / (row * sizeof(Value)) / 64 * 64, 64, static_cast<std::size_t>(1) << 16));
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(name);
  const auto fail = [&](const std::string& why) {
    throw WorkError("can't encode " + picture.file.string() + ": " + why);
  };
  if (!output || !output->supports("ioproxy") || !output->set_ioproxy(&memory)) {
    fail("this build lacks the format");
  }
#ifdef PORTALENS_STD_THREADS
  // The thread sanitizer does not see into the libraries' own pools.
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  output->threads(1);
#endif
  if (!output->open(name, spec)) fail(output->geterror());
  std::vector<Value> values(row * static_cast<std::size_t>(std::min(rows, picture.height)));
  for (int begin = 0; begin < picture.height; begin += rows) {
    const int end = std::min(begin + rows, picture.height);
    for (int y = begin; y < end; ++y)
      fill(static_cast<std::size_t>(y), values.data() + static_cast<std::size_t>(y - begin) * row);
    if (!output->write_scanlines(begin, end, 0, spec.format, values.data()))
      fail(output->geterror());
  }
  if (!output->close()) fail(output->geterror());
  if (bytes.empty()) fail("nothing came of it");
  return bytes;
}

std::vector<unsigned char> encode_exr(const Picture& picture) {
  const std::vector<ChannelView>& channels = picture.channels;
  const std::size_t stride = channels.size();
  OIIO::ImageSpec spec(picture.width, picture.height, static_cast<int>(stride),
                       OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const ChannelView& channel : channels) spec.channelnames.push_back(channel.name);
  for (const auto& [key, value] : picture.metadata) spec.attribute(key, value);
  spec.attribute("compression", picture.packing == Packing::small ? "zip" : "rle");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("DateTime", "1970:01:01 00:00:00");  // else the time: not the same bits twice
  return encode<float>(picture, "picture.exr", spec, [&](std::size_t y, float* row) {
    for (std::size_t c = 0; c < stride; ++c)
      for (std::size_t x = 0; x < picture.row(); ++x)
        row[x * stride + c] = channels[c].values[(y * picture.row() + x) * channels[c].step];
  });
}

std::vector<unsigned char> encode_png(const Picture& picture) {
  static const SrgbBytes byte_of;
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
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (picture.packing == Packing::quick) spec.attribute("png:compressionLevel", 1);
  return encode<unsigned char>(
      picture, "picture.png", spec, [&](std::size_t y, unsigned char* row) {
        for (std::size_t x = 0; x < picture.row(); ++x)
          for (std::size_t c = 0; c < 3; ++c)
            row[3 * x + c] = byte_of(colors[c]->values[(y * picture.row() + x) * colors[c]->step]);
      });
}

}  // namespace

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
  const Picture picture{file, width, height, channels, metadata, packing};
  check_values(picture);
  std::vector<unsigned char> bytes;
  try {
    bytes = target == Target::exr ? encode_exr(picture) : encode_png(picture);
  } catch (const WorkError&) {
    throw;
  } catch (const std::exception& error) {
    throw WorkError("can't encode " + file.string() + ": " + error.what());
  }
  replace_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void check_writable(const fs::path& file) {
  target_of(file);
  check_replaceable(file);
}

}  // namespace portalens
