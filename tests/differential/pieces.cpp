#include "differential/pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace portalens::differential {
namespace {

std::vector<Vec3d> regular(int corners, double size, double first) {
  std::vector<Vec3d> polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = first + 2.0 * std::numbers::pi * i / corners;
    polygon.push_back({size * std::cos(angle), size * std::sin(angle), 0.0});
  }
  return polygon;
}

/// Few, or so many that it is nearly round.
int corner_count(Lot& lot) { return lot.chance(0.25) ? lot.whole(9, 48) : lot.whole(3, 8); }

/// Corners anywhere on an ellipse, none too near the next.
std::vector<Vec3d> irregular(Lot& lot, int corners, double size) {
  const double flatness = lot.uniform(0.3, 1.0);
  std::vector<Vec3d> polygon;
  double angle = lot.uniform(0.0, 2.0 * std::numbers::pi);
  for (int i = 0; i < corners; ++i) {
    polygon.push_back({size * std::cos(angle), flatness * size * std::sin(angle), 0.0});
    angle += 2.0 * std::numbers::pi / corners * lot.uniform(0.4, 1.0);
  }
  return polygon;
}

/// A star, or an L.
std::vector<Vec3d> notched(Lot& lot, double size) {
  if (lot.chance(0.5)) {
    const double x = size * lot.uniform(-0.5, 0.5), y = size * lot.uniform(-0.5, 0.5);
    return {{-size, -size, 0}, {size, -size, 0}, {size, y, 0},
            {x, y, 0},         {x, size, 0},     {-size, size, 0}};
  }
  const int points = lot.whole(3, 6);
  const double inner = lot.uniform(0.25, 0.7) * std::cos(std::numbers::pi / points);
  std::vector<Vec3d> polygon = regular(2 * points, size, lot.uniform(0.0, 2.0));
  for (std::size_t i = 1; i < polygon.size(); i += 2) polygon[i] = polygon[i] * inner;
  return polygon;
}

/// Numbers as people write them: so many digits.
double rounded(double x, int digits) {
  if (x == 0.0) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::fabs(x))) - digits + 1.0);
  return std::round(x / unit) * unit;
}

}  // namespace

double influence_of(const Draft& draft, double mass) { return std::sqrt(mass / draft.min_force); }

std::vector<Vec3d> rectangle(double width, double height) {
  const double x = 0.5 * width, y = 0.5 * height;
  return {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
}

std::vector<Vec3d> random_polygon(Lot& lot, double size) {
  switch (lot.weighted({0.5, 0.15, 0.15, 0.2})) {
    case 0:
      return rectangle(1.4 * size, 1.4 * size * lot.logarithmic(0.25, 1.0));
    case 1: {
      const int corners = corner_count(lot);
      return regular(corners, size, lot.uniform(0.0, 2.0));
    }
    case 3:
      return notched(lot, size);
    default:
      return irregular(lot, corner_count(lot), size);
  }
}

bool is_rectangle(const std::vector<Vec3d>& polygon) {
  if (polygon.size() != 4) return false;
  const Vec3d across = polygon[1] - polygon[0], along = polygon[3] - polygon[0];
  const double size = length(across) * length(along);
  return length(polygon[2] - polygon[1] - along) < 1e-12 * length(along) &&
         std::fabs(dot(across, along)) < 1e-12 * size;
}

void add_pair(Draft& draft, const std::vector<Vec3d>& polygon, const Frame& a, const Frame& b) {
  DraftPortal first, second;
  for (const Vec3d& corner : polygon) first.corners.push_back(a.to_world(corner));
  const std::size_t count = polygon.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d& corner = polygon[(1 + count - i) % count];
    second.corners.push_back(b.to_world({-corner.x, corner.y, 0.0}));
  }
  draft.portals.push_back(std::move(first));
  draft.portals.push_back(std::move(second));
}

void place(Draft& draft, const Frame& turned, double scale, Vec3d offset) {
  const auto move = [&](Vec3d& point) {
    point = scale * turned.direction_to_world(point) + offset;
  };
  const auto enlarge = [&](DraftWeight& weight) {
    weight.mass = rounded(weight.mass * scale, 6);
    weight.core *= scale;
  };
  move(draft.camera.position);
  move(draft.camera.target);
  draft.camera.up = turned.direction_to_world(draft.camera.up);
  for (DraftMass& mass : draft.masses) {
    move(mass.center);
    enlarge(mass.weight);
  }
  for (DraftBody& body : draft.bodies) {
    move(body.center);
    body.size *= scale;
    for (Vec3d& corner : body.corners) move(corner);
    enlarge(body.weight);
  }
  for (DraftPortal& portal : draft.portals) {
    for (Vec3d& corner : portal.corners) move(corner);
    enlarge(portal.weight);
  }
  draft.min_force = rounded(draft.min_force / scale, 4);
  draft.max_length = rounded(draft.max_length * scale, 2);
}

void place_somewhere(Draft& draft, Lot& lot) {
  const double scale = lot.chance(0.5) ? 1.0 : std::pow(10.0, lot.whole(-4, 5));
  const Frame turned = lot.chance(0.4) ? Frame{{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}} : lot.frame({});
  const Vec3d offset =
      lot.chance(0.7) ? Vec3d{} : scale * lot.logarithmic(1.0, 300.0) * lot.direction();
  place(draft, turned, scale, offset);
}

}  // namespace portalens::differential
