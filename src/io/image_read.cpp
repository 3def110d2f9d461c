// Pictures in, through OpenImageIO from memory, those of Radiance without it: told by their first
// bytes, measured by their header before anything is allocated, and checked for values that are not
// finite.
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
#include <utility>
#include <vector>

#include "io/files.h"
#include "io/image.h"
#include "io/image_bytes.h"
#include "io/image_claim.h"
#include "io/image_window.h"
#include "io/radiance.h"
#include "math/srgb.h"

namespace portalens {
namespace {

constexpr std::uint64_t max_bytes = std::uint64_t{1} << 30;

/// As OpenImageIO calls it.
const char* name_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::exr:
      return "exr";
    case ImageFormat::png:
      return "png";
    case ImageFormat::hdr:
      return "hdr";
    case ImageFormat::jpeg:
      break;
  }
  return "jpeg";
}

/// Which of a file's channels are red, green and blue; one three times over if it is gray.
std::array<int, 3> color_channels(const OIIO::ImageSpec& spec) {
  const std::array<int, 3> named{spec.channelindex("R"), spec.channelindex("G"),
                                 spec.channelindex("B")};
  if (named[0] >= 0 && named[1] >= 0 && named[2] >= 0) return named;
  const int gray = std::max(0, spec.channelindex("Y"));
  if (spec.nchannels < 3) return {gray, gray, gray};
  return {0, 1, 2};
}

PixelWindow data_of(const OIIO::ImageSpec& spec) {
  return {spec.x, spec.y, spec.width, spec.height};
}
PixelWindow display_of(const OIIO::ImageSpec& spec) {
  return {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
}

/// What the decoder found, held against the limits once more: it may read a header otherwise.
void check_header(const OIIO::ImageSpec& spec) {
  for (const PixelWindow& window : {data_of(spec), display_of(spec)}) {
    if (window.width < 1 || window.height < 1 || spec.nchannels < 1 || spec.deep)
      throw Refusal{"holds no flat picture", "save it as an ordinary picture"};
    if (window.width > max_image_side || window.height > max_image_side ||
        std::int64_t{window.width} * window.height > max_image_pixels)
      throw Refusal{"has a size that its header hides", "save it again"};
  }
  if (!share_a_pixel(data_of(spec), display_of(spec)))
    throw Refusal{"shows nothing: its data window lies outside its display window",
                  "move one of them"};
}

void read_planes(OIIO::ImageInput& input, int begin, int end, float* target) {
  if (!input.read_image(0, 0, begin, end, OIIO::TypeDesc::FLOAT, target)) {
    throw Refusal{"is broken: " + input.geterror(), "save it again"};
  }
}

/// The three colour planes of an open picture's data window.
Image color_of_data(OIIO::ImageInput& input, const OIIO::ImageSpec& spec) {
  Image image(spec.width, spec.height, 3);
  const std::array<int, 3> channels = color_channels(spec);
  if (channels[1] == channels[0] + 1 && channels[2] == channels[0] + 2) {
    read_planes(input, channels[0], channels[0] + 3, image.pixels.data());
    return image;
  }
  std::vector<float> plane(image.pixels.size() / 3);
  for (std::size_t c = 0; c < 3; ++c) {
    if (c == 0 || channels[c] != channels[c - 1]) {
      read_planes(input, channels[c], channels[c] + 1, plane.data());
    }
    for (std::size_t i = 0; i < plane.size(); ++i) image.pixels[3 * i + c] = plane[i];
  }
  return image;
}

/// The three colour planes of an open picture.
Image color_of(OIIO::ImageInput& input) {
  const OIIO::ImageSpec spec = input.spec();
  check_header(spec);
  Image image = color_of_data(input, spec);
  const PixelWindow display = display_of(spec);
  image.pixels = shown(std::move(image.pixels), 3, data_of(spec), display);
  image.width = display.width;
  image.height = display.height;
  return image;
}

void check_finite(const Image& image) {
  const auto broken = std::find_if(image.pixels.begin(), image.pixels.end(),
                                   [](float value) { return !std::isfinite(value); });
  if (broken == image.pixels.end()) return;
  const auto pixel = (broken - image.pixels.begin()) / 3;
  throw Refusal{"is not finite at pixel (" + std::to_string(pixel % image.width) + ", " +
                    std::to_string(pixel / image.width) + ")",
                "give every pixel a number"};
}

ChannelPicture all_channels_of(OIIO::ImageInput& input) {
  const OIIO::ImageSpec spec = input.spec();
  check_header(spec);
  const PixelWindow data = data_of(spec), display = display_of(spec);
  for (const PixelWindow& window : {data, display})
    if (std::int64_t{window.width} * window.height * spec.nchannels > 3 * max_image_pixels)
      throw Refusal{"has " + std::to_string(spec.nchannels) + " channels", "use a smaller one"};
  ChannelPicture picture{display.width, display.height, {}};
  const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  // Readers of PNG and JPEG go through a file once: channel by channel only EXR can be read.
  const auto count = static_cast<std::size_t>(spec.nchannels);
  const bool at_once = std::string_view(input.format_name()) != "openexr";
  std::vector<float> all(at_once ? pixels * count : 0);
  if (at_once) read_planes(input, 0, spec.nchannels, all.data());
  for (std::size_t c = 0; c < count; ++c) {
    Channel& channel =
        picture.channels.emplace_back(Channel{spec.channelnames[c], std::vector<float>(pixels)});
    if (at_once)
      for (std::size_t i = 0; i < pixels; ++i) channel.values[i] = all[i * count + c];
    else
      read_planes(input, static_cast<int>(c), static_cast<int>(c) + 1, channel.values.data());
    channel.values = shown(std::move(channel.values), 1, data, display);
  }
  return picture;
}

ChannelPicture channels_of(const Image& image) {
  ChannelPicture picture{image.width, image.height, {{"R", {}}, {"G", {}}, {"B", {}}}};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = c; i < image.pixels.size(); i += 3)
      picture.channels[c].values.push_back(image.pixels[i]);
  return picture;
}

