// A picture comes back as it was written, the same bits every time, and a broken one is refused.
#include "io/image.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "io/image_bytes.h"
#include "io/srgb_bytes.h"
#include "math/srgb.h"
#include "support/pictures.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/temporary_folder.h"

namespace portalens::test {
namespace {

constexpr int width = 37, height = 21;

std::vector<Channel> channels_of(std::initializer_list<const char*> names) {
  Random random(7);
  std::vector<Channel> channels;
  for (const char* name : names) {
    channels.push_back({name, {}});
    for (int i = 0; i < width * height; ++i)
      channels.back().values.push_back(static_cast<float>(random.uniform(0.0, 1.0)));
  }
  return channels;
}

std::optional<Image> read(const std::filesystem::path& file) {
  Faults faults;
  auto image = read_image(file, {}, faults);
  EXPECT_EQ(image.has_value(), faults.empty()) << file;
  return image;
}

/// A file as other programs write it.
std::filesystem::path foreign(const TemporaryFolder& folder, const std::string& name, int channels,
                              OIIO::TypeDesc type, float value) {
  const auto file = folder.path() / name;
  OIIO::ImageSpec spec(width, height, channels, type);
  spec.attribute("ImageDescription", "a picture");
  spec.attribute("Artist", "somebody");
  const std::vector<float> pixels(static_cast<std::size_t>(width * height * channels), value);
  const auto output = OIIO::ImageOutput::create(file.string());
  EXPECT_TRUE(output && output->open(file.string(), spec) &&
              output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && output->close());
  return file;
}

TEST(ImageFile, AnExrComesBackBitForBit) {
  const TemporaryFolder folder;
  const auto channels = channels_of({"R", "G", "B", "depth.Z", "normal.X", "A.first"});
  write_image(folder.path() / "a.exr", width, height, channels, {{"portalens", "1"}});
  const auto image = read(folder.path() / "a.exr");
  ASSERT_TRUE(image);
  ASSERT_EQ(image->width, width);
  ASSERT_EQ(image->height, height);
  for (int i = 0; i < width * height; ++i) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(image->pixels[static_cast<std::size_t>(3 * i + c)],
                channels[static_cast<std::size_t>(c)].values[static_cast<std::size_t>(i)]);
    }
  }
}

TEST(ImageFile, EveryNamedChannelAndTheMetadataAreInTheExr) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.exr";
  const auto channels = channels_of({"R", "G", "B", "depth.Z", "normal.X"});
  write_image(file, width, height, channels, {{"command", "render a.toml"}});
  const auto input = OIIO::ImageInput::open(file.string());
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().get_string_attribute("command"), "render a.toml");
  for (const Channel& channel : channels) {
    const int index = input->spec().channelindex(channel.name);
    ASSERT_GE(index, 0) << channel.name;
    std::vector<float> plane(channel.values.size());
    ASSERT_TRUE(input->read_image(0, 0, index, index + 1, OIIO::TypeDesc::FLOAT, plane.data()));
    EXPECT_EQ(plane, channel.values) << channel.name;
  }
}

TEST(ImageFile, APngComesBackToHalfAStep) {
  const TemporaryFolder folder;
  const auto channels = channels_of({"B", "other", "R", "G"});
  write_image(folder.path() / "a.png", width, height, channels, {});
  const auto image = read(folder.path() / "a.png");
  ASSERT_TRUE(image);
  const std::size_t place[] = {2, 3, 0};
  for (std::size_t i = 0; i < image->pixels.size(); ++i) {
    const double written = srgb_from_linear(double{channels[place[i % 3]].values[i / 3]});
    EXPECT_NEAR(srgb_from_linear(double{image->pixels[i]}), written, 0.5 / 255 + 1e-6);
  }
}

