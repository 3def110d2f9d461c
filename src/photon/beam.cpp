#include "photon/beam.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <variant>

#include "geometry/closest_point.h"

namespace portalens {
namespace {

/// How often a section of a beam is halved that comes near an obstacle.
constexpr int max_halvings = 5;
/// How far from the beam a border still matters, in radii of the beam: the probe rays from which
/// the light between the path records is interpolated lie that far away.
constexpr double border_reach = 3.0;
/// In tolerances: where light that enters an influence turns by less, its border is smooth enough,
/// for a polynomial across it errs by a twentieth of that.
constexpr double least_felt = 20.0;

/// Whether the whole segment lies on one side of the quad's plane, further away than that.
bool beside_plane(const Quad& quad, Vec3d a, Vec3d b, double distance) {
  const double height_a = dot(a - quad.vertices()[0], quad.normal());
  const double height_b = dot(b - quad.vertices()[0], quad.normal());
  return (height_a > distance && height_b > distance) ||
         (height_a < -distance && height_b < -distance);
}

}  // namespace

bool BeamGuard::can_guard(const Space& space) {
  return space.surfaces.shapes().size() + space.portals.portals().size() + space.masses.size() <=
         max_obstacles;
}

std::optional<BeamGuard> BeamGuard::over(const Space& space) {
  if (!can_guard(space)) return std::nullopt;
  return BeamGuard(space);
}

BeamGuard::BeamGuard(const Space& space) : space_(&space) {
  const auto& shapes = space.surfaces.shapes();
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const Box box = std::visit([](const auto& shape) { return shape.bounds(); }, shapes[i]);
    const Shape* shape = std::holds_alternative<Mesh>(shapes[i]) ? nullptr : &shapes[i];
    add(shape, box, Met::surface, i);
  }
  const auto portals = space.portals.portals();
  for (std::uint32_t i = 0; i < portals.size(); ++i) {
    for (const std::vector<Vec3d>& piece : pieces_of(portals[i])) add(piece, Met::portal_back, i);
    for (const std::vector<Vec3d>& gap : gaps_of(portals[i])) add(gap, Met::nothing, i);
  }
  for (std::uint32_t i = 0; i < space.masses.size(); ++i) {
    const Mass& mass = space.masses[i];
    if (mass.has_horizon()) add(nullptr, mass.center, mass.horizon_radius, Met::mass, i);
  }
}

/// In quads, and a triangle.
void BeamGuard::add(std::span<const Vec3d> corners, Met kind, std::uint32_t index) {
  for (std::size_t k = 1; k + 1 < corners.size(); k += 2) {
    const std::array<Vec3d, 4> part = {corners[0], corners[k], corners[k + 1],
                                       corners[std::min(k + 2, corners.size() - 1)]};
    const std::size_t count = std::min<std::size_t>(4, corners.size() - k + 1);
    const Quad face(std::span<const Vec3d>(part).first(count));
    add(&faces_.emplace_back(face), face.bounds(), kind, index);
  }
}

void BeamGuard::add(const Shape* shape, const Box& box, Met kind, std::uint32_t index) {
  add(shape, box.middle(), 0.5 * box.diagonal(), kind, index);
}

void BeamGuard::add(const Shape* shape, Vec3d center, double radius, Met kind,
                    std::uint32_t index) {
  const Vec3<float> near{static_cast<float>(center.x), static_cast<float>(center.y),
                         static_cast<float>(center.z)};
  const double lost = length(center - Vec3d{near.x, near.y, near.z});
  const auto near_radius = static_cast<float>((radius + lost) * (1.0 + 1e-5));
  const Reached near_center{near.x, near.y, near.z, 0.0f};
  const bool flat = shape && std::holds_alternative<Quad>(*shape) && kind != Met::nothing;
  const FlushFaces& flush = space_->surfaces.flush();
  const auto shape_count = static_cast<std::uint32_t>(space_->surfaces.shapes().size());
  const std::uint32_t number = kind == Met::portal_back ? shape_count + index : index;
  const auto* place = flat && flush.any_shapes() ? flush.find(number, 0) : nullptr;
  obstacles_.push_back({shape, center, radius, near_center, near_radius, kind, index, place});
}

