// What every passage keeps: light comes out of the pair's face, and the way back is the way in.
#include "portal/passage.h"

#include <gtest/gtest.h>

#include <numbers>
#include <optional>

#include "portal/portal.h"
#include "support/list_types.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/spaces.h"

namespace portalens::test {
namespace {

template <class T>
class EachPassage : public testing::Test {};
TYPED_TEST_SUITE(EachPassage, TypesOf<Passage>::type);

/// A regular polygon somewhere, and its pair: they are mirror images of themselves.
struct Faces {
  FaceInput a, b;
};

Faces random_faces(Random& random, int corners) {
  const auto face = [&] {
    const Vec3d normal = random.direction(), right = any_perpendicular(normal);
    const Frame frame{random.point(10.0), right, cross(normal, right), normal};
    std::vector<Vec3d> vertices;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / corners;
      vertices.push_back(frame.to_world({std::cos(angle), std::sin(angle), 0.0}));
    }
    return polygon_input(std::move(vertices));
  };
  return {face(), face()};
}

TYPED_TEST(EachPassage, LightComesOutOfThePairsFaceAndGoesBackTheWayItCame) {
  Random random(41);
  int taken = 0;
  for (int i = 0; i < scaled(3000); ++i) {
    const Faces faces = random_faces(random, 3 + i % 4);
    const auto there = TypeParam::between({faces.a, faces.b});
    const auto back = TypeParam::between({faces.b, faces.a});
    ASSERT_EQ(there.has_value(), back.has_value());
    if (!there) continue;
    ++taken;
    const Vec3d at =
        faces.a.frame.to_world({random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0});
    Vec3d direction = random.direction();
    if (dot(direction, faces.a.frame.normal) > 0.0) direction = -direction;
    const Passed out = there->pass(at, direction);
    ASSERT_NEAR(length(out.direction), 1.0, 1e-12);
    ASSERT_GE(out.turning, 0.0);
    const Vec3d local = faces.b.frame.to_local(out.position);
    ASSERT_NEAR(local.z, 0.0, 1e-12);
    ASSERT_LE(length(local), 1.0);
    ASSERT_GT(dot(out.direction, faces.b.frame.normal), 0.0);
    const Passed again = back->pass(out.position, -out.direction);
    ASSERT_LE(length(again.position - at), 1e-12);
    ASSERT_LE(length(again.direction + direction), 1e-12);
    ASSERT_NEAR(again.turning, out.turning, 1e-12);
  }
  EXPECT_GT(taken, 0);
}

TYPED_TEST(EachPassage, ItsMotionIfItHasOneIsWhatItDoes) {
  Random random(42);
  for (int i = 0; i < 100; ++i) {
    const Faces faces = random_faces(random, 3 + i % 4);
    const auto passage = TypeParam::between({faces.a, faces.b});
    if (!passage || !passage->motion()) continue;
    const Vec3d at = random.point(5.0), direction = random.direction();
    const Passed out = passage->pass(at, direction);
    EXPECT_EQ(out.position, passage->motion()->move(at));
    EXPECT_EQ(out.direction, passage->motion()->rotate(direction));
    EXPECT_EQ(out.turning, 0.0);
    EXPECT_NEAR(passage->motion()->determinant(), 1.0, 1e-13);
  }
}

TEST(Passages, SomeTypeTakesEveryPair) {
  Random random(43);
  for (int i = 0; i < 100; ++i) {
    const Faces faces = random_faces(random, 3 + i % 4);
    const Passage passage = passage_between({faces.a, faces.b});
    EXPECT_NE(name_of(passage), "");
  }
}

}  // namespace
}  // namespace portalens::test
