#include "reference/paper_method.h"

#include <cmath>

namespace portalens::reference {
namespace {

/// The point of the segment closest to `x`.
Vec3d closest_on_segment(Vec3d a, Vec3d b, Vec3d x) {
  const Vec3d edge = b - a;
  const double s = std::fmin(std::fmax(dot(x - a, edge) / dot(edge, edge), 0.0), 1.0);
  return a + edge * s;
}

/// Whether a point of the plane lies within a polygon that runs counter-clockwise round `normal`.
template <class Vertices>
bool within(const Vertices& vertices, Vec3d normal, Vec3d point) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3d from = vertices[i], edge = vertices[(i + 1) % vertices.size()] - from;
    if (dot(cross(edge, point - from), normal) < 0.0) return false;
  }
  return true;
}

/// One-sided: of the face from in front, of its rim from behind.
Vec3d closest_on_front(const Portal& portal, Vec3d x) {
  const double height = dot(x - portal.frame.origin, portal.frame.normal);
  const Vec3d nearest_point = x - portal.frame.normal * height;
  if (height >= -portal.height_tolerance() &&
      within(portal.vertices, portal.frame.normal, nearest_point))
    return nearest_point;
  const std::size_t count = portal.vertices.size();
  Vec3d best;
  double least = INFINITY;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d q = closest_on_segment(portal.vertices[i], portal.vertices[(i + 1) % count], x);
    const double d = dot(q - x, q - x);
    if (d < least) least = d, best = q;
  }
  return best;
}

/// Distance at which the segment of length `high` meets the shape, or infinity: the plane first,
/// the polygon only if that is met; a sphere by its quadratic.
double meet(const Shape& shape, const Ray& ray, double high) {
  if (const auto* quad = std::get_if<Quad>(&shape)) {
    const double slope = dot(quad->normal(), ray.direction);
    const double s = dot(quad->vertices()[0] - ray.origin, quad->normal()) / slope;
    if (!(s > 1e-9 && s <= high)) return INFINITY;
    return within(quad->vertices(), quad->normal(), ray.at(s)) ? s : INFINITY;
  }
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    const Vec3d from = ray.origin - sphere->center();
    const double half = dot(from, ray.direction);
    const double square = half * half - dot(from, from) + sphere->radius() * sphere->radius();
    if (square < 0.0) return INFINITY;
    const double root = std::sqrt(square);
    if (-half - root > 1e-9) return -half - root;
    return -half + root > 1e-9 ? -half + root : INFINITY;
  }
  const auto contact =
      std::visit([&](const auto& other) { return other.intersect(ray, 1e-9, high); }, shape);
  return contact ? contact->distance : INFINITY;
}

}  // namespace

PaperMethod::PaperMethod(const Space& space, double step, int depth)
    : space_(space), step_(step), depth_(depth) {
  Box box = space.surfaces.bounds();
  for (const Portal& portal : space.portals.portals())
    for (const Vec3d& vertex : portal.vertices) box.add(vertex);
  const Vec3d middle = box.empty() ? Vec3d{} : box.middle();
  double reach = 0.0;
  if (depth > 0)
    for (const Mass& mass : space.masses) reach = std::fmax(reach, mass.influence);
  // Ours, not the paper's (equations.md, sec. 5), so that both follow the same light.
  const auto* coupling = std::get_if<ClosestPointCoupling>(&space.coupling);
  const auto portals = static_cast<std::uint32_t>(space.portals.portals().size());
  for (int k = 0; k <= depth; ++k)
    for (std::uint32_t a = 0; a < portals; ++a)
      reach_.push_back(coupling && k > 0 ? coupling->reach(a, k) : 0.0);
  balls_.push_back({middle, 0.5 * box.diagonal() + reach});
  for (const Mass& mass : space.masses) balls_.push_back({mass.center, mass.influence});
}

