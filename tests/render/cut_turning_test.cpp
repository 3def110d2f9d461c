/// \file
/// What the end of influences takes from the turning, against the turning without that end.
#include "render/cut_turning.h"

#include <gtest/gtest.h>

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

TEST(CutTurning, IsWhatAPullWithoutEndWouldAdd) {
  const World cut = world_of(1e-4);  // R = 1 and 1.41
  const World whole = world_of(0.0);
  Random random(20261130);
  for (int i = 0; i < scaled(200); ++i) {
    const Photon photon = photon_from({random.uniform(-3, 12), random.uniform(-3, 3), 40.0},
                                      {random.uniform(-3, 12), random.uniform(-3, 3), 0.0});
    const Trace with_end = trace_ray(cut, photon, 0), without = trace_ray(whole, photon, 0);
    if (with_end.end.fate != Fate::escaped || without.end.fate != Fate::escaped) continue;
    const auto near = [&](Vec3d center) {
      return length(cross(center - photon.position, photon.direction)) < 0.5;
    };
    if (near({0, 0, 0}) || near({9, 0, 0})) continue;  // there the path itself is another
    // As vectors: the two pulls may draw to different sides.
    const double missing = length(without.end.direction - with_end.end.direction);
    const auto told = cut_turning(cut, with_end);
    ASSERT_TRUE(told);
    EXPECT_NEAR(*told, missing, 0.01 * missing + 1e-7) << i;
    EXPECT_EQ(cut_turning(whole, without), 0.0);
  }
}

TEST(CutTurning, EndsWithThePath) {
  const World world = compiled(
      "[camera]\nposition = [0, 0, 50]\nlook_at = [0, 0, 0]\n"
      "[physics]\nc = 1.0\nmin_force = 1e-4\n[[mass]]\ncenter = [0, 0, 0]\nmass = 1e-4\n"
      "[[quad]]\nvertices = [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]]\n");
  const Trace half = trace_ray(world, photon_from({3, 0, 1e4}, {3, 0, 0}), 0);
  ASSERT_EQ(half.end.fate, Fate::hit);
  // Half of a line past the mass: m/b.
  EXPECT_NEAR(*cut_turning(world, half), 1e-4 / 3.0, 1e-8);
}

TEST(CutTurning, IsNotToldOfTooManyMasses) {
  std::string scene = "[camera]\nposition = [0, 0, 50]\nlook_at = [0, 0, 0]\n";
  for (std::size_t i = 0; i <= max_cut_masses; ++i)
    scene += "[[mass]]\ncenter = [" + std::to_string(9 * i) + ", 0, 0]\nmass = 1e-4\n";
  const World world = compiled(scene);
  EXPECT_FALSE(cut_turning(world, trace_ray(world, photon_from({3, 3, 9}, {3, 3, 0}), 0)));
}

}  // namespace
}  // namespace portalens::test
