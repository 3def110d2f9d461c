// Every kind of PNG, JPEG and EXR is read as another reader reads it, to the bit.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <map>
#include <string>

#include "io/checksums.h"
#include "io/image.h"
#include "support/pictures.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/temporary_folder.h"

namespace portalens::test {
namespace {

std::string big_endian(std::size_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

std::string chunk(const std::string& name, const std::string& data) {
  return big_endian(data.size()) + name + data + big_endian(crc32(std::string_view(name + data)));
}

std::string random_bytes(Random& random, std::size_t count) {
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>(random.bits() & 0xff);
  return bytes;
}

struct PngKind {
  int depth, color;
  bool interlaced, transparent;
};

constexpr int samples_of(int color) { return color == 2 ? 3 : color == 4 ? 2 : color == 6 ? 4 : 1; }

/// Rows of any bytes, by any filters: all of them are pixels.
std::string rows(Random& random, const PngKind& kind, int width, int height) {
  std::string bytes;
  const auto row_bytes =
      static_cast<std::size_t>((width * samples_of(kind.color) * kind.depth + 7) / 8);
  for (int y = 0; y < height && width > 0; ++y) {
    bytes += static_cast<char>(random.bits() % 5);
    bytes += random_bytes(random, row_bytes);
  }
  return bytes;
}

std::string png(Random& random, const PngKind& kind, int width, int height) {
  std::string all;
  if (kind.interlaced) {
    constexpr int passes[7][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                  {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
    for (const auto& [x, y, dx, dy] : passes)
      all += rows(random, kind, (width - x + dx - 1) / dx, (height - y + dy - 1) / dy);
  } else {
    all = rows(random, kind, width, height);
  }
  std::string packed(compressBound(all.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(all.data()), all.size());
  packed.resize(size);
  std::string header =
      big_endian(static_cast<std::size_t>(width)) + big_endian(static_cast<std::size_t>(height));
  for (const int value : {kind.depth, kind.color, 0, 0, kind.interlaced ? 1 : 0})
    header += static_cast<char>(value);
  std::string file = "\x89PNG\r\n\x1a\n" + chunk("IHDR", header);
  const std::size_t entries = std::size_t{1} << kind.depth;
  if (kind.color == 3) file += chunk("PLTE", random_bytes(random, 3 * entries));
  if (kind.transparent) {
    std::string chosen = random_bytes(random, kind.color == 3 ? entries : kind.color == 2 ? 6 : 2);
    if (kind.color != 3 && kind.depth < 16)
      for (std::size_t i = 0; i < chosen.size(); ++i)
        chosen[i] = i % 2 == 0 ? '\0' : static_cast<char>(chosen[i] & ((1 << kind.depth) - 1));
    file += chunk("tRNS", chosen);
  }
  return file + chunk("IDAT", packed) + chunk("IEND", "");
}

/// The same file by OpenImageIO, by channel.
std::map<std::string, std::vector<float>> read_otherwise(const std::filesystem::path& file) {
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file.string(), &wishes);
  if (!input) return {};
  const OIIO::ImageSpec spec = input->spec();
  const auto count = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> all(count * static_cast<std::size_t>(spec.width) *
                         static_cast<std::size_t>(spec.height));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, all.data())) return {};
  std::map<std::string, std::vector<float>> channels;
  for (std::size_t i = 0; i < all.size(); ++i)
    channels[spec.channelnames[i % count]].push_back(all[i]);
  return channels;
}

void expect_same(const std::filesystem::path& file, const std::string& what) {
  Faults faults;
  const auto picture = read_channels(file, {}, faults);
  ASSERT_TRUE(picture) << what;
  const auto expected = read_otherwise(file);
  ASSERT_FALSE(expected.empty()) << what;
  EXPECT_EQ(picture->channels.size(), expected.size()) << what;
  for (const Channel& channel : picture->channels) {
    const auto found = expected.find(channel.name);
    ASSERT_NE(found, expected.end()) << what << ' ' << channel.name;
    EXPECT_EQ(channel.values, found->second) << what << ' ' << channel.name;
  }
}

TEST(ImageFormats, EveryKindOfPngIsReadAsAnotherReaderReadsIt) {
  const TemporaryFolder folder;
  Random random(11);
  for (const auto& [color, depths] : std::map<int, std::vector<int>>{
           {0, {1, 2, 4, 8, 16}}, {2, {8, 16}}, {3, {1, 2, 4, 8}}, {4, {8, 16}}, {6, {8, 16}}})
    for (const int depth : depths)
      for (const bool interlaced : {false, true})
        for (const bool transparent : {false, true}) {
          if (transparent && color >= 4) continue;
          const int width = 1 + static_cast<int>(random.bits() % 40);
          const int height = 1 + static_cast<int>(random.bits() % 30);
          const PngKind kind{depth, color, interlaced, transparent};
          const auto file = folder.write("a.png", png(random, kind, width, height));
          expect_same(file, "color " + std::to_string(color) + ", depth " + std::to_string(depth) +
                                (interlaced ? ", interlaced" : "") +
                                (transparent ? ", transparent" : ""));
        }
}

/// Random values, as OpenImageIO writes them.
std::filesystem::path foreign(const TemporaryFolder& folder, const std::string& name,
                              OIIO::ImageSpec spec, Random& random) {
  const auto file = folder.path() / name;
  const auto output = OIIO::ImageOutput::create(file.string());
  std::vector<float> pixels(static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
  for (float& value : pixels) value = static_cast<float>(random.uniform(0.0, 1.0));
  EXPECT_TRUE(output && output->open(file.string(), spec) &&
              output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && output->close())
      << name;
  return file;
}

TEST(ImageFormats, JpegsAreReadAsAnotherReaderReadsThem) {
  const TemporaryFolder folder;
  Random random(12);
  for (const int channels : {1, 3})
    for (const char* quality : {"jpeg:40", "jpeg:95"})
      for (const char* subsampling : {"4:4:4", "4:2:2", "4:2:0"}) {
        OIIO::ImageSpec spec(37, 29, channels, OIIO::TypeDesc::UINT8);
        spec.attribute("Compression", quality);
        spec.attribute("jpeg:subsampling", subsampling);
        expect_same(foreign(folder, "a.jpg", spec, random),
                    std::to_string(channels) + " channels, " + subsampling);
      }
}

TEST(ImageFormats, EveryKindOfExrIsReadAsAnotherReaderReadsIt) {
  const TemporaryFolder folder;
  Random random(13);
  const std::vector<std::vector<std::string>> names = {
      {"Y"},
      {"R", "G", "B"},
      {"R", "G", "B", "A"},
      {"beauty.R", "beauty.G", "beauty.B", "Z", "N.x"}};
  for (const char* packing : {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "dwaa"})
    for (const OIIO::TypeDesc type : {OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT})
      for (const int tile : {0, 16})
        for (const auto& channels : names) {
          OIIO::ImageSpec spec(37, 41, static_cast<int>(channels.size()), type);
          spec.channelnames = channels;
          spec.tile_width = spec.tile_height = tile;
          spec.attribute("compression", packing);
          expect_same(foreign(folder, "a.exr", spec, random),
                      std::string(packing) + (tile > 0 ? ", tiles" : ""));
        }
}

TEST(ImageFormats, TilesMayBeLargerThanTheirPicture) {
  const TemporaryFolder folder;
  Random random(16);
  for (const char* packing : {"none", "zip"}) {
    OIIO::ImageSpec spec(37, 41, 3, OIIO::TypeDesc::HALF);
    spec.tile_width = spec.tile_height = 1024;
    spec.attribute("compression", packing);
    expect_same(foreign(folder, "a.exr", spec, random), packing);
  }
}

/// Bytes too many before a marker are harmless; what is wrong behind them is not.
TEST(ImageFormats, JpegsThatEndTooEarlyOrBreakBehindAWarningAreRefused) {
  const TemporaryFolder folder;
  Random random(14);
  OIIO::ImageSpec spec(64, 64, 3, OIIO::TypeDesc::UINT8);
  const std::string sound = TemporaryFolder::read(foreign(folder, "a.jpg", spec, random));
  const std::size_t scan = sound.find("\xff\xda");
  ASSERT_NE(scan, std::string::npos);
  const std::string stray = sound.substr(0, scan) + "\x12\x34" + sound.substr(scan);
  Faults faults;
  EXPECT_TRUE(read_image(folder.write("b.jpg", stray), {}, faults));
  const std::size_t half = scan + (stray.size() - scan) / 2;
  EXPECT_NE(refusal_of_image(folder.write("c.jpg", stray.substr(0, half))).find("cut off"),
            std::string::npos);
  EXPECT_NE(refusal_of_image(folder.write("d.jpg", sound.substr(0, half) + "\xff\xd9")), "");
  std::string other_table = stray;
  other_table[other_table.find("\xff\xda") + 6] = '\x33';
  EXPECT_NE(refusal_of_image(folder.write("e.jpg", other_table)), "");
}

TEST(ImageFormats, JpegsOfRareSubsamplingAreRefusedAsSuch) {
  const TemporaryFolder folder;
  Random random(17);
  OIIO::ImageSpec spec(64, 64, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("jpeg:subsampling", "4:2:0");
  std::string rare = TemporaryFolder::read(foreign(folder, "a.jpg", spec, random));
  const std::size_t frame = rare.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  ASSERT_EQ(rare[frame + 11], '\x22');
  rare[frame + 11] = '\x31';
  EXPECT_NE(refusal_of_image(folder.write("b.jpg", rare)).find("subsampling of colours"),
            std::string::npos);
}

TEST(ImageFormats, GrayWithOtherChannelsIsGray) {
  const TemporaryFolder folder;
  Random random(15);
  OIIO::ImageSpec spec(5, 4, 3, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"Y", "A", "Z"};
  const auto file = foreign(folder, "a.exr", spec, random);
  Faults faults;
  const auto image = read_image(file, {}, faults);
  ASSERT_TRUE(image);
  const auto expected = read_otherwise(file).at("Y");
  for (std::size_t i = 0; i < image->pixels.size(); ++i)
    EXPECT_EQ(image->pixels[i], expected[i / 3]);
  spec.channelnames = {"BY", "RY", "Y"};
  EXPECT_NE(refusal_of_image(foreign(folder, "b.exr", spec, random)).find("luminance"),
            std::string::npos);
}

TEST(ImageFormats, ColoursOfALayerKeepTheirOrder) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(2, 1, 3, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"beauty.R", "beauty.G", "beauty.B"};
  const auto file = folder.path() / "a.exr";
  const auto output = OIIO::ImageOutput::create(file.string());
  const std::vector<float> pixels = {0.25F, 0.5F, 0.75F, 1.0F, 2.0F, 3.0F};
  ASSERT_TRUE(output && output->open(file.string(), spec) &&
              output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && output->close());
  Faults faults;
  const auto image = read_image(file, {}, faults);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->pixels, pixels);
}

}  // namespace
}  // namespace portalens::test
