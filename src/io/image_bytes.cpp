#include "io/image_bytes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "io/checksums.h"

namespace portalens {
namespace {

std::size_t byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

/// JFIF: markers `ff xx`, each with a big-endian length, until the scan begins.
std::string bare_jpeg(std::string_view bytes) {
  constexpr std::size_t start_of_scan = 0xda, first_application = 0xe0, adobe = 0xee,
                        last_application = 0xef, comment = 0xfe;
  std::string result(bytes.substr(0, 2));
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && byte_at(bytes, at) == 0xff) {
    const std::size_t marker = byte_at(bytes, at + 1);
    if (marker == start_of_scan) break;
    const std::size_t length = byte_at(bytes, at + 2) * 256 + byte_at(bytes, at + 3) + 2;
    if (length < 4 || at + length > bytes.size()) break;
    const bool describes =
        marker == comment || (marker > first_application && marker <= last_application);
    // Adobe's says how the colours are coded.
    if (!describes || marker == adobe) result += bytes.substr(at, length);
    at += length;
  }
  return result += bytes.substr(std::min(at, bytes.size()));
}

std::size_t word_at(std::string_view bytes, std::size_t at) {
  std::size_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = word << 8 | byte_at(bytes, at + i);
  return word;
}

/// PNG: chunks of length, name, data, checksum. What a name in lower case begins can be left out.
std::optional<std::string> bare_png(std::string_view bytes) {
  constexpr std::size_t signature = 8, frame = 12;
  std::string result(bytes.substr(0, signature));
  std::string_view name;
  for (std::size_t at = signature; name != "IEND";) {
    if (at + frame > bytes.size()) return std::nullopt;
    const std::size_t length = word_at(bytes, at);
    if (length > bytes.size() - at - frame) return std::nullopt;
    name = bytes.substr(at + 4, 4);
    const std::string_view named = bytes.substr(at + 4, 4 + length);
    if (crc32(named) != word_at(bytes, at + 8 + length)) return std::nullopt;
    const bool needed = name[0] >= 'A' && name[0] <= 'Z';
    if (needed || name == "tRNS") result += bytes.substr(at, frame + length);
    at += frame + length;
  }
  return result;
}

}  // namespace

std::optional<ImageFormat> image_format(std::string_view bytes) {
  const auto begins = [&](std::string_view magic) {
    return bytes.substr(0, magic.size()) == magic;
  };
  if (begins("\x76\x2f\x31\x01")) return ImageFormat::exr;
  if (begins("\x89PNG\r\n\x1a\n")) return ImageFormat::png;
  if (begins("#?RADIANCE") || begins("#?RGBE")) return ImageFormat::hdr;
  if (begins("\xff\xd8\xff")) return ImageFormat::jpeg;
  return std::nullopt;
}

std::string_view unread_format(std::string_view bytes) {
  using namespace std::string_view_literals;
  using Known = std::pair<std::string_view, std::string_view>;
  constexpr std::array known{Known{"BM"sv, "BMP"},
                             Known{"GIF8"sv, "GIF"},
                             Known{"II*\0"sv, "TIFF"},
                             Known{"MM\0*"sv, "TIFF"},
                             Known{"8BPS"sv, "Photoshop"},
                             Known{"DDS "sv, "DDS"},
                             Known{"\xabKTX"sv, "KTX"},
                             Known{"\0\0\0\x0cjP  "sv, "JPEG 2000"},
                             Known{"\xff\x0a"sv, "JPEG XL"},
                             Known{"P6"sv, "PPM"},
                             Known{"PF"sv, "PFM"}};
  for (const auto& [magic, name] : known)
    if (bytes.starts_with(magic)) return name;
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "WebP";
  if (bytes.substr(0, 12).find("ftypavif") == 4) return "AVIF";
  if (bytes.substr(0, 12).find("ftyphei") == 4) return "HEIF";
  return bytes.ends_with("TRUEVISION-XFILE.\0"sv) ? "TGA" : "";
}

std::optional<std::string> without_descriptions(std::string bytes, ImageFormat format) {
  if (format == ImageFormat::jpeg) return bare_jpeg(bytes);
  if (format == ImageFormat::png) return bare_png(bytes);
  return bytes;
}

}  // namespace portalens
