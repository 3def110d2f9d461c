#include "reference/paper_method.h"

#include <cmath>
#include <optional>

namespace portalens::reference {
namespace {

/// The point of the segment closest to `x`.
Vec3d closest_on_segment(Vec3d a, Vec3d b, Vec3d x) {
  const Vec3d edge = b - a;
  const double s = std::fmin(std::fmax(dot(x - a, edge) / dot(edge, edge), 0.0), 1.0);
  return a + edge * s;
}

bool covers(const Portal& portal, Vec3d point) {
  const std::size_t count = portal.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d from = portal.vertices[i], edge = portal.vertices[(i + 1) % count] - from;
    if (dot(cross(edge, point - from), portal.frame.normal) < 0.0) return false;
  }
  return true;
}

/// One-sided: of the face from in front, of its rim from behind.
Vec3d closest_on_front(const Portal& portal, Vec3d x) {
  const double height = dot(x - portal.frame.origin, portal.frame.normal);
  const Vec3d foot = x - portal.frame.normal * height;
  if (height >= -portal.height_tolerance() && covers(portal, foot)) return foot;
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

}  // namespace

PaperMethod::PaperMethod(const Space& space, double step, int depth)
    : space_(space), step_(step), depth_(depth) {
  Box box = space.surfaces.bounds();
  for (const Portal& portal : space.portals.portals())
    for (const Vec3d& vertex : portal.vertices) box.add(vertex);
  double reach = 0.0;
  for (const Mass& mass : space.masses) {
    const Vec3d r{mass.influence, mass.influence, mass.influence};
    box.add(mass.center - r);
    box.add(mass.center + r);
    reach = std::fmax(reach, mass.influence);
  }
  middle_ = box.middle();
  radius_ = 0.5 * box.diagonal() + (depth > 0 ? reach : 0.0);
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
    g += portal.through.rotate_back(acceleration(portal.through.move(q), depth - 1, portal.pair));
  }
  return g;
}

bool PaperMethod::beyond_everything(Vec3d x, Vec3d direction) const {
  const Vec3d d = x - middle_;
  return dot(d, d) > radius_ * radius_ && dot(d, direction) > 0.0;
}

Arrival PaperMethod::advance(const Photon& photon) const {
  Arrival arrival;
  Vec3d x = photon.position, t = photon.direction;
  const double c = space_.physics.c;
  const double dt = step_ / c;
  const auto& shapes = space_.surfaces.shapes();
  std::uint32_t left = no_object;  // the portal just entered
  while (arrival.steps < space_.physics.max_steps) {
    ++arrival.steps;
    const Vec3d g = acceleration(x, depth_, no_portal);
    const Vec3d perpendicular = g - t * dot(g, t);
    t = normalize(t * c + perpendicular * dt);

    double nearest = step_;
    Met met = Met::nothing;
    std::uint32_t object = no_object;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
      const auto contact = std::visit(
          [&](const auto& shape) {
            return shape.intersect(Ray{x, t}, 1e-9, nearest);
          },
          shapes[i]);
      if (contact) nearest = contact->distance, met = Met::surface, object = i;
    }
    std::optional<std::uint32_t> entered;
    const auto portals = space_.portals.portals();
    for (std::uint32_t i = 0; i < portals.size(); ++i) {
      const double slope = dot(t, portals[i].frame.normal);
      if (slope >= 0.0 || i == left) continue;
      const double s = -dot(x - portals[i].frame.origin, portals[i].frame.normal) / slope;
      if (s >= 0.0 && s <= nearest && covers(portals[i], x + t * s)) nearest = s, entered = i;
    }
    x = x + t * nearest;
    arrival.length += nearest;
    left = no_object;
    if (entered) {
      if (++arrival.crossings > space_.max_crossings) break;
      const Portal& portal = portals[*entered];
      x = portal.through.move(x);
      t = portal.through.rotate(t);
      left = *entered;
    } else if (met == Met::surface) {
      arrival.fate = Fate::hit;
      arrival.met = met;
      arrival.object = object;
      break;
    }
    for (std::uint32_t i = 0; i < space_.masses.size(); ++i) {
      if (length(space_.masses[i].center - x) <= space_.masses[i].schwarzschild) {
        arrival.fate = Fate::absorbed;
        arrival.met = Met::mass;
        arrival.object = i;
      }
    }
    if (arrival.fate == Fate::absorbed) break;
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
