// Pictures made to hurt: what a header claims is not believed before the file bears it out.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "reliability/bomb.h"

namespace portalens::test {
namespace {

Bomb picture(const std::string& title, const std::string& bytes) {
  return {title, [=](const SceneFolder& folder) {
            folder.write("p", bytes);
            folder.write("scene.toml", names_picture);
            return std::string("scene.toml");
          }};
}

std::string little(std::uint32_t number) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> (8 * i));
  return bytes;
}

std::string big(std::uint32_t number) {
  const std::string bytes = little(number);
  return {bytes.rbegin(), bytes.rend()};
}

/// The checksum of PNG's chunks; ISO 15948, annex D.
std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t sum = 0xffffffffU;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1U) ? 0xedb88320U ^ (sum >> 1) : sum >> 1;
  }
  return ~sum;
}

std::string png(std::uint32_t width, std::uint32_t height) {
  const auto chunk = [](const std::string& body) {
    return big(static_cast<std::uint32_t>(body.size() - 4)) + body + big(checksum(body));
  };
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR" + big(width) + big(height) + std::string("\x08\x02\x00\x00\x00", 5)) +
         chunk(std::string("IDAT\x78\x9c\x03\x00\x00\x00\x00\x01", 12)) + chunk("IEND");
}

std::string exr(const std::string& more, std::uint32_t width, std::uint32_t height) {
  const auto attribute = [](const std::string& name, const std::string& type,
                            const std::string& value) {
    return name + '\0' + type + '\0' + little(static_cast<std::uint32_t>(value.size())) + value;
  };
  const std::string window = little(0) + little(0) + little(width - 1) + little(height - 1);
  const std::string channel = std::string("Y\0", 2) + little(1) + little(0) + little(1) + little(1);
  return "\x76\x2f\x31\x01" + little(2) + more + attribute("channels", "chlist", channel + '\0') +
         attribute("compression", "compression", std::string(1, '\0')) +
         attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) +
         attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         attribute("pixelAspectRatio", "float", std::string("\0\0\x80\x3f", 4)) +
         attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         attribute("screenWindowWidth", "float", std::string("\0\0\x80\x3f", 4)) + '\0';
}

std::vector<Bomb> picture_bombs() {
  const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  const std::string jpeg = std::string("\xff\xd8\xff\xc0\x00\x11\x08\xff\xff\xff\xff\x03", 12) +
                           std::string("\x01\x11\0\x02\x11\0\x03\x11\0", 9);
  return {
      picture("a PNG that claims 100,000 x 100,000", png(100'000, 100'000)),
      picture("a PNG that claims 16384 x 8192 and is empty", png(16384, 8192)),
      picture("a PNG that claims 4294967295 x 1", png(4294967295U, 1)),
      picture("a PNG cut off", png(8, 8).substr(0, 40)),
      picture("an HDR that claims 1e9 x 1e9", hdr + "-Y 1000000000 +X 1000000000\n"),
      picture("an HDR that claims 8192 x 16384 and is empty", hdr + "-Y 8192 +X 16384\n"),
      picture("an HDR that claims less than nothing", hdr + "-Y -5 +X -5\n"),
      picture("an EXR that claims 100,000 x 100,000", exr("", 100'000, 100'000)),
      picture("an EXR that claims 16384 x 8192 and is empty", exr("", 16384, 8192)),
      picture("an EXR with an attribute of 2 GB",
              exr(std::string("a\0string\0", 9) + little(0x7fffffff), 4, 4)),
      picture("an EXR with an attribute of less than nothing",
              exr(std::string("a\0string\0", 9) + little(0xffffffff), 4, 4)),
      picture("an EXR with tiles of 16384 x 16384",
              exr(std::string("tiles\0tiledesc\0", 15) + little(9) + little(16384) + little(16384) +
                      '\0',
                  4, 4)),
      picture("an EXR that never ends its header",
              "\x76\x2f\x31\x01" + little(2) + std::string(mega, 'x')),
      picture("a JPEG that claims 65535 x 65535", jpeg),
      picture("a JPEG without a frame", std::string("\xff\xd8\xff\xda\x00\x08", 6)),
      picture("words for a picture", std::string(mega, 'w')),
  };
}

TEST(Bombs, OfPicturesAreRefused) { expect_refused(picture_bombs()); }

}  // namespace
}  // namespace portalens::test
