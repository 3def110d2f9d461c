// Pictures in, decoded from memory: told by their first bytes, measured by their header before
// anything is allocated, and checked for values that are not finite.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/exr_file.h"
#include "io/files.h"
#include "io/image.h"
#include "io/image_bytes.h"
#include "io/image_claim.h"
#include "io/image_window.h"
#include "io/jpeg_file.h"
#include "io/png_file.h"
#include "io/radiance.h"
#include "math/srgb.h"

namespace portalens {
namespace {

constexpr std::uint64_t max_bytes = std::uint64_t{1} << 30;

/// Which of a file's channels are red, green and blue; one three times over if it is gray.
std::array<std::size_t, 3> color_channels(const std::vector<std::string>& channels) {
  const auto at = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(channels.begin(), channels.end(), name) -
                                    channels.begin());
  };
  const std::array<std::size_t, 3> named{at("R"), at("G"), at("B")};
  if (*std::max_element(named.begin(), named.end()) < channels.size()) return named;
  if (at("RY") < channels.size())
    throw Refusal{"holds luminance and differences of colours", "save it as R, G and B"};
  const bool gray = at("Y") < channels.size();
  if (!gray && channels.size() > 2) return {0, 1, 2};
  const std::size_t one = gray ? at("Y") : 0;
  return {one, one, one};
}

/// What the decoder found, held against the limits once more: it may read a header otherwise.
void check_header(const ExrFile& file) {
  for (const PixelWindow& window : {file.data(), file.display()}) {
    if (window.width < 1 || window.height < 1 || file.channels().empty())
      throw Refusal{"holds no flat picture", "save it as an ordinary picture"};
    if (window.width > max_image_side || window.height > max_image_side ||
        std::int64_t{window.width} * window.height > max_image_pixels)
      throw Refusal{"has a size that its header hides", "save it again"};
  }
  if (!share_a_pixel(file.data(), file.display()))
    throw Refusal{"shows nothing: its data window lies outside its display window",
                  "move one of them"};
}

/// The three colour planes.
Image color_of(const Samples& samples) {
  Image image(samples.width, samples.height, 3);
  const auto channels = color_channels(samples.channels);
  const std::size_t step = samples.channels.size();
  for (std::size_t i = 0; i < image.pixels.size() / 3; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[3 * i + c] = samples.values[i * step + channels[c]];
  return image;
}

/// The three colour planes of what an EXR shows.
Image color_of(ExrFile& file) {
  check_header(file);
  const PixelWindow data = file.data(), display = file.display();
  Image image(data.width, data.height, 3);
  const auto channels = color_channels(file.channels());
  const auto name = [&](std::size_t c) { return file.channels()[channels[c]]; };
  float* const first = image.pixels.data();
  if (channels[0] == channels[1]) {
    file.read({{name(0), first, 3}});
    for (std::size_t i = 0; i < image.pixels.size(); i += 3)
      image.pixels[i + 1] = image.pixels[i + 2] = image.pixels[i];
  } else {
    file.read({{name(0), first, 3}, {name(1), first + 1, 3}, {name(2), first + 2, 3}});
  }
  image.pixels = shown(std::move(image.pixels), 3, data, display);
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

ChannelPicture all_channels_of(ExrFile& file) {
  check_header(file);
  const PixelWindow data = file.data(), display = file.display();
  const auto count = static_cast<std::int64_t>(file.channels().size());
  for (const PixelWindow& window : {data, display})
    if (std::int64_t{window.width} * window.height * count > 3 * max_image_pixels)
      throw Refusal{"has " + std::to_string(count) + " channels", "use a smaller one"};
  ChannelPicture picture{display.width, display.height, {}};
  const auto pixels = static_cast<std::size_t>(data.width) * static_cast<std::size_t>(data.height);
  std::vector<ExrFile::Target> targets;
  for (const std::string& name : file.channels())
    picture.channels.push_back({name, std::vector<float>(pixels)});
  for (Channel& channel : picture.channels)
    targets.push_back({channel.name, channel.values.data(), 1});
  file.read(targets);
  for (Channel& channel : picture.channels)
    channel.values = shown(std::move(channel.values), 1, data, display);
  return picture;
}

ChannelPicture all_channels_of(const Samples& samples) {
  ChannelPicture picture{samples.width, samples.height, {}};
  const std::size_t step = samples.channels.size();
  for (std::size_t c = 0; c < step; ++c) {
    Channel& channel = picture.channels.emplace_back(Channel{samples.channels[c], {}});
    for (std::size_t i = c; i < samples.values.size(); i += step)
      channel.values.push_back(samples.values[i]);
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

/// What `take` makes of a picture that is no Radiance picture.
template <class Take>
auto decoded_by(const std::string& bytes, ImageFormat format, const Take& take) {
  if (format == ImageFormat::png) return take(decode_png(bytes));
  if (format == ImageFormat::jpeg) return take(decode_jpeg(bytes));
  ExrFile file(bytes);
  return take(file);
}

Image decode(const std::string& bytes, ImageFormat format) {
  Image image = format == ImageFormat::hdr
                    ? read_radiance(bytes)
                    : decoded_by(bytes, format, [](auto&& picture) { return color_of(picture); });
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
  const auto decoded = [](const std::string& bytes, ImageFormat format) {
    if (format == ImageFormat::hdr) return channels_of(read_radiance(bytes));
    return decoded_by(bytes, format, [](auto&& picture) { return all_channels_of(picture); });
  };
  return read_picture(file, asked_at, faults, nullptr, decoded);
}

}  // namespace portalens
