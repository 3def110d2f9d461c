#include "app/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace portalens {
namespace {

/// Lines are cut this many pictures beyond the picture's edges.
constexpr double spare = 1.0;

constexpr int circle_pieces = 96;

/// Keeps the part of a convex polygon where `height` is not negative.
template <class Place, class Height>
std::vector<Place> clipped(const std::vector<Place>& corners, const Height& height) {
  std::vector<Place> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Place &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double at_a = height(a), at_b = height(b);
    if (at_a >= 0.0) kept.push_back(a);
    if ((at_a >= 0.0) != (at_b >= 0.0)) kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  return kept;
}

}  // namespace

std::vector<Vec3d> circle_of(Vec3d center, Vec3d axis, double radius) {
  const Vec3d u = any_perpendicular(axis), v = cross(axis, u);
  std::vector<Vec3d> circle;
  for (int i = 0; i <= circle_pieces; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % circle_pieces) / circle_pieces;
    circle.push_back(center + (u * std::cos(angle) + v * std::sin(angle)) * radius);
  }
  return circle;
}

View::View(const Camera& camera, int width, int height, double nearest)
    : camera_(camera),
      width_(width),
      height_(height),
      nearest_(nearest),
      perspective_(camera.projection == Projection::perspective) {
  const Vec3d top = camera.ray(0.5 * width, 0.0, width, height).direction;
  const double half =
      perspective_ ? dot(top, camera.up) / dot(top, camera.forward) : 0.5 * camera.size;
  scale_ = 0.5 * height / half;
}

Vec3d View::local(Vec3d place) const {
  const Vec3d from = place - camera_.position;
  return {dot(from, camera_.right), dot(from, camera_.up), dot(from, camera_.forward)};
}

Point View::on_film(Vec3d local) const {
  const double scale = perspective_ ? scale_ / local.z : scale_;
  return {0.5 * width_ + scale * local.x, 0.5 * height_ - scale * local.y};
}

std::optional<Point> View::project(Vec3d place) const {
  const Vec3d at = local(place);
  if (perspective_ && at.z < nearest_) return std::nullopt;
  const Point point = on_film(at);
  const bool inside = point.x >= 0 && point.x <= width_ && point.y >= 0 && point.y <= height_;
  return inside ? std::optional(point) : std::nullopt;
}

bool View::clip_depth(Vec3d& a, Vec3d& b) const {
  if (!perspective_) return true;
  if (a.z < nearest_ && b.z < nearest_) return false;
  if (a.z < nearest_) a = b + (a - b) * ((b.z - nearest_) / (b.z - a.z));
  if (b.z < nearest_) b = a + (b - a) * ((a.z - nearest_) / (a.z - b.z));
  a.z = std::max(a.z, nearest_);
  b.z = std::max(b.z, nearest_);
  return true;
}

/// Liang and Barsky's way.
bool View::clip_film(Point& a, Point& b) const {
  const Point along = b - a;
  double from = 0.0, to = 1.0;
  const auto cut = [&](double slope, double room) {
    if (slope == 0.0) return room >= 0.0;
    const double at = room / slope;
    (slope < 0.0 ? from : to) = slope < 0.0 ? std::max(from, at) : std::min(to, at);
    return from <= to;
  };
  const double x = spare * width_, y = spare * height_;
  if (!cut(-along.x, a.x + x) || !cut(along.x, width_ + x - a.x) || !cut(-along.y, a.y + y) ||
      !cut(along.y, height_ + y - a.y))
    return false;
  const Point start = a;
  if (to < 1.0) b = start + along * to;
  if (from > 0.0) a = start + along * from;
  return true;
}

std::vector<PointChain> View::project_line(std::span<const Vec3d> places) const {
  std::vector<PointChain> pieces;
  for (std::size_t i = 1; i < places.size(); ++i) {
    Vec3d a = local(places[i - 1]), b = local(places[i]);
    if (!clip_depth(a, b)) continue;
    Point from = on_film(a), to = on_film(b);
    if (!clip_film(from, to)) continue;
    if (pieces.empty() || pieces.back().back() != from) pieces.push_back({from});
    pieces.back().push_back(to);
  }
  return pieces;
}

PointChain View::project_area(std::span<const Vec3d> corners) const {
  std::vector<Vec3d> deep;
  for (const Vec3d& corner : corners) deep.push_back(local(corner));
  if (perspective_) deep = clipped(deep, [&](Vec3d p) { return p.z - nearest_; });
  PointChain seen;
  for (Vec3d p : deep) {
    if (perspective_) p.z = std::max(p.z, nearest_);
    seen.push_back(on_film(p));
  }
  const double x = spare * width_, y = spare * height_;
  seen = clipped(seen, [&](Point p) { return p.x + x; });
  seen = clipped(seen, [&](Point p) { return width_ + x - p.x; });
  seen = clipped(seen, [&](Point p) { return p.y + y; });
  return clipped(seen, [&](Point p) { return height_ + y - p.y; });
}

Vec3d View::towards_eye(Vec3d place) const {
  if (!perspective_) return -camera_.forward;
  const Vec3d way = camera_.position - place;
  const double distance = length(way);
  return distance > 0.0 ? way / distance : -camera_.forward;
}

double View::pixels_per_length(Vec3d place) const {
  if (!perspective_) return scale_;
  const double depth = local(place).z;
  return depth < nearest_ ? 0.0 : scale_ / depth;
}

std::vector<Vec3d> View::silhouette(Vec3d center, double radius) const {
  if (!perspective_) return circle_of(center, camera_.forward, radius);
  const Vec3d way = camera_.position - center;
  const double distance = length(way), share = radius / distance;
  if (!(share < 1.0)) return {};
  return circle_of(center + way * (share * share), way / distance,
                   radius * std::sqrt(1.0 - share * share));
}

}  // namespace portalens
