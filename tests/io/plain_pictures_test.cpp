// What is written without a library, held against those that read and sum it.
#include "io/plain_pictures.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "io/checksums.h"
#include "io/exr_matrix.h"
#include "io/exr_texts.h"
#include "io/image_encode.h"
#include "support/scene_folder.h"

namespace portalens {
namespace {

std::string noise(std::size_t length) {
  std::string bytes;
  std::uint32_t state = 1;
  while (bytes.size() < length) bytes += static_cast<char>((state = state * 1664525 + 1) >> 24);
  return bytes;
}

TEST(Checksums, AreThoseOfZlib) {
  for (const std::size_t length : {0, 1, 7, 8, 9, 63, 5552, 5553, 100003}) {
    const std::string bytes = noise(length), most(length, '\xff');
    for (const std::string& text : {bytes, most}) {
      const auto* data = reinterpret_cast<const Bytef*>(text.data());
      EXPECT_EQ(crc32(std::string_view(text)), ::crc32_z(0, data, length)) << length;
      EXPECT_EQ(adler32(std::string_view(text)), ::adler32_z(1, data, length)) << length;
      const std::string_view all(text);
      EXPECT_EQ(adler32(all.substr(length / 3), adler32(all.substr(0, length / 3))), adler32(all));
    }
  }
}

/// 301 x 77: more than one stored block.
struct Sample {
  int width = 301, height = 77;
  std::vector<Channel> channels;
  std::vector<ChannelView> views;
  Metadata metadata{{"Comment", "without a library"},
                    {"portalens:a name of more than 31 letters", "is a long one"},
                    {"worldToCamera", "1 0 0 0 0 0.25 -1e-07 0 0 0.5 3 0 -4 5 6.1 1"}};

  Sample() {
    for (const char* name : {"R", "G", "B", "depth.Z"}) {
      Channel& channel = channels.emplace_back();
      channel.name = name;
      for (int i = 0; i < width * height; ++i)
        channel.values.push_back(
            std::fabs(std::sin(0.01f * static_cast<float>(i * channels.size()))));
    }
    for (const Channel& channel : channels) views.push_back({channel.name, channel.values});
  }
  [[nodiscard]] EncodedPicture picture(const std::filesystem::path& file) const {
    return {file, width, height, views, metadata, Packing::small};
  }
};

std::string text_of(const std::vector<unsigned char>& bytes) {
  return {bytes.begin(), bytes.end()};
}

TEST(PlainPictures, AnExrIsReadBackToTheBit) {
  const SceneFolder folder;
  const Sample sample;
  const auto file = folder.write("plain.exr", text_of(plain_exr(sample.picture("plain.exr"))));
  Faults faults;
  const auto back = read_channels(file, {}, faults);
  faults.raise();
  ASSERT_TRUE(back);
  EXPECT_EQ(back->width, sample.width);
  EXPECT_EQ(back->height, sample.height);
  ASSERT_EQ(back->channels.size(), sample.channels.size());
  for (const Channel& channel : sample.channels) {
    const auto found = std::find_if(back->channels.begin(), back->channels.end(),
                                    [&](const Channel& one) { return one.name == channel.name; });
    ASSERT_NE(found, back->channels.end()) << channel.name;
    EXPECT_EQ(found->values, channel.values) << channel.name;
  }
}

TEST(PlainPictures, TheHeaderOfAnExrIsReadBackWhoeverWroteIt) {
  const SceneFolder folder;
  const Sample sample;
  for (const auto& bytes :
       {plain_exr(sample.picture("a.exr")), encode_exr(sample.picture("a.exr"))}) {
    const Metadata back = read_exr_texts(folder.write("a.exr", text_of(bytes)));
    for (const auto& entry : sample.metadata)
      EXPECT_NE(std::find(back.begin(), back.end(), entry), back.end()) << entry.first;
  }
  EXPECT_FALSE(matrix_in("1 2 3"));
  EXPECT_FALSE(matrix_in("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0"));
  EXPECT_FALSE(matrix_in("1 0 0 0 0 one 0 0 0 0 1 0 0 0 0 1"));
}

TEST(PlainPictures, APngIsReadBackAsTheLibrarysOwnIs) {
  const SceneFolder folder;
  const Sample sample;
  const EncodedPicture picture = sample.picture("plain.png");
  const auto plain = folder.write("plain.png", text_of(plain_png(picture)));
  const auto packed = folder.write("packed.png", text_of(encode_png(picture)));
  Faults faults;
  const auto a = read_image(plain, {}, faults), b = read_image(packed, {}, faults);
  faults.raise();
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->width, sample.width);
  EXPECT_EQ(a->pixels, b->pixels);
}

}  // namespace
}  // namespace portalens