TEST(ImageFile, ThePngHoldsTheSrgbBytesOfKnownColors) {
  const TemporaryFolder folder;
  const std::vector<Channel> channels{
      {"R", {0.0F, 0.5F}}, {"G", {0.2158605F, 7.0F}}, {"B", {1.0F, -3.0F}}};
  write_image(folder.path() / "a.png", 2, 1, channels, {});
  const auto input = OIIO::ImageInput::open((folder.path() / "a.png").string());
  unsigned char bytes[6] = {};
  ASSERT_TRUE(input && input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, bytes));
  const unsigned char expected[] = {0, 128, 255, 188, 255, 0};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(bytes[i], expected[i]) << i;
}

TEST(ImageFile, TheSamePictureIsTheSameBytes) {
  const TemporaryFolder folder;
  const auto channels = channels_of({"R", "G", "B"});
  for (const char* name : {"a.exr", "b.exr", "a.png", "b.png"}) {
    write_image(folder.path() / name, width, height, channels, {});
  }
  EXPECT_EQ(folder.read(folder.path() / "a.exr"), folder.read(folder.path() / "b.exr"));
  EXPECT_EQ(folder.read(folder.path() / "a.png"), folder.read(folder.path() / "b.png"));
  EXPECT_EQ(folder.read(folder.path() / "a.exr").find("2025"), std::string::npos);
}

TEST(ImageFile, PackedQuicklyItHoldsTheSameNumbers) {
  const TemporaryFolder folder;
  const auto channels = channels_of({"R", "G", "B", "depth.Z"});
  std::vector<float> colors;
  for (std::size_t i = 0; i < channels[0].values.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) colors.push_back(channels[c].values[i]);
  const std::span<const float> all(colors);
  const std::vector<ChannelView> views = {{"R", all, 3},
                                          {"G", all.subspan(1), 3},
                                          {"B", all.subspan(2), 3},
                                          {"depth.Z", channels[3].values}};
  for (const char* kind : {".exr", ".png"}) {
    const auto small = folder.path() / ("small" + std::string(kind));
    const auto quick = folder.path() / ("quick" + std::string(kind));
    write_image(small, width, height, channels, {});
    write_views(quick, width, height, views, {}, Packing::quick);
    const auto expected = OIIO::ImageInput::open(small.string());
    const auto found = OIIO::ImageInput::open(quick.string());
    ASSERT_TRUE(expected && found) << kind;
    EXPECT_EQ(found->spec().channelnames, expected->spec().channelnames);
    const auto values_of = [](OIIO::ImageInput& input) {
      std::vector<float> values(input.spec().image_pixels() *
                                static_cast<std::size_t>(input.spec().nchannels));
      EXPECT_TRUE(
          input.read_image(0, 0, 0, input.spec().nchannels, OIIO::TypeDesc::FLOAT, values.data()));
      return values;
    };
    EXPECT_EQ(values_of(*found), values_of(*expected)) << kind;
  }
}

TEST(ImageFile, EveryLinearValueGetsTheByteThatTheCurveRoundsTo) {
  const SrgbBytes byte_of;
  const auto expect_exact = [&](float value) {
    const double held = std::clamp(double{value}, 0.0, 1.0);
    EXPECT_EQ(byte_of(value), std::lround(255.0 * srgb_from_linear(held))) << value;
  };
  for (int byte = 1; byte < 256; ++byte) {
    const float least = byte_of.least(static_cast<std::uint8_t>(byte));
    for (const float value : {std::nextafter(least, 0.0F), least, std::nextafter(least, 2.0F)})
      expect_exact(value);
  }
  Random random(11);
  for (int i = 0; i < scaled(100000); ++i) {
    expect_exact(static_cast<float>(random.uniform(-0.1, 1.1)));
    expect_exact(static_cast<float>(std::exp(random.uniform(-100.0, 0.0))));
  }
  for (const float value : {0.0F, -0.0F, 1.0F, std::numeric_limits<float>::max(),
                            std::numeric_limits<float>::denorm_min()})
    expect_exact(value);
}