/// Whether the section already descends to the plane on which the paths end: no higher over it than
/// the beam is wide, and at least half as steeply as at the end. Light that only skims the plane
/// before that may hit it there.
bool BeamGuard::sinks(const Obstacle& obstacle, const BeamSection& section,
                      const BeamSection& final) {
  const auto* quad = obstacle.shape ? std::get_if<Quad>(obstacle.shape) : nullptr;
  if (!quad) return false;
  const auto slope = [&](const BeamSection& part) {
    const Vec3d along = place_of(part.to - part.from);
    return dot(along, quad->normal()) / length(along);
  };
  const double arriving = slope(final), left = final.to[3] - section.to[3];
  return left * std::fabs(arriving) <= 2.0 * final.to_radius &&
         slope(section) * arriving >= 0.5 * arriving * arriving;
}

bool BeamGuard::met(const Obstacle& obstacle, const BeamSection& section, const BeamSection& final,
                    const PathRecord& record, const Arrival& end) const {
  const bool last = section.stretch == record.crossings();
  if (obstacle.kind == Met::nothing)
    return !section.arrives || last || record.portal_after(section.stretch) != obstacle.index;
  if (obstacle.kind != Met::portal_back)
    return last && end.met == obstacle.kind && end.object == obstacle.index &&
           (section.arrives || sinks(obstacle, section, final));
  const auto portals = space_->portals.portals();
  return (section.arrives && !last && record.portal_after(section.stretch) == obstacle.index) ||
         (section.leaves && section.stretch > 0 &&
          portals[record.portal_after(section.stretch - 1)].pair == obstacle.index);
}

bool BeamGuard::hidden(const Obstacle& obstacle, const BeamSection& section,
                       const PathRecord& record, const Arrival& end) const {
  if (!obstacle.place) return false;
  const FlushFaces& flush = space_->surfaces.flush();
  const auto shape_count = static_cast<std::uint32_t>(space_->surfaces.shapes().size());
  const std::uint32_t plane = obstacle.place->plane;
  if (section.leaves && section.stretch > 0) {
    const std::uint32_t entered = record.portal_after(section.stretch - 1);
    if (space_->portals.plane_of(space_->portals.portals()[entered].pair).plane == plane)
      return true;
  }
  if (!section.arrives) return false;
  FaceId met{no_object, 0};
  if (section.stretch < record.crossings())
    met = {shape_count + record.portal_after(section.stretch), 0};
  else if (end.met == Met::surface)
    met = {end.object, end.face};
  else if (end.met == Met::portal_back)
    met = {shape_count + end.object, 0};
  const auto* place = flush.find(met.object, met.face);
  if (!place || place->plane != plane) return false;
  const auto over = flush.over(*place);
  return std::find(over.begin(), over.end(), obstacle.place->face) == over.end();
}

/// Whether the obstacle can't be touched, as their balls tell.
bool BeamGuard::apart(const BeamSection& section, const Obstacle& obstacle) {
  const Reached between = (section.from + section.to) * 0.5f - obstacle.near_center;
  const float reach = section.reach + obstacle.near_radius;
  return square_of_place(between) > reach * reach;
}

