#include "differential/camera_place.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "differential/pieces.h"

namespace portalens::differential {
namespace {

struct Ball {
  Vec3d center;
  double radius;  ///< of influence
  double solid;   ///< what the camera can't be in
};

Vec3d middle_of(const std::vector<Vec3d>& corners) {
  Vec3d sum;
  for (const Vec3d& corner : corners) sum += corner;
  return sum / static_cast<double>(corners.size());
}

std::vector<Ball> balls_of(const Draft& draft) {
  std::vector<Ball> balls;
  const auto add = [&](Vec3d center, const DraftWeight& weight, double solid) {
    if (weight.mass > 0.0 || solid > 0.0)
      balls.push_back({center, std::max(influence_of(draft, weight.mass), solid),
                       std::max(2.5 * weight.mass / light_speed2, solid)});
  };
  for (const DraftMass& mass : draft.masses) add(mass.center, mass.weight, 0.0);
  for (const DraftPortal& portal : draft.portals)
    add(middle_of(portal.corners), portal.weight, 0.0);
  for (const DraftBody& body : draft.bodies)
    if (body.form != Form::quad) add(body.center, body.weight, 1.8 * body.size);
  return balls;
}

/// Something worth a look.
Vec3d target_of(const Draft& draft, const std::vector<Ball>& balls, Lot& lot) {
  const bool portals = !draft.portals.empty();
  const int last = static_cast<int>(draft.portals.size()) - 1;
  if (portals && lot.chance(0.5))
    return middle_of(draft.portals[static_cast<std::size_t>(lot.whole(0, last))].corners);
  if (balls.empty()) return lot.point(1.0);
  const Ball& ball =
      balls[static_cast<std::size_t>(lot.whole(0, static_cast<int>(balls.size()) - 1))];
  const double reach = lot.chance(0.3) ? 1.0 : lot.uniform(0.0, 0.7);
  return ball.center + reach * ball.radius * lot.direction();
}

bool is_free(Vec3d place, const std::vector<Ball>& balls) {
  return std::none_of(balls.begin(), balls.end(),
                      [&](const Ball& ball) { return length(place - ball.center) <= ball.solid; });
}

Vec3d position_of(const std::vector<Ball>& balls, Lot& lot, double half_box) {
  if (balls.empty() || lot.chance(0.7)) return half_box * lot.uniform(1.2, 2.5) * lot.direction();
  const Ball& ball =
      balls[static_cast<std::size_t>(lot.whole(0, static_cast<int>(balls.size()) - 1))];
  const double share = lot.chance(0.2) ? lot.uniform(0.98, 1.02) : lot.logarithmic(0.2, 3.0);
  return ball.center + share * ball.radius * lot.direction();
}

}  // namespace

void place_camera(Draft& draft, Lot& lot, double half_box) {
  const std::vector<Ball> balls = balls_of(draft);
  DraftCamera& camera = draft.camera;
  do {
    camera.position = position_of(balls, lot, half_box);
  } while (!is_free(camera.position, balls));
  camera.target = target_of(draft, balls, lot);
  camera.up = lot.square_to(normalize(camera.target - camera.position));
  camera.fov = lot.chance(0.15) ? lot.uniform(3.0, 25.0) : lot.uniform(30.0, 80.0);
}

}  // namespace portalens::differential
