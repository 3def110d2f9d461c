// Headers of PNG (ISO 15948), JPEG (ITU T.81), Radiance HDR and OpenEXR ("OpenEXR File Layout"), as
// far as memory depends on them.
#include "io/image_claim.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "io/header_cursor.h"
#include "io/radiance_header.h"

namespace portalens {
namespace {

void check_size(std::int64_t width, std::int64_t height) {
  if (width < 1 || height < 1) throw Refusal{"holds no flat picture", "save it as an ordinary one"};
  if (width > max_image_side || height > max_image_side || width * height > max_image_pixels)
    throw Refusal{"is " + std::to_string(width) + " x " + std::to_string(height),
                  "a side has at most 16384 pixels, the whole at most 16384 x 8192"};
}

constexpr std::int64_t mebibyte = std::int64_t{1} << 20;

/// @param ratio  by how much the format's coding can shrink anything at the very most
/// @param slack  so much is granted to any file, bytes
void check_room(std::int64_t decoded, std::size_t bytes, std::int64_t ratio,
                std::int64_t slack = mebibyte) {
  if (decoded - slack > static_cast<std::int64_t>(bytes) * ratio)
    throw Refusal{"claims to be larger than its " + std::to_string(bytes) + " bytes can hold",
                  "save it again"};
}

void check_png(HeaderCursor in, std::size_t size) {
  in.take(16);
  const std::int64_t width = in.big(4), height = in.big(4), depth = in.big(1), color = in.big(1);
  check_size(width, height);
  constexpr std::array<std::int64_t, 7> samples{1, 0, 3, 1, 2, 0, 4};
  if (color > 6 || samples[static_cast<std::size_t>(color)] == 0 || depth < 1 || depth > 16)
    refuse_as_broken("it has no known kind of pixels");
  const std::int64_t bits = width * depth * samples[static_cast<std::size_t>(color)];
  check_room(height * (bits / 8 + 1), size, 1032);  // deflate's utmost
}

void check_jpeg(HeaderCursor in, std::size_t size) {
  in.take(2);
  while (true) {
    if (in.big(1) != 0xff) refuse_as_broken("a marker is missing");
    std::int64_t marker = in.big(1);
    while (marker == 0xff) marker = in.big(1);
    if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7)) continue;  // stand alone
    if (marker == 0xd9 || marker == 0xda) refuse_as_broken("no frame comes before its data");
    const std::int64_t length = in.big(2);
    if (length < 2) refuse_as_broken("a segment has no length");
    const bool frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (!frame) {
      in.take(static_cast<std::size_t>(length) - 2);
      continue;
    }
    in.take(1);
    const std::int64_t height = in.big(2), width = in.big(2), components = in.big(1);
    check_size(width, height);
    if (components > 4) refuse_as_broken("it has " + std::to_string(components) + " components");
    check_room(width * height, size, 2048);  // a bit for each block of 8 x 8, and four times that
    return;
  }
}

void check_hdr(std::string_view bytes) {
  const RadianceHeader header = radiance_header(bytes);
  check_size(header.width, header.height);
  // The first coding has a line of 16384 equal pixels in 12 bytes.
  check_room(4 * header.width * header.height, bytes.size() - header.size, 5462);
}

/// Bytes that the decoder reads of a type, whatever the attribute says; nothing if it goes by that.
std::optional<std::size_t> exr_type_size(std::string_view type) {
  using Known = std::pair<std::string_view, std::size_t>;
  constexpr std::array known{Known{"box2i", 16},
                             Known{"box2f", 16},
                             Known{"chromaticities", 32},
                             Known{"compression", 1},
                             Known{"deepImageState", 1},
                             Known{"double", 8},
                             Known{"envmap", 1},
                             Known{"float", 4},
                             Known{"int", 4},
                             Known{"keycode", 28},
                             Known{"lineOrder", 1},
                             Known{"m33f", 36},
                             Known{"m33d", 72},
                             Known{"m44f", 64},
                             Known{"m44d", 128},
                             Known{"rational", 8},
                             Known{"tiledesc", 9},
                             Known{"timecode", 8},
                             Known{"v2i", 8},
                             Known{"v2f", 8},
                             Known{"v2d", 16},
                             Known{"v3i", 12},
                             Known{"v3f", 12},
                             Known{"v3d", 24}};
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const Known& one) { return one.first == type; });
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

/// That an attribute is as long as what its type makes the decoder read of it.
void check_exr_length(std::string_view type, HeaderCursor value) {
  const auto size = static_cast<std::int64_t>(value.left());
  bool sound = true;
  if (const auto fixed = exr_type_size(type)) {
    sound = value.left() == *fixed;
  } else if (type == "preview") {
    const std::int64_t width = value.little(), height = value.little();
    const auto fits = [&](std::int64_t side) { return side >= 0 && side <= size; };
    sound = fits(width) && fits(height) && 8 + 4 * width * height == size;
  } else if (type == "idmanifest") {
    const std::int64_t unpacked = value.little();
    sound = unpacked >= 0 && unpacked <= 1032 * size;
  } else if (type == "stringvector") {
    while (value.left() > 0)
      value.take(static_cast<std::size_t>(std::max<std::int64_t>(0, value.little())));
  }
  if (!sound) refuse_as_broken("an attribute of type " + std::string(type) + " has a wrong length");
}

