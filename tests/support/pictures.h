/// \file
/// Pictures that the program has written, and those that it must not take.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/image.h"
#include "support/scene_folder.h"

namespace portalens {

inline Image picture_in(const SceneFolder& folder, const std::string& name) {
  Faults faults;
  auto image = read_image(folder.path() / name, Location{}, faults);
  EXPECT_TRUE(image) << name;
  return image.value_or(Image{});
}

/// What a reader says of an image that it must not take; "" where it takes it.
inline std::string refusal_of_image(const std::filesystem::path& file) {
  Faults faults;
  EXPECT_FALSE(read_image(file, {}, faults)) << file;
  try {
    faults.raise();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace portalens
