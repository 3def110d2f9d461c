// OpenEXR file layout (openexr.com, "OpenEXR File Layout"), with compression none; PNG, ISO/IEC
// 15948, with the stored blocks of RFC 1951.
#include "io/plain_pictures.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "io/bits.h"
#include "io/checksums.h"
#include "io/exr_matrix.h"
#include "io/srgb_bytes.h"

namespace portalens {
namespace {

/// The lowest byte first.
template <class Number>
void append_low_first(std::string& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i)
    bytes += static_cast<char>(static_cast<std::uint64_t>(number) >> 8 * i & 0xff);
}

void append_high_first(std::string& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
}

void append_float(std::string& bytes, float number) {
  append_low_first(bytes, bit_cast<std::uint32_t>(number));
}

void append_attribute(std::string& header, std::string_view name, std::string_view type,
                      std::string_view value) {
  header.append(name).append(1, '\0').append(type).append(1, '\0');
  append_low_first(header, static_cast<std::uint32_t>(value.size()));
  header.append(value);
}

/// An EXR's channels stand in the order of their names.
std::vector<const ChannelView*> by_name(const EncodedPicture& picture) {
  std::vector<const ChannelView*> channels;
  for (const ChannelView& channel : picture.channels) channels.push_back(&channel);
  std::sort(channels.begin(), channels.end(),
            [](const ChannelView* a, const ChannelView* b) { return a->name < b->name; });
  return channels;
}

std::string channel_list(const std::vector<const ChannelView*>& channels) {
  constexpr std::uint32_t of_floats = 2;
  std::string list;
  for (const ChannelView* channel : channels) {
    list.append(channel->name).append(1, '\0');
    append_low_first(list, of_floats);
    append_low_first(list, std::uint32_t{0});  // not for our eyes' curve
    append_low_first(list, std::uint32_t{1});  // each column
    append_low_first(list, std::uint32_t{1});  // each row
  }
  return list + '\0';
}

std::string exr_header(const EncodedPicture& picture,
                       const std::vector<const ChannelView*>& channels) {
  constexpr std::size_t longest_short_name = 31;
  constexpr std::uint32_t magic = 20000630, version = 2, long_names = 0x400;
  bool is_long = false;
  for (const ChannelView* channel : channels) is_long |= channel->name.size() > longest_short_name;
  for (const auto& [name, value] : picture.metadata) is_long |= name.size() > longest_short_name;
  std::string header, window, middle, one;
  append_low_first(header, magic);
  append_low_first(header, is_long ? version | long_names : version);
  for (const int side : {0, 0, picture.width - 1, picture.height - 1})
    append_low_first(window, static_cast<std::uint32_t>(side));
  for (int i = 0; i < 2; ++i) append_float(middle, 0.0f);
  append_float(one, 1.0f);
  const std::string_view zero("\0", 1);
  append_attribute(header, "channels", "chlist", channel_list(channels));
  append_attribute(header, "compression", "compression", zero);
  append_attribute(header, "dataWindow", "box2i", window);
  append_attribute(header, "displayWindow", "box2i", window);
  append_attribute(header, "lineOrder", "lineOrder", zero);
  append_attribute(header, "pixelAspectRatio", "float", one);
  append_attribute(header, "screenWindowCenter", "v2f", middle);
  append_attribute(header, "screenWindowWidth", "float", one);
  for (const auto& [name, value] : picture.metadata)
    if (const auto matrix = name == matrix_entry ? matrix_in(value) : std::nullopt) {
      std::string numbers;
      for (const float number : *matrix) append_float(numbers, number);
      append_attribute(header, name, "m44f", numbers);
    } else {
      append_attribute(header, name, "string", value);
    }
  return header + '\0';
}

std::vector<unsigned char> as_bytes(const std::string& text) { return {text.begin(), text.end()}; }

void append_chunk(std::string& file, std::string_view name, std::string_view data) {
  append_high_first(file, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = file.size();
  file.append(name).append(data);
  append_high_first(file, crc32(std::string_view(file).substr(begin)));
}

/// A zlib stream of stored blocks.
std::string stored(std::string_view data) {
  constexpr std::size_t longest = 65535;
  std::string stream = "\x78\x01";
  std::string_view left = data;
  do {
    const std::size_t count = std::min(longest, left.size());
    stream += count == left.size() ? '\1' : '\0';
    append_low_first(stream, static_cast<std::uint16_t>(count));
    append_low_first(stream, static_cast<std::uint16_t>(~count));
    stream.append(left.substr(0, count));
    left.remove_prefix(count);
  } while (!left.empty());
  append_high_first(stream, adler32(data));
  return stream;
}

}  // namespace

std::vector<unsigned char> plain_exr(const EncodedPicture& picture) {
  const std::vector<const ChannelView*> channels = by_name(picture);
  std::string file = exr_header(picture, channels);
  const auto height = static_cast<std::size_t>(picture.height);
  const std::size_t row_bytes = 4 * picture.row() * channels.size();
  const std::size_t rows_begin = file.size() + 8 * height;
  for (std::size_t y = 0; y < height; ++y)
    append_low_first(file, static_cast<std::uint64_t>(rows_begin + y * (8 + row_bytes)));
  for (std::size_t y = 0; y < height; ++y) {
    append_low_first(file, static_cast<std::uint32_t>(y));
    append_low_first(file, static_cast<std::uint32_t>(row_bytes));
    for (const ChannelView* channel : channels)
      for (std::size_t x = 0; x < picture.row(); ++x)
        append_float(file, channel->values[(y * picture.row() + x) * channel->step]);
  }
  return as_bytes(file);
}

std::vector<unsigned char> plain_png(const EncodedPicture& picture) {
  static const SrgbBytes byte_of;
  const auto colors = colors_of(picture);
  std::string header, rows;
  append_high_first(header, static_cast<std::uint32_t>(picture.width));
  append_high_first(header, static_cast<std::uint32_t>(picture.height));
  header.append("\x08\x02\0\0\0", 5);  // 8 bits of red, green and blue
  for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y) {
    rows += '\0';  // no filter
    for (std::size_t x = 0; x < picture.row(); ++x)
      for (const ChannelView* color : colors)
        rows += static_cast<char>(byte_of(color->values[(y * picture.row() + x) * color->step]));
  }
  std::string file = "\x89PNG\r\n\x1a\n";
  append_chunk(file, "IHDR", header);
  append_chunk(file, "sRGB", std::string_view("\0", 1));
  append_chunk(file, "IDAT", stored(rows));
  append_chunk(file, "IEND", {});
  return as_bytes(file);
}

}  // namespace portalens
