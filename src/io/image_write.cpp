// Pictures out, through OpenImageIO into memory; the bytes are written by replace_file, because the
// library reports a full disk as success.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
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
#include "io/srgb.h"

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

void check_values(const fs::path& file, int width, int height,
                  const std::vector<Channel>& channels) {
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (const Channel& channel : channels) {
    if (width < 1 || height < 1 || channel.values.size() != count) {
      throw WorkError("can't write " + file.string() + ": channel " + channel.name +
                      " is not of the picture's size");
    }
    const auto broken = std::find_if(channel.values.begin(), channel.values.end(),
                                     [](float value) { return !std::isfinite(value); });
    if (broken != channel.values.end()) {
      const std::size_t at = static_cast<std::size_t>(broken - channel.values.begin());
      const std::size_t row = static_cast<std::size_t>(width);
      throw WorkError("can't write " + file.string() + ": channel " + channel.name +
                      " is not finite at pixel (" + std::to_string(at % row) + ", " +
                      std::to_string(at / row) + ")");
    }
  }
}

/// Pixel by pixel, as files have it.
std::vector<float> interleaved(const std::vector<Channel>& channels) {
  const std::size_t stride = channels.size();
  std::vector<float> pixels(stride * channels.front().values.size());
  for (std::size_t c = 0; c < stride; ++c) {
    for (std::size_t i = 0; i < channels[c].values.size(); ++i) {
      pixels[i * stride + c] = channels[c].values[i];
    }
  }
  return pixels;
}

std::string encode(const fs::path& file, const char* name, const OIIO::ImageSpec& spec,
                   OIIO::TypeDesc type, const void* pixels) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(name);
  const auto fail = [&](const std::string& why) {
    throw WorkError("can't encode " + file.string() + ": " + why);
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
  if (!output->open(name, spec) || !output->write_image(type, pixels) || !output->close()) {
    fail(output->geterror());
  }
  if (bytes.empty()) fail("nothing came of it");
  return std::string(bytes.begin(), bytes.end());
}

std::string encode_exr(const fs::path& file, int width, int height,
                       const std::vector<Channel>& channels, const Metadata& metadata) {
  OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const Channel& channel : channels) spec.channelnames.push_back(channel.name);
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("DateTime", "1970:01:01 00:00:00");  // else the time: not the same bits twice
  const std::vector<float> pixels = interleaved(channels);
  return encode(file, "picture.exr", spec, OIIO::TypeDesc::FLOAT, pixels.data());
}

std::string encode_png(const fs::path& file, int width, int height,
                       const std::vector<Channel>& channels) {
  std::vector<unsigned char> pixels(static_cast<std::size_t>(width) * height * 3);
  constexpr std::string_view names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = std::find_if(channels.begin(), channels.end(),
                                      [&](const Channel& one) { return one.name == names[c]; });
    if (channel == channels.end()) {
      throw WorkError("can't write " + file.string() + ": there is no channel " +
                      std::string(names[c]));
    }
    for (std::size_t i = 0; i < channel->values.size(); ++i) {
      const double linear = std::clamp(static_cast<double>(channel->values[i]), 0.0, 1.0);
      pixels[3 * i + c] = static_cast<unsigned char>(std::lround(255.0 * srgb_from_linear(linear)));
    }
  }
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  return encode(file, "picture.png", spec, OIIO::TypeDesc::UINT8, pixels.data());
}

}  // namespace

void write_image(const fs::path& file, int width, int height, const std::vector<Channel>& channels,
                 const Metadata& metadata) {
  const Target target = target_of(file);
  if (channels.empty()) throw WorkError("can't write " + file.string() + ": no channels");
  check_values(file, width, height, channels);
  std::string bytes;
  try {
    bytes = target == Target::exr ? encode_exr(file, width, height, channels, metadata)
                                  : encode_png(file, width, height, channels);
  } catch (const WorkError&) {
    throw;
  } catch (const std::exception& error) {
    throw WorkError("can't encode " + file.string() + ": " + error.what());
  }
  replace_file(file, bytes);
}

void check_writable(const fs::path& file) {
  target_of(file);
  check_replaceable(file);
}

}  // namespace portalens
