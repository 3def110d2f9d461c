/// \file
/// What the end of influences takes from the turning, against the turning without that end.
#include "render/cut_turning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/random.h"
#include "support/scale.h"
#include "support/scene_text.h"

namespace portalens::test {
namespace {

/// Two masses whose pull is so weak that angles add: m = 1e-4 and 2e-4.
World world_of(double least) {
  return compiled(
      "[camera]\nposition = [0, 0, 50]\nlook_at = [0, 0, 0]\n"
      "[physics]\nc = 1.0\ntolerance = 1e-10\nmax_length = 1e9\nmin_force = " +
      std::to_string(least) +
      "\n[[mass]]\ncenter = [0, 0, 0]\nmass = 1e-4\n[[mass]]\ncenter = [9, 0, 0]\nmass = 2e-4\n");
}

Photon photon_from(Vec3d position, Vec3d towards) {
  Photon photon;
  photon.position = position;
  photon.direction = normalize(towards - position);
  return photon;
}

TEST(CutTurning, IsWhatPullsWithoutEndWouldAdd) {
  const World cut = world_of(1e-4);  // R = 1 and 1.41
  const World whole = world_of(0.0);
  const EndlessPull endless(cut), none(whole);
  Random random(20261130);
  int compared = 0;
  for (int i = 0; i < scaled(200); ++i) {
    const Vec3d from{random.uniform(-3, 12), random.uniform(-3, 3), 40.0};
    const Vec3d towards{random.uniform(-3, 12), random.uniform(-3, 3), 0.0};
    const Photon photon = photon_from(from, towards);
    const Trace with_end = trace_ray(cut, photon, 0), without = trace_ray(whole, photon, 0);
    if (with_end.end.fate != Fate::escaped || without.end.fate != Fate::escaped) continue;
    const auto told = endless.missing_turning(with_end);
    ASSERT_TRUE(told);
    EXPECT_NEAR(*told, without.end.turning - with_end.end.turning, 1e-12) << i;
    EXPECT_FALSE(none.missing_turning(without)) << "no influence ends";
    ++compared;
  }
  EXPECT_GT(compared, scaled(100));
}

TEST(CutTurning, FarFromTheMassIsWhatTheStraightLineSays) {
  const World world = compiled(
      "[camera]\nposition = [0, 0, 50]\nlook_at = [0, 0, 0]\n[physics]\nc = 1.0\n"
      "tolerance = 1e-10\nmax_length = 1e9\nmin_force = 1e-4\n"
      "[[mass]]\ncenter = [0, 0, 0]\nmass = 1e-4\n");
  const EndlessPull endless(world);
  for (const double b : {0.3, 0.6, 0.9, 1.5, 5.0}) {
    const Trace trace = trace_ray(world, photon_from({b, 0, 1e5}, {b, 0, 0}), 0);
    const double share = b < 1.0 ? 1.0 - std::sqrt(1.0 - b * b) : 1.0;  // R = 1
    EXPECT_NEAR(*endless.missing_turning(trace), 2e-4 / b * share, 2e-3 * 2e-4 / b) << b;
  }
}

TEST(CutTurning, IsNotToldWhereAPathMeetsSomething) {
  const std::string scene =
      "[camera]\nposition = [0, 0, 50]\nlook_at = [0, 0, 0]\n"
      "[physics]\nc = 1.0\nmin_force = 1e-4\n[[mass]]\ncenter = [0, 0, 0]\nmass = 1e-4\n"
      "[[quad]]\nvertices = [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]]\n";
  const World world = compiled(scene);
  const EndlessPull endless(world);
  const Trace hit = trace_ray(world, photon_from({3, 0, 99}, {3, 0, 0}), 0);
  ASSERT_EQ(hit.end.fate, Fate::hit);
  EXPECT_FALSE(endless.missing_turning(hit));
  const Trace mirrored = trace_ray(world, photon_from({3, 0, 99}, {3, 0, 0}), 3);
  ASSERT_EQ(mirrored.end.fate, Fate::escaped);
  EXPECT_FALSE(endless.missing_turning(mirrored));
  EXPECT_TRUE(endless.missing_turning(trace_ray(world, photon_from({30, 0, 99}, {30, 0, 0}), 0)));
}

}  // namespace
}  // namespace portalens::test
