// The nearest point of an ellipse over lanes, against that of the scalar engine.
#include "lanes/ellipse_face.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/pack.h"
#include "portal/ellipse.h"
#include "support/random.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

using R = Pair<Pack<xsimd::sse2>>;
using Found = LaneEllipseNearest<R>;

struct Gate {
  LaneOutline own;
  const LaneOutline* outline = &own;
  float tolerance = 0.0f;

  Gate(double radius_x, double radius_y) : own{} {
    own.kind = LaneOutline::Kind::ellipse;
    own.radius_x = static_cast<float>(radius_x);
    own.radius_y = static_cast<float>(radius_y);
  }
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  [[nodiscard]] Ellipse exact() const { return {own.radius_x, own.radius_y}; }
};

Vec3<R> packed(Vec3d v) { return {R(v.x), R(v.y), R(v.z)}; }

Vec3d first_of(Vec3<R> v) {
  float x[R::lanes], y[R::lanes], z[R::lanes];
  v.x.store(x);
  v.y.store(y);
  v.z.store(z);
  return {x[0], y[0], z[0]};
}

/// Radii of which the longer is up to a hundred times the shorter.
Gate random_gate(Random& random) {
  const double longer = std::pow(10.0, random.uniform(-1.0, 2.0));
  const double shorter = longer * std::pow(10.0, random.uniform(-2.0, 0.0));
  const bool wide = random.uniform(0.0, 1.0) < 0.5;
  return Gate(wide ? longer : shorter, wide ? shorter : longer);
}

/// Before it, behind it, beside it.
Vec3d random_place(Random& random, const Gate& gate) {
  const double far = std::pow(10.0, random.uniform(-1.0, 1.5));
  const Vec3d within = random.point(1.0);
  const double a = gate.exact().a(), b = gate.exact().b();
  const Vec3d place{within.x * far * a, within.y * far * b, within.z * far * std::fmax(a, b)};
  // As floats have it.
  return first_of(packed(place));
}

/// A place, and what of an ellipse is nearest to it, over lanes and exactly.
struct Drawn {
  Gate gate;
  Ellipse ellipse;
  Vec3d local;
  Found found;
  Feature feature;

  explicit Drawn(Random& random)
      : gate(random_gate(random)),
        ellipse(gate.exact()),
        local(random_place(random, gate)),
        found(Found::on(gate, packed(local))),
        feature(ellipse.nearest(local, 0.0)) {}

  [[nodiscard]] Vec3d place(Vec3d x) const { return ellipse.place(ellipse.follow(feature, x), x); }
  [[nodiscard]] double shorter() const { return std::fmin(ellipse.a(), ellipse.b()); }
  /// At the tip of a thin one what a float's angle lacks counts for the square of that.
  [[nodiscard]] double rounding() const {
    const double thin = std::fmax(ellipse.a(), ellipse.b()) / shorter();
    return 1e-3 + 4e-6 * thin * thin;
  }
};

TEST(LaneEllipseNearest, IsWhereTheScalarEngineFindsIt) {
  Random random(77);
  int behind = 0, left_out = 0;
  const int count = scaled(20000);
  for (int i = 0; i < count; ++i) {
    const Drawn drawn(random);
    const auto& [gate, ellipse, local, found, feature] = drawn;
    if (any(runs_round(found))) {
      ++left_out;
      continue;
    }
    const Vec3d exact = ellipse.place(feature, local);
    behind += local.z < 0.0 && ellipse.covers(local.x, local.y);
    const double size = ellipse.size();
    ASSERT_LT(length(first_of(found.place(packed(local))) - exact), 5e-6 * size)
        << ellipse.a() << " " << ellipse.b() << " at " << local.x << " " << local.y << " "
        << local.z;
  }
  EXPECT_GT(behind, count / 20);
  EXPECT_LT(left_out, count / 20);
}

TEST(LaneEllipseNearest, MovesAsFastAsItSays) {
  Random random(78);
  for (int i = 0; i < scaled(5000); ++i) {
    const Drawn drawn(random);
    const auto& [gate, ellipse, local, found, feature] = drawn;
    if (any(runs_round(found))) continue;
    const double step = 1e-4 * drawn.shorter();
    const Vec3d way = random.direction();
    const Vec3d before = drawn.place(local - way * step), after = drawn.place(local + way * step);
    const Vec3d exact = (after - before) * (0.5 / step);
    const Vec3d speed = first_of({found.speed_x(packed(way)), found.speed_y(packed(way)), R(0)});
    ASSERT_LT(length(speed - exact), drawn.rounding() * (1.0 + length(exact))) << i;
  }
}

TEST(LaneEllipseNearest, SwingsRoundWhereTheScalarEngineSaysSo) {
  Random random(80);
  for (int i = 0; i < scaled(5000); ++i) {
    const Drawn drawn(random);
    const auto& [gate, ellipse, local, found, feature] = drawn;
    if (any(runs_round(found))) continue;
    const double pivot = ellipse.pace(feature, local).pivot;
    const double expected = 1.0 / (pivot * pivot);
    ASSERT_NEAR(first_of({found.swings(), R(0), R(0)}).x, expected, drawn.rounding() * expected)
        << i;
  }
}

/// Whatever a path of that length does: it may come near the middle line, behind.
TEST(LaneEllipseNearest, MovesNoFasterThanItsBound) {
  Random random(79);
  for (int i = 0; i < scaled(5000); ++i) {
    const Drawn drawn(random);
    const auto& [gate, ellipse, local, found, feature] = drawn;
    const double h = drawn.shorter() * random.uniform(0.0, 0.5);
    const Vec3d end = local + random.direction() * h;
    if (any(has_other_nearest(gate, found, packed(end)))) continue;
    const double moved = length(drawn.place(end) - ellipse.place(feature, local));
    ASSERT_LE(moved, first_of({found.fastest(R(h)), R(0), R(0)}).x * h * (1.0 + 1e-5) +
                         1e-6 * ellipse.size())
        << i;
  }
}

}  // namespace
}  // namespace portalens::test
