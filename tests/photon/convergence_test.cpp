// How the error of each integrator falls with its step, on paths wholly inside one influence.
#include <gtest/gtest.h>

#include <cmath>

#include "photon/integrator.h"
#include "support/list_types.h"

namespace portalens::test {
namespace {

/// Error in position and direction after a fixed length of path round one mass, in steps of `h`.
template <class I>
State walk(double h, double total) {
  const auto acceleration = [](Vec3d x) {
    const double r = length(x);
    return x * (-1.0 / (r * r * r));
  };
  State state{{-8.0, 5.0, 0.5}, normalize(Vec3d{1.0, 0.05, -0.02})};
  const int steps = static_cast<int>(std::lround(total / h));
  for (int i = 0; i < steps; ++i)
    state = I::step(acceleration, state, acceleration(state.position), h).end;
  return state;
}

/// The slope of log(error) against log(step), over four halvings.
template <class I>
double order(double coarsest) {
  const double total = 16.0;
  const State exact = walk<Rk4>(1.0 / 4096, total);
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  const int count = 5;
  for (int k = 0; k < count; ++k) {
    const double h = coarsest / (1 << k);
    const State state = walk<I>(h, total);
    const double error =
        length(state.position - exact.position) / total + length(state.direction - exact.direction);
    const double x = std::log(h), y = std::log(error);
    sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y;
  }
  return (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
}

TEST(Convergence, EulerIsOfFirstOrder) { EXPECT_NEAR(order<Euler>(1.0 / 32), 1.0, 0.1); }
TEST(Convergence, RungeKuttaIsOfFourthOrder) { EXPECT_NEAR(order<Rk4>(1.0 / 4), 4.0, 0.2); }
TEST(Convergence, RadauIsOfFourthOrder) { EXPECT_NEAR(order<Radau>(1.0), 4.0, 0.3); }

template <class I>
class EachIntegrator : public testing::Test {};
TYPED_TEST_SUITE(EachIntegrator, TypesOf<Integrator>::type);

TYPED_TEST(EachIntegrator, IsOfSomeOrder) { EXPECT_GE(order<TypeParam>(1.0 / 8), 0.9); }

TYPED_TEST(EachIntegrator, KeepsDirectionsUnitAndFreeWaysStraight) {
  EXPECT_NEAR(length(walk<TypeParam>(1.0 / 8, 16.0).direction), 1.0, 1e-14);
  const State start{{1, 2, 3}, normalize(Vec3d{3, -1, 2})};
  const auto free = [](Vec3d) { return Vec3d{}; };
  const State end = TypeParam::step(free, start, {}, 5.0).end;
  EXPECT_LT(length(end.position - start.position - start.direction * 5.0), 1e-14);
  EXPECT_LT(length(end.direction - start.direction), 1e-15);
}

}  // namespace
}  // namespace portalens::test
