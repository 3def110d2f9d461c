/// \file
/// Pictures that the program has written.
#pragma once

#include <gtest/gtest.h>

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

}  // namespace portalens
