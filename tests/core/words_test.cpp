// A slip is met with the word that was meant.
#include "core/words.h"

#include <gtest/gtest.h>

namespace portalens::test {
namespace {

const std::vector<std::string>& every_key() {
  static const std::vector<std::string> keys{
      "type",        "position",       "look_at",      "up",          "fov",       "samples",
      "max_bounces", "center",         "radius",       "diffuse",     "emitted",   "reflective",
      "width",       "center_of_mass", "integrator",   "tint",        "translate", "rotation",
      "vertices",    "pair",           "inner_radius", "outer_radius"};
  return keys;
}

TEST(Suggestion, WordsOfOtherRenderersAreUnderstood) {
  const std::pair<const char*, const char*> cases[] = {
      {"max_depth", "max_bounces"}, {"spp", "samples"},          {"centre", "center"},
      {"eye", "position"},          {"origin", "position"},      {"target", "look_at"},
      {"albedo", "diffuse"},        {"colour", "diffuse"},       {"radiance", "emitted"},
      {"emission", "emitted"},      {"mirror", "reflective"},    {"specular", "reflective"},
      {"resolution", "width"},      {"maxDepth", "max_bounces"}, {"lookat", "look_at"}};
  for (const auto& [said, meant] : cases) EXPECT_EQ(suggestion(said, every_key()), meant) << said;
}

TEST(Suggestion, EveryOneSlipOfAKeyFindsAKey) {
  for (const std::string& key : every_key()) {
    if (key.size() < 4) continue;
    for (std::size_t i = 0; i + 1 < key.size(); ++i) {
      std::string left_out = key, swapped = key, doubled = key;
      left_out.erase(i, 1);
      std::swap(swapped[i], swapped[i + 1]);
      doubled.insert(i, 1, key[i]);
      EXPECT_EQ(suggestion(doubled, every_key()), key);
      EXPECT_EQ(suggestion(swapped, every_key()), key);
      EXPECT_NE(suggestion(left_out, every_key()), "");
    }
  }
}

TEST(Suggestion, AWordThatIsNearNothingFindsNothing) {
  EXPECT_EQ(suggestion("qqqqqqqq", every_key()), "");
  EXPECT_EQ(suggestion("", every_key()), "");
  EXPECT_EQ(suggestion(std::string(100000, 'a'), every_key()), "");
  EXPECT_EQ(suggestion("radius", {}), "");
}

TEST(Suggestion, OnlyKnownWordsAreSuggested) {
  EXPECT_EQ(suggestion("spp", {"radius"}), "");
  EXPECT_EQ(suggestion("origin", {"center"}), "center");
  EXPECT_EQ(suggestion("origin", {"base"}), "base");
}

TEST(Quotes, NothingUnprintableAndNothingEndlessIsPrinted) {
  EXPECT_EQ(in_quotes("a\x1b[31m\n"), "'a?[31m?'");
  EXPECT_LT(in_quotes(std::string(1000000, 'x')).size(), 100U);
  EXPECT_LT(listed(std::vector<std::string>(1000000, "x")).size(), 1000U);
}

}  // namespace
}  // namespace portalens::test