/// A file's bytes for the decoder. OpenImageIO's own reader goes to before the first byte where a
/// file says that something lies there.
class MemoryReader : public OIIO::Filesystem::IOMemReader {
 public:
  explicit MemoryReader(const std::string& bytes) : IOMemReader(bytes.data(), bytes.size()) {}
  std::size_t read(void* to, std::size_t count) override {
    const std::size_t got = pread(to, count, m_pos);
    m_pos += static_cast<std::int64_t>(got);
    return got;
  }
  std::size_t pread(void* to, std::size_t count, std::int64_t from) override {
    if (from < 0 || static_cast<std::size_t>(from) >= size()) return 0;
    return IOMemReader::pread(to, std::min(count, size() - static_cast<std::size_t>(from)), from);
  }
};

/// Opens a picture that lies in memory, and hands it to `take`.
template <class Take>
auto opened(const std::string& bytes, ImageFormat format, const Take& take) {
  MemoryReader reader(bytes);
  const auto input = OIIO::ImageInput::create(name_of(format), false);
  if (!input || !input->supports("ioproxy") || !input->set_ioproxy(&reader)) {
    throw Refusal{"is of a kind this build can't read", "save it as EXR or PNG"};
  }
  input->threads(1);
  OIIO::ImageSpec wishes, spec;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  if (!input->open(name_of(format), spec, wishes)) {
    throw Refusal{"is broken: " + input->geterror(), "save it again"};
  }
  return take(*input);
}

Image decode(const std::string& bytes, ImageFormat format) {
  Image image = format == ImageFormat::hdr ? read_radiance(bytes) : opened(bytes, format, color_of);
  check_finite(image);
  if (format == ImageFormat::png || format == ImageFormat::jpeg) {
    for (float& value : image.pixels) value = linear_from_srgb(value);
  }
  return image;
}

/// Reads a file, and gives what `decoded` makes of its bytes; faults are added where it can't.
template <class Decoded>
auto read_picture(const std::filesystem::path& file, const Location& asked_at, Faults& faults,
                  Digests* digests, const Decoded& decoded)
    -> std::optional<decltype(decoded(std::string{}, ImageFormat{}))> {
  auto bytes = read_file(file, max_bytes, asked_at, faults, digests);
  if (!bytes) return std::nullopt;
  const std::string name = "the picture " + file.filename().string() + " ";
  const auto format = image_format(*bytes);
  if (!format) {
    const std::string kind(unread_format(*bytes));
    faults.add(asked_at, name + (kind.empty() ? "is of no known kind" : "is " + kind),
               "EXR, PNG, HDR and JPEG are read");
    return std::nullopt;
  }
  try {
    const auto bare = without_descriptions(std::move(*bytes), *format);
    if (!bare)
      throw Refusal{"is broken: cut off, or changed after it was written", "save it again"};
    check_claim(*bare, *format);
    return decoded(*bare, *format);
  } catch (const Refusal& refusal) {
    faults.add(asked_at, name + refusal.problem, refusal.remedy);
  } catch (const std::bad_alloc&) {
    faults.add(asked_at, name + "needs more memory than there is", "use a smaller one");
  } catch (const std::exception& error) {
    faults.add(asked_at, name + "is broken: " + error.what(), "save it again");
  }
  return std::nullopt;
}

}  // namespace

std::optional<Image> read_image(const std::filesystem::path& file, const Location& asked_at,
                                Faults& faults, Digests* digests) {
  return read_picture(file, asked_at, faults, digests, decode);
}

std::optional<ChannelPicture> read_channels(const std::filesystem::path& file,
                                            const Location& asked_at, Faults& faults) {
  return read_picture(file, asked_at, faults, nullptr,
                      [](const std::string& bytes, ImageFormat format) {
                        return format == ImageFormat::hdr ? channels_of(read_radiance(bytes))
                                                          : opened(bytes, format, all_channels_of);
                      });
}

}  // namespace portalens
