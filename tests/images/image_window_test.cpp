// An EXR's display window is its picture, wherever its pixels lie.
#include "io/image_window.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/image.h"
#include "support/temporary_folder.h"

namespace portalens::test {
namespace {

/// A pixel's red tells its place in the plane in which both windows lie; green and blue are 1.
float value_at(std::int64_t x, std::int64_t y) { return static_cast<float>(100 * y + x + 2000); }

enum class Storage { lines, tiles };

std::filesystem::path exr(const TemporaryFolder& folder, const PixelWindow& data,
                          const PixelWindow& display, Storage storage) {
  const auto file = folder.path() / "a.exr";
  OIIO::ImageSpec spec(data.width, data.height, 3, OIIO::TypeDesc::FLOAT);
  spec.x = static_cast<int>(data.x);
  spec.y = static_cast<int>(data.y);
  spec.full_x = static_cast<int>(display.x);
  spec.full_y = static_cast<int>(display.y);
  spec.full_width = display.width;
  spec.full_height = display.height;
  if (storage == Storage::tiles) spec.tile_width = spec.tile_height = 16;
  std::vector<float> pixels;
  for (int y = 0; y < data.height; ++y)
    for (int x = 0; x < data.width; ++x)
      for (const float value : {value_at(data.x + x, data.y + y), 1.0F, 1.0F})
        pixels.push_back(value);
  const auto output = OIIO::ImageOutput::create(file.string());
  EXPECT_TRUE(output && output->open(file.string(), spec) &&
              output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && output->close());
  return file;
}

bool within(const PixelWindow& window, std::int64_t x, std::int64_t y) {
  return x >= window.x && x < window.x + window.width && y >= window.y &&
         y < window.y + window.height;
}

TEST(ImageWindow, OutsideTheDataWindowIsBlackAndBeyondTheDisplayWindowIsCut) {
  const TemporaryFolder folder;
  const PixelWindow display{-3, 5, 21, 13};
  const PixelWindow data[] = {display,        {0, 7, 4, 5},   {-20, -10, 80, 60}, {-9, 0, 12, 30},
                              {17, 17, 9, 9}, {-7, 9, 60, 2}, {-4, 4, 2, 2}};
  for (const PixelWindow& window : data)
    for (const Storage storage : {Storage::lines, Storage::tiles}) {
      const auto file = exr(folder, window, display, storage);
      Faults faults;
      const auto image = read_image(file, {}, faults);
      const auto picture = read_channels(file, {}, faults);
      faults.raise();
      ASSERT_TRUE(image && picture);
      ASSERT_EQ(image->width, display.width);
      ASSERT_EQ(image->height, display.height);
      ASSERT_EQ(picture->width, display.width);
      ASSERT_EQ(picture->channels[0].name, "R");
      std::size_t i = 0;
      for (int y = 0; y < display.height; ++y)
        for (int x = 0; x < display.width; ++x, ++i) {
          const bool there = within(window, display.x + x, display.y + y);
          const float expected = there ? value_at(display.x + x, display.y + y) : 0.0F;
          EXPECT_EQ(image->at(x, y)[0], expected) << x << ' ' << y;
          EXPECT_EQ(image->at(x, y)[2], there ? 1.0F : 0.0F) << x << ' ' << y;
          EXPECT_EQ(picture->channels[0].values[i], expected) << x << ' ' << y;
        }
    }
}

std::string refusal_by_both(const std::filesystem::path& file) {
  Faults faults;
  EXPECT_FALSE(read_image(file, {}, faults));
  EXPECT_FALSE(read_channels(file, {}, faults));
  try {
    faults.raise();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(ImageWindow, APictureThatShowsNothingIsRefused) {
  const TemporaryFolder folder;
  for (const PixelWindow& data :
       {PixelWindow{10, 0, 5, 5}, PixelWindow{0, -5, 5, 5}, PixelWindow{-9, -9, 5, 5}}) {
    const auto file = exr(folder, data, {0, 0, 10, 10}, Storage::lines);
    EXPECT_NE(refusal_by_both(file).find("outside its display window"), std::string::npos);
  }
}

TEST(ImageWindow, AVastDisplayWindowIsRefusedBeforeMemoryIsTaken) {
  const TemporaryFolder folder;
  const auto few = exr(folder, {0, 0, 4, 4}, {0, 0, 16384, 8192}, Storage::lines);
  EXPECT_NE(refusal_by_both(few).find("can hold"), std::string::npos);
  const auto wide = exr(folder, {0, 0, 4, 4}, {0, 0, 20000, 4}, Storage::lines);
  EXPECT_NE(refusal_by_both(wide).find("20000 x 4"), std::string::npos);
}

}  // namespace
}  // namespace portalens::test