Vec3d PaperMethod::acceleration(Vec3d x, int depth, std::uint32_t left_out) const {
  Vec3d g;
  for (const Mass& mass : space_.masses) {
    const Vec3d d = mass.center - x;
    const double r = length(d);
    if (r < mass.influence) g += d * (mass.gm / (r * r * r));
  }
  if (depth == 0) return g;
  const auto portals = space_.portals.portals();
  for (std::uint32_t i = 0; i < portals.size(); ++i) {
    if (i == left_out) continue;
    const Portal& portal = portals[i];
    const Vec3d q = closest_on_front(portal, x);
    const double reach = reach_[static_cast<std::size_t>(depth) * portals.size() + i];
    if (!(dot(x - q, x - q) < reach * reach)) continue;
    g += portal.motion()->rotate_back(
        acceleration(portal.motion()->move(q), depth - 1, portal.pair));
  }
  return g;
}

bool PaperMethod::beyond_everything(Vec3d x, Vec3d direction) const {
  for (const Ball& ball : balls_) {
    const Vec3d d = x - ball.center;
    if (dot(d, d) <= ball.radius * ball.radius || dot(d, direction) <= 0.0) return false;
  }
  return true;
}

PaperMethod::Meeting PaperMethod::first_met(const Ray& ray, std::uint32_t left) const {
  Meeting first;
  first.distance = step_;
  const auto& shapes = space_.surfaces.shapes();
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const double distance = meet(shapes[i], ray, first.distance);
    if (distance < first.distance) first = {distance, i, std::nullopt};
  }
  const auto portals = space_.portals.portals();
  for (std::uint32_t i = 0; i < portals.size(); ++i) {
    const double slope = dot(ray.direction, portals[i].frame.normal);
    if (slope >= 0.0 || i == left) continue;
    const double s = -dot(ray.origin - portals[i].frame.origin, portals[i].frame.normal) / slope;
    if (s >= 0.0 && s <= first.distance &&
        within(portals[i].vertices, portals[i].frame.normal, ray.at(s)))
      first.distance = s, first.entered = i;
  }
  return first;
}

std::optional<std::uint32_t> PaperMethod::horizon_about(Vec3d x) const {
  std::optional<std::uint32_t> last;
  for (std::uint32_t i = 0; i < space_.masses.size(); ++i)
    if (length(space_.masses[i].center - x) <= space_.masses[i].horizon_radius) last = i;
  return last;
}

Arrival PaperMethod::advance(const Photon& photon) const {
  Arrival arrival;
  Vec3d x = photon.position, t = photon.direction;
  const double c = space_.physics.c;
  const double dt = step_ / c;
  std::uint32_t left = no_object;  // the portal just entered
  while (arrival.steps < space_.physics.max_steps) {
    ++arrival.steps;
    const Vec3d g = acceleration(x, depth_, no_portal);
    const Vec3d perpendicular = g - t * dot(g, t);
    t = normalize(t * c + perpendicular * dt);

    const Meeting met = first_met({x, t}, left);
    x = x + t * met.distance;
    arrival.length += met.distance;
    left = no_object;
    if (met.entered) {
      if (++arrival.crossings > space_.max_crossings) break;
      const Portal& portal = space_.portals.portals()[*met.entered];
      x = portal.motion()->move(x);
      t = portal.motion()->rotate(t);
      left = *met.entered;
    } else if (met.surface != no_object) {
      arrival.fate = Fate::hit;
      arrival.met = Met::surface;
      arrival.object = met.surface;
      break;
    }
    if (const auto mass = horizon_about(x)) {
      arrival.fate = Fate::absorbed;
      arrival.met = Met::mass;
      arrival.object = *mass;
      break;
    }
    if (beyond_everything(x, t)) {
      arrival.fate = Fate::escaped;
      break;
    }
  }
  arrival.position = x;
  arrival.direction = t;
  return arrival;
}

}  // namespace portalens::reference