TEST(ImageFile, TheTransferCurveIsItsOwnInverse) {
  for (int i = 0; i <= 1000; ++i) {
    const double x = i / 1000.0;
    EXPECT_NEAR(linear_from_srgb(srgb_from_linear(x)), x, 1e-7);
  }
}

TEST(ImageFile, GrayAndTransparentPicturesGiveThreeChannels) {
  const TemporaryFolder folder;
  for (const int channels : {1, 2, 3, 4}) {
    for (const char* kind : {".png", ".exr", ".jpg", ".hdr"}) {
      const std::string suffix = kind;
      if ((suffix == ".jpg" && channels % 2 == 0) || (suffix == ".hdr" && channels != 3)) continue;
      const auto type =
          suffix == ".exr" || suffix == ".hdr" ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
      const auto file = foreign(folder, std::to_string(channels) + suffix, channels, type, 0.5F);
      const auto image = read(file);
      ASSERT_TRUE(image) << file;
      EXPECT_EQ(image->channels, 3);
      const double expected = type == OIIO::TypeDesc::FLOAT ? 0.5 : linear_from_srgb(128 / 255.0);
      for (const float value : image->pixels) {
        // Transparent colour is stored multiplied or not, as the writer had it.
        if (channels == 4 && suffix == ".png") continue;
        if (channels == 2 && suffix == ".png") continue;
        ASSERT_NEAR(value, expected, 0.01) << file;
      }
    }
  }
}

TEST(ImageFile, TheKindIsToldByTheBytesNotByTheName) {
  const TemporaryFolder folder;
  const auto exr = foreign(folder, "a.exr", 3, OIIO::TypeDesc::FLOAT, 0.5F);
  std::filesystem::rename(exr, folder.path() / "a.png");
  EXPECT_TRUE(read(folder.path() / "a.png"));
  for (const auto& [name, kind] :
       {std::pair{"a.tif", "is TIFF; EXR"}, {"a.bmp", "is BMP; EXR"}, {"a.ppm", "is PPM; EXR"}}) {
    const auto told = refusal_of_image(foreign(folder, name, 3, OIIO::TypeDesc::UINT8, 0.5F));
    EXPECT_NE(told.find(kind), std::string::npos) << told;
  }
  EXPECT_NE(refusal_of_image(folder.write("empty.png", "")).find("no known kind"),
            std::string::npos);
}

TEST(ImageFile, ValuesThatAreNotFiniteAreRefused) {
  const TemporaryFolder folder;
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    EXPECT_NE(
        refusal_of_image(foreign(folder, "a.exr", 3, OIIO::TypeDesc::FLOAT, bad)).find("(0, 0)"),
        std::string::npos);
  }
  auto channels = channels_of({"R", "G", "B"});
  channels[1].values[width + 2] = std::numeric_limits<float>::quiet_NaN();
  try {
    write_image(folder.path() / "b.exr", width, height, channels, {});
    FAIL();
  } catch (const WorkError& error) {
    EXPECT_NE(std::string(error.what()).find("(2, 1)"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.exr"));
}

TEST(ImageFile, AHugeHeaderIsRefusedBeforeAnythingIsAllocated) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal_of_image(folder.write("a.hdr",
                                          "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n"
                                          "-Y 1000000000 +X 1000000000\n"))
                .find("16384"),
            std::string::npos);
  auto png = TemporaryFolder::read(foreign(folder, "a.png", 3, OIIO::TypeDesc::UINT8, 0.5F));
  png.replace(16, 8, std::string("\x00\x10\x00\x00\x00\x10\x00\x00", 8));  // its checksum is wrong
  EXPECT_NE(refusal_of_image(folder.write("b.png", png)), "");
}