/// How a compression cuts a picture into chunks, and by how much it can shrink one at the utmost.
struct ExrCoding {
  std::int64_t lines, ratio;
};
// Wavelets and cosines shrink a plain colour to some 1/25,000.
constexpr std::int64_t strongest = 65536;
// none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa, dwab. Deflate shrinks to 1/1032.
constexpr std::array<ExrCoding, 10> codings{{{1, 1},
                                             {1, 64},
                                             {1, 1032},
                                             {16, 1032},
                                             {32, strongest},
                                             {16, 1376},
                                             {32, 16},
                                             {32, 16},
                                             {32, strongest},
                                             {256, strongest}}};

/// What one part of an EXR file claims; the worst, where something is said twice.
struct ExrPart {
  std::int64_t width = 0, height = 0, bytes_a_pixel = 0;
  std::int64_t shown_width = 0, shown_height = 0;
  ExrCoding coding{256, 1};
  std::int64_t tile_width = 0, tile_height = 0;

  static void widen(HeaderCursor box, std::int64_t& across, std::int64_t& down) {
    const std::int64_t x0 = box.little(), y0 = box.little();
    across = std::max(across, box.little() - x0 + 1);
    down = std::max(down, box.little() - y0 + 1);
  }

  void attribute(std::string_view name, std::string_view type, HeaderCursor value) {
    if (name == "dataWindow" && type == "box2i") {
      widen(value, width, height);
    } else if (name == "displayWindow" && type == "box2i") {
      widen(value, shown_width, shown_height);
    } else if (type == "chlist") {
      std::int64_t sum = 0;
      while (!value.at_zero()) {
        value.text();
        sum += value.little() == 1 ? 2 : 4;  // half, or else
        value.take(12);
      }
      if (value.left() != 1) refuse_as_broken("its list of channels has a wrong length");
      bytes_a_pixel = std::max(bytes_a_pixel, sum);
    } else if (name == "compression" && type == "compression") {
      const auto kind = static_cast<std::size_t>(value.big(1));
      if (kind >= codings.size()) refuse_as_broken("its compression is not known");
      coding.lines = std::min(coding.lines, codings[kind].lines);
      coding.ratio = std::max(coding.ratio, codings[kind].ratio);
    } else if (name == "tiles" && type == "tiledesc") {
      tile_width = std::max(tile_width, value.little());
      tile_height = std::max(tile_height, value.little());
      if (tile_width < 1 || tile_height < 1) refuse_as_broken("its tiles have no size");
    }
  }

  void check(std::size_t size) const {
    if (bytes_a_pixel == 0) refuse_as_broken("it has no channels");
    check_size(width, height);
    if (bytes_a_pixel * width * height > 12 * max_image_pixels)
      throw Refusal{"has " + std::to_string(bytes_a_pixel) + " bytes a pixel", "use a smaller one"};
    check_size(shown_width, shown_height);
    // Where it has no pixels it is black. Each channel becomes floats, and there are three or more.
    const std::int64_t shown_bytes = std::max<std::int64_t>(12, 2 * bytes_a_pixel);
    check_room(shown_bytes * shown_width * shown_height, size, strongest);
    std::int64_t chunks = (height - 1) / coding.lines + 1;
    if (tile_width > 0) {
      check_size(tile_width, tile_height);
      chunks = ((width - 1) / tile_width + 1) * ((height - 1) / tile_height + 1);
      // A tile may be larger than the picture, and the file none the larger for it; the decoder
      // holds a whole tile and a row of them.
      check_room(bytes_a_pixel * (tile_width + width) * tile_height, size, coding.ratio,
                 128 * mebibyte);
    }
    check_room(8 * chunks, size, 1);  // where each begins is in the file
    check_room(bytes_a_pixel * width * height, size, coding.ratio);
  }
};

void check_exr(HeaderCursor in, std::size_t size) {
  in.take(4);
  const bool multipart = (in.little() & 0x1000) != 0;
  do {
    ExrPart part;
    while (!in.at_zero()) {
      const ExrAttribute attribute = take_exr_attribute(in);
      const HeaderCursor value(attribute.value);
      check_exr_length(attribute.type, value);
      part.attribute(attribute.name, attribute.type, value);
    }
    in.take(1);
    part.check(size);
  } while (multipart && !in.at_zero());
}

}  // namespace

void check_claim(std::string_view bytes, ImageFormat format) {
  const HeaderCursor in(bytes);
  switch (format) {
    case ImageFormat::exr:
      return check_exr(in, bytes.size());
    case ImageFormat::png:
      return check_png(in, bytes.size());
    case ImageFormat::hdr:
      return check_hdr(bytes);
    case ImageFormat::jpeg:
      return check_jpeg(in, bytes.size());
  }
}

}  // namespace portalens