/// Halves the section where it comes near.
bool BeamGuard::touches(const BeamSection& section, const Obstacle& obstacle) {
  const auto* quad = obstacle.shape ? std::get_if<Quad>(obstacle.shape) : nullptr;
  const auto near = [&](const auto& self, Vec3d from, Vec3d to, double from_radius,
                        double to_radius, int halvings) -> bool {
    const double radius = std::max(from_radius, to_radius);
    if (quad && beside_plane(*quad, from, to, radius)) return false;
    const Vec3d nearest = closest_on_segment(from, to, obstacle.center);
    if (length(nearest - obstacle.center) > obstacle.radius + radius) return false;
    if (obstacle.shape) {
      const Segment segment{from, to};
      const auto clearance = [&](const auto& shape) { return shape.clearance(segment); };
      if (std::visit(clearance, *obstacle.shape) > radius) return false;
    }
    if (halvings == 0) return true;
    const Vec3d middle = (from + to) * 0.5;
    const double middle_radius = 0.5 * (from_radius + to_radius);
    return self(self, from, middle, from_radius, middle_radius, halvings - 1) ||
           self(self, middle, to, middle_radius, to_radius, halvings - 1);
  };
  return near(near, place_of(section.from), place_of(section.to), section.from_radius,
              section.to_radius, max_halvings);
}

bool BeamGuard::along_border(std::span<const BeamSection> beam, bool escapes) const {
  for (std::size_t begin = 0; begin < beam.size();) {
    std::size_t end = begin;
    while (!beam[end++].last) continue;
    const auto stretch = beam.subspan(begin, end - begin);
    float widest = 0.0f;
    for (const BeamSection& section : stretch) widest = std::max(widest, section.radius());
    const bool runs_off = escapes && end == beam.size();
    for (const Mass& mass : space_->masses)
      if (is_felt(mass, widest) && along_sphere(stretch, mass, widest, runs_off)) return true;
    begin = end;
  }
  return false;
}

/// Whether light that dips into an influence no deeper than the probe rays of a beam of that radius
/// lie from its border may turn by more than `least_felt` tolerances.
bool BeamGuard::is_felt(const Mass& mass, double widest) const {
  const double radius = mass.influence;
  if (std::isinf(radius) || mass.gm == 0.0) return false;
  const double depth = (border_reach + 1.0) * widest, inner = radius - depth;
  if (inner <= 0.0) return true;
  const double chord = 2.0 * std::sqrt(2.0 * radius * depth), c = space_->physics.c;
  return std::fabs(mass.gm) * chord >
         least_felt * space_->physics.tolerance * c * c * inner * inner;
}

/// Whether the border of an influence might be entered by some of the light, and not by all; or
/// the light begins or ends beside it, so that some has been within for a while.
bool BeamGuard::along_sphere(std::span<const BeamSection> stretch, const Mass& mass, double widest,
                             bool runs_off) {
  const double radius = mass.influence;
  const auto distance_to = [&](Reached place) { return length(place_of(place) - mass.center); };
  const auto beside = [&](double distance, double wide) {
    return std::fabs(distance - radius) <= border_reach * wide;
  };
  const double begins = distance_to(stretch.front().from);
  if (beside(begins, stretch.front().from_radius)) return true;
  if (!runs_off && beside(distance_to(stretch.back().to), stretch.back().to_radius)) return true;
  // Mostly it begins far within.
  if (begins < radius - border_reach * widest) return false;
  double least = std::numeric_limits<double>::infinity(), wide = 0.0;
  for (const BeamSection& section : stretch) {
    const double reach = least + section.reach;
    const Vec3d middle = place_of((section.from + section.to) * 0.5f) - mass.center;
    if (dot(middle, middle) >= reach * reach) continue;
    const Vec3d nearest =
        closest_on_segment(place_of(section.from), place_of(section.to), mass.center);
    const double distance = length(nearest - mass.center);
    if (distance < least) least = distance, wide = section.radius();
  }
  return beside(least, wide);
}

bool BeamGuard::clear(const std::array<const PathRecord*, 4>& records, const Arrival& end) const {
  const Beam beam(records);
  const std::span<const BeamSection> sections = beam.sections();
  if (along_border(sections, end.fate == Fate::escaped)) return false;
  for (const Obstacle& obstacle : obstacles_)
    for (const BeamSection& section : sections)
      if (!apart(section, obstacle) && !met(obstacle, section, sections.back(), *records[0], end) &&
          !hidden(obstacle, section, *records[0], end) && touches(section, obstacle))
        return false;
  return true;
}

}  // namespace portalens
