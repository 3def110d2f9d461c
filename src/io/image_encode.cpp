// Pictures encoded through OpenImageIO.
#include "io/image_encode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <string>

#include "io/exr_matrix.h"
#include "io/srgb_bytes.h"

namespace portalens {
namespace {

/// As `fill(y, values)` gives one row of it after the other, pixel by pixel.
template <class Value, class Fill>
std::vector<unsigned char> encode(const EncodedPicture& picture, const char* name,
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

}  // namespace

std::vector<unsigned char> encode_exr(const EncodedPicture& picture) {
  const std::vector<ChannelView>& channels = picture.channels;
  const std::size_t stride = channels.size();
  OIIO::ImageSpec spec(picture.width, picture.height, static_cast<int>(stride),
                       OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const ChannelView& channel : channels) spec.channelnames.push_back(channel.name);
  for (const auto& [key, value] : picture.metadata)
    if (const auto matrix = key == matrix_entry ? matrix_in(value) : std::nullopt)
      spec.attribute("worldtocamera", OIIO::TypeMatrix, matrix->data());
    else
      spec.attribute(key, value);
  spec.attribute("compression", picture.packing == Packing::small ? "zip" : "rle");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("DateTime", "1970:01:01 00:00:00");  // else the time: not the same bits twice
  return encode<float>(picture, "picture.exr", spec, [&](std::size_t y, float* row) {
    for (std::size_t c = 0; c < stride; ++c)
      for (std::size_t x = 0; x < picture.row(); ++x)
        row[x * stride + c] = channels[c].values[(y * picture.row() + x) * channels[c].step];
  });
}

namespace {

/// 8 bits, sRGB.
OIIO::ImageSpec bytes_of(const EncodedPicture& picture) {
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  return spec;
}

std::vector<unsigned char> encode_bytes(const EncodedPicture& picture, const char* name,
                                        const OIIO::ImageSpec& spec) {
  static const SrgbBytes byte_of;
  const std::array<const ChannelView*, 3> colors = colors_of(picture);
  return encode<unsigned char>(picture, name, spec, [&](std::size_t y, unsigned char* row) {
    for (std::size_t x = 0; x < picture.row(); ++x)
      for (std::size_t c = 0; c < 3; ++c)
        row[3 * x + c] = byte_of(colors[c]->values[(y * picture.row() + x) * colors[c]->step]);
  });
}

}  // namespace

std::vector<unsigned char> encode_png(const EncodedPicture& picture) {
  OIIO::ImageSpec spec = bytes_of(picture);
  if (picture.packing == Packing::quick) spec.attribute("png:compressionLevel", 1);
  return encode_bytes(picture, "picture.png", spec);
}

bool encodes_jpeg() { return true; }

std::vector<unsigned char> encode_jpeg(const EncodedPicture& picture) {
  OIIO::ImageSpec spec = bytes_of(picture);
  spec.attribute("Compression", "jpeg:95");
  return encode_bytes(picture, "picture.jpg", spec);
}

}  // namespace portalens
