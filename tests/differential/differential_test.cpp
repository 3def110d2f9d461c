// The random scenes of the differential program, and a share of what it does.
#include <gtest/gtest.h>

#include <set>

#include "core/error.h"
#include "differential/compare.h"
#include "differential/random_scene.h"
#include "support/scale.h"

namespace portalens::differential {
namespace {

TEST(RandomScene, DependsOnItsSeedAndIndexOnly) {
  std::set<std::string> texts;
  for (std::uint64_t index = 0; index < 20; ++index) {
    const std::string text = to_toml(random_scene(3, index), "");
    EXPECT_EQ(text, to_toml(random_scene(3, index), ""));
    texts.insert(text);
    texts.insert(to_toml(random_scene(4, index), ""));
  }
  EXPECT_EQ(texts.size(), 40u);
}

TEST(RandomScene, IsOneThatTheProgramTakes) {
  const int count = test::scaled(300);
  for (int index = 0; index < count; ++index) {
    const Draft draft = random_scene(1, static_cast<std::uint64_t>(index));
    const SceneFolder folder;
    try {
      (void)set_up(draft, folder);
    } catch (const SceneError& error) {
      ADD_FAILURE() << index << ": " << error.what();
    }
  }
}

}  // namespace
}  // namespace portalens::differential
