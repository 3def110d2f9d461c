// A share of what the differential program does (docs/differential.md), and what it has found.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "differential/find.h"
#include "differential/minimise.h"
#include "differential/picture.h"
#include "differential/pieces.h"
#include "differential/random_scene.h"
#include "differential/table.h"
#include "support/scale.h"

namespace portalens::differential {
namespace {

/// What stands in the reasons why lanes do not take a scene.
constexpr const char* not_yet_in_lanes[] = {"is an ellipse", "goes through portals on more than"};

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

/// The first scenes of a seed that are as `wanted`, few photons each.
template <class Wanted>
Tally tally_of(std::uint64_t seed, int count, const Wanted& wanted) {
  Tally tally;
  for (std::uint64_t index = 0; tally.scenes < static_cast<std::uint64_t>(count); ++index) {
    Draft draft = random_scene(seed, index);
    if (!wanted(draft)) continue;
    draft.width = 18;
    draft.height = 12;
    const SceneFolder folder;
    try {
      tally.add(compare(set_up(draft, folder)));
    } catch (const SceneError&) {
      tally.add({});
    }
  }
  return tally;
}

/// So many of a hundred scenes may be refused, and as many more be left to the scalar engine: the
/// scenes are for the lanes.
constexpr double few = 0.05;

TEST(RandomScenes, AreTakenInLanesWithFewExceptions) {
  const Tally tally = tally_of(11, test::scaled(60), [](const Draft&) { return true; });
  const auto scenes = static_cast<double>(tally.scenes);
  std::uint64_t refused = 0;
  for (const auto& [reason, count] : tally.refused) refused += count;
  EXPECT_LE(static_cast<double>(refused), few * scenes + 1);
  EXPECT_GE(static_cast<double>(tally.lanes.scenes), (1.0 - 2.0 * few) * scenes - 2);
  EXPECT_EQ(tally.timed_out, 0u);
}

/// Whoever teaches lanes one of these takes it from the list.
TEST(RandomScenes, AreLeftToTheScalarEngineForKnownReasonsOnly) {
  const auto is_known = [](const std::string& reason) {
    return std::any_of(std::begin(not_yet_in_lanes), std::end(not_yet_in_lanes),
                       [&](const char* known) { return reason.find(known) != std::string::npos; });
  };
  for (std::uint64_t index = 0; index < static_cast<std::uint64_t>(test::scaled(600)); ++index) {
    const SceneFolder folder;
    try {
      const PlannedSpace& space = set_up(random_scene(15, index), folder).own.space;
      EXPECT_TRUE(space.lanes || is_known(space.no_lanes_because)) << space.no_lanes_because;
    } catch (const SceneError&) {
      continue;  // how many are refused is held above
    }
  }
}

/// No row above its share, but that a few may be by chance.
void expect_at_most(const Sums& sums, const std::vector<double>& shares) {
  const std::vector<Row> rows = rows_of(sums);
  ASSERT_EQ(rows.size(), shares.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_LE(static_cast<double>(rows[i].count), shares[i] * static_cast<double>(rows[i].of) + 3)
        << rows[i].name;
}

/// What the rows come to today, generously: whoever makes an engine more exact lowers these.
TEST(RandomScenes, LeaveTheEnginesNoFartherFromTheReferenceThanIsKnown) {
  const Tally tally =
      tally_of(12, test::scaled(60), [](const Draft& draft) { return !is_room(draft); });
  expect_at_most(tally.lanes, {2e-4, 5e-3, 5e-4, 1e-4, 0.05, 1e-4, 1e-4});
  expect_at_most(tally.scalar, {1e-4, 2e-3, 3e-4, 5e-5, 0.03, 1e-5, 5e-5});
}

TEST(RandomRooms, LeaveTheEnginesNearTheReference) {
  const Tally tally = tally_of(13, test::scaled(12), is_room);
  expect_at_most(tally.lanes, {8e-4, 8e-4, 6e-4, 4e-5, 0.05, 3e-4, 6e-4});
  expect_at_most(tally.scalar, {8e-4, 8e-4, 6e-4, 4e-5, 0.05, 3e-4, 6e-4});
}

TEST(RandomPictures, ShowNothingThatNoPhotonAboutItFound) {
  for (int index = 0; index < test::scaled(4); ++index) {
    Draft draft = random_picture(14, static_cast<std::uint64_t>(index));
    draft.width = 160;
    draft.height = 90;
    const SceneFolder folder;
    EXPECT_EQ(compare_pictures(set_up(draft, folder)).strangers, 0u) << index;
  }
}

PictureComparison compared(const std::string& name) {
  const std::filesystem::path folder = PORTALENS_SOURCE_DIR "/tests/differential/pictures";
  PictureComparison found = compare_pictures(set_up(folder / name));
  EXPECT_TRUE(found.interpolates);
  EXPECT_GT(found.interpolated, found.pixels / 2) << name;
  return found;
}

/// Where gravity through portals bends light sharply between probe rays: once 586, 287 and 209
/// pixels of these were off.
TEST(KeptPictures, KeepTheToleranceBesideSharpBends) {
  for (const char* name : {"1380649-91.toml", "1380649-122.toml", "1380649-199.toml"}) {
    const PictureComparison found = compared(name);
    EXPECT_LT(found.over10 + found.other_way, 30u) << name;
  }
}

/// Once 22 pixels showed the portal where the sky is seen through one of its notches.
TEST(KeptPictures, SeeANotchBetweenProbeRays) {
  EXPECT_EQ(compared("20261130-60.toml").other_way, 0u);
}

TEST(Minimised, KeepsWhatThePhotonIsWrongByAndDropsTheRest) {
  Draft draft = random_scene(1, 0);
  Lot lot(1, 2);
  draft.masses = {{{0, 0, 0}, {612.345}}, {{40, 0, 0}, {100.0, 0.3}}};
  draft.portals.clear();
  const Frame here = lot.frame({}), there = lot.frame({3, 0, 0});
  for (int i = 0; i < 2; ++i) add_pair(draft, rectangle(1, 1), here, there);
  draft.portals[2].solid_back = true;
  draft.bodies.resize(3);
  const Judge judge = [](const Find& find) -> std::optional<Difference> {
    Difference difference;
    const Draft& d = find.draft;
    difference.other_way =
        std::any_of(d.masses.begin(), d.masses.end(),
                    [](const DraftMass& mass) { return mass.weight.mass > 600.0; }) &&
        std::any_of(d.portals.begin(), d.portals.end(),
                    [](const DraftPortal& portal) { return portal.solid_back; });
    return difference;
  };
  Find find{draft, {}, {true}};
  find.photon.direction = {0, 0, 1};
  const Find small = minimised(find, judge);
  ASSERT_EQ(small.draft.masses.size(), 1u);
  EXPECT_EQ(small.draft.masses.front().weight.mass, 610.0);
  EXPECT_EQ(small.draft.portals.size(), 2u);
  EXPECT_TRUE(small.draft.bodies.empty());
}

std::vector<std::filesystem::path> finds() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(PORTALENS_SOURCE_DIR "/tests/differential/finds"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class Found : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(Found, IsFollowedByBothEngines) {
  const KeptFind find = read_find(GetParam());
  for (const Engine engine : {Engine::automatic, Engine::scalar}) {
    const Difference difference = difference_of(find, engine);
    const bool right = !difference.other_way && difference.tolerances <= find.tolerances;
    if (!right && find.open) GTEST_SKIP() << "open: " << in_words(difference);
    EXPECT_TRUE(right) << in_words(difference);
  }
}

INSTANTIATE_TEST_SUITE_P(Finds, Found, testing::ValuesIn(finds()), [](const auto& find) {
  std::string name = "Of" + find.param.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
});

}  // namespace
}  // namespace portalens::differential