TEST(ImageFile, DescriptionsAreLeftOutAndThePictureIsNot) {
  const TemporaryFolder folder;
  for (const char* name : {"a.jpg", "a.png"}) {
    const auto bytes = TemporaryFolder::read(foreign(folder, name, 3, OIIO::TypeDesc::UINT8, 0.5F));
    ASSERT_NE(bytes.find("somebody"), std::string::npos) << name;
    const auto bare = without_descriptions(bytes, *image_format(bytes));
    ASSERT_TRUE(bare) << name;
    EXPECT_EQ(bare->find("somebody"), std::string::npos) << name;
    EXPECT_EQ(read(folder.write(name, *bare))->pixels, read(folder.write(name, bytes))->pixels);
  }
}

/// A PNG with every checksum made right again, so that damage reaches the decoder behind them.
std::string with_new_checksums(std::string png) {
  for (std::size_t at = 8; at + 12 <= png.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      length = length << 8 | static_cast<unsigned char>(png[at + i]);
    }
    if (length > png.size() - at - 12) break;
    const auto* named = reinterpret_cast<const Bytef*>(png.data()) + at + 4;
    const auto checksum = crc32_z(0, named, 4 + length);
    for (std::size_t i = 0; i < 4; ++i) {
      png[at + 8 + length + i] = static_cast<char>(checksum >> (24 - 8 * i));
    }
    at += 12 + length;
  }
  return png;
}

TEST(ImageFile, DamageNeverCrashesTheReader) {
  const TemporaryFolder folder;
  Random random(11);
  for (const char* name : {"a.png", "a.jpg", "a.exr", "a.hdr"}) {
    const std::string suffix = name;
    const auto type =
        suffix == "a.exr" || suffix == "a.hdr" ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
    const auto bytes = TemporaryFolder::read(foreign(folder, name, 3, type, 0.25F));
    for (int trial = 0; trial < scaled(150); ++trial) {
      std::string damaged = bytes;
      for (int i = 0; i < 1 + trial % 5; ++i) {
        damaged[random.bits() % damaged.size()] = static_cast<char>(random.bits());
      }
      if (trial % 3 == 0) damaged.resize(random.bits() % damaged.size());
      static_cast<void>(read(folder.write("damaged", damaged)));
      if (suffix == "a.png") {
        static_cast<void>(read(folder.write("damaged", with_new_checksums(damaged))));
      }
    }
  }
}

TEST(ImageFile, WhatCannotBeWrittenIsToldBeforehand) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(check_writable(folder.path() / "a.exr"));
  EXPECT_NO_THROW(check_writable(folder.path() / "a.PNG"));
  EXPECT_THROW(check_writable(folder.path() / "a.bmp"), SceneError);
  EXPECT_THROW(check_writable(folder.path() / "a"), SceneError);
  EXPECT_THROW(check_writable(folder.path() / "nofolder/a.exr"), WorkError);
  std::filesystem::create_directory(folder.path() / "b.exr");
  EXPECT_THROW(check_writable(folder.path() / "b.exr"), WorkError);
  const auto channels = channels_of({"R", "G"});
  EXPECT_THROW(write_image(folder.path() / "a.png", width, height, channels, {}), WorkError);
  EXPECT_THROW(write_image(folder.path() / "a.exr", width, 2 * height, channels, {}), WorkError);
  EXPECT_THROW(write_image(folder.path() / "a.exr", 0, 0, {}, {}), WorkError);
}

TEST(ImageFile, KindsThatAreNotReadAreNamed) {
  using namespace std::string_literals;
  const TemporaryFolder folder;
  for (const auto& [bytes, kind] : {std::pair{"BM\x36\0\0\0"s, "is BMP; "},
                                    {"II*\0\x08"s, "is TIFF; "},
                                    {"RIFF\x24\0\0\0WEBPVP8 "s, "is WebP; "},
                                    {"\0\0\x02\0 TRUEVISION-XFILE.\0"s, "is TGA; "},
                                    {"nothing"s, "is of no known kind; "},
                                    {"B"s, "is of no known kind; "}}) {
    Faults faults;
    EXPECT_FALSE(read_image(folder.write("picture", bytes), {}, faults));
    try {
      faults.raise();
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(kind), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace portalens::test
