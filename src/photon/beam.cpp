#include "photon/beam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "geometry/closest_point.h"

namespace portalens {
namespace {

/// More would take longer than the photons that are saved.
constexpr std::size_t most_obstacles = 256;
/// The beam is taken wider than the four trails are apart.
constexpr double widening = 1.25;
/// How often a piece of a beam is halved that comes near an obstacle.
constexpr int most_halvings = 5;

Vec3d wide(Vec3<float> v) { return {v.x, v.y, v.z}; }

/// Whether the whole segment lies on one side of the quad's plane, further away than that.
bool beside_plane(const Quad& quad, Vec3d a, Vec3d b, double distance) {
  const double height_a = dot(a - quad.vertices()[0], quad.normal());
  const double height_b = dot(b - quad.vertices()[0], quad.normal());
  return (height_a > distance && height_b > distance) ||
         (height_a < -distance && height_b < -distance);
}

/// How far a way can be from the straight one between two of its points.
double stray(const Waypoint& a, const Waypoint& b) {
  return 0.25 * double{b.length - a.length} * double{b.turning - a.turning};
}

}  // namespace

/// Goes along a way beside another.
class BeamGuard::Follower {
 public:
  explicit Follower(const Trail& trail) : points_(trail.points()) {}

  /// To where a stretch begins.
  void enter(std::int32_t stretch) {
    while (points_[at_].stretch < stretch) ++at_;
  }
  /// The place at that length within the stretch, or its nearer end.
  [[nodiscard]] Vec3d place(float length) {
    while (more() && points_[at_ + 1].length < length) ++at_;
    const Waypoint& a = points_[at_];
    if (!more() || length <= a.length) return wide(a.place);
    const Waypoint& b = points_[at_ + 1];
    const double share = double{length - a.length} / double{b.length - a.length};
    return wide(a.place) + (wide(b.place) - wide(a.place)) * share;
  }
  [[nodiscard]] Vec3d last() {
    while (more()) ++at_;
    return wide(points_[at_].place);
  }

 private:
  [[nodiscard]] bool more() const {
    return at_ + 1 < points_.size() && points_[at_ + 1].stretch == points_[at_].stretch;
  }

  std::span<const Waypoint> points_;
  std::size_t at_ = 0;
};

bool BeamGuard::can_guard(const Space& space) {
  return space.surfaces.shapes().size() + space.portals.portals().size() + space.masses.size() <=
         most_obstacles;
}

std::optional<BeamGuard> BeamGuard::over(const Space& space) {
  if (!can_guard(space)) return std::nullopt;
  return BeamGuard(space);
}

BeamGuard::BeamGuard(const Space& space) : space_(&space) {
  const auto& shapes = space.surfaces.shapes();
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const Box box = std::visit([](const auto& shape) { return shape.bounds(); }, shapes[i]);
    add(std::holds_alternative<Mesh>(shapes[i]) ? nullptr : &shapes[i], box, Met::surface, i);
  }
  const auto portals = space.portals.portals();
  for (std::uint32_t i = 0; i < portals.size(); ++i) {
    Box box;
    for (const Vec3d& vertex : portals[i].vertices) box.add(vertex);
    const Shape* face = nullptr;
    if (portals[i].vertices.size() <= 4) face = &faces_.emplace_back(Quad(portals[i].vertices));
    add(face, box, Met::portal_back, i);
  }
  for (std::uint32_t i = 0; i < space.masses.size(); ++i) {
    const Mass& mass = space.masses[i];
    if (mass.has_horizon())
      obstacles_.push_back({nullptr, mass.center, mass.schwarzschild, Met::mass, i});
  }
}

void BeamGuard::add(const Shape* shape, const Box& box, Met kind, std::uint32_t index) {
  obstacles_.push_back({shape, box.middle(), 0.5 * box.diagonal(), kind, index});
}

std::vector<BeamGuard::Piece> BeamGuard::beam_of(const std::array<const Trail*, 4>& trails) {
  std::array<Follower, 3> others{Follower(*trails[1]), Follower(*trails[2]), Follower(*trails[3])};
  const auto points = trails[0]->points();
  std::vector<Piece> beam;
  beam.reserve(points.size());
  double before = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Waypoint& point = points[i];
    const Vec3d place = wide(point.place);
    const bool first = i == 0 || points[i - 1].stretch != point.stretch;
    const bool last = i + 1 == points.size() || points[i + 1].stretch != point.stretch;
    double square = 0.0;
    const auto reach_to = [&](Vec3d other) {
      square = std::max(square, dot(other - place, other - place));
    };
    for (Follower& other : others) {
      if (first) other.enter(point.stretch);
      reach_to(other.place(point.length));
      if (last) reach_to(other.last());
    }
    const double apart = widening * std::sqrt(square);
    if (!first) {
      const Waypoint& begin = points[i - 1];
      const double aside = 2.0 * stray(begin, point) + 1e-6 * length(place);
      Piece& piece = beam.emplace_back();
      piece.from = wide(begin.place);
      piece.to = place;
      piece.from_radius = before + aside;
      piece.to_radius = apart + aside;
      piece.middle = (piece.from + piece.to) * 0.5;
      piece.reach = length(piece.to - piece.middle) + std::max(piece.from_radius, piece.to_radius);
      piece.stretch = point.stretch;
      piece.begun = begin.length;
      piece.ended = point.length;
      piece.last = last;
    }
    before = apart;
  }
  mark_ends(beam);
  return beam;
}

/// What a stretch begins or ends at, its beam touches there: on as much of the way as the places
/// lie apart where the four ways come from it, or meet it.
void BeamGuard::mark_ends(std::vector<Piece>& beam) {
  for (std::size_t i = 0; i < beam.size();) {
    std::size_t end = i;
    while (!beam[end].last) ++end;
    const double leaving = 2.0 * beam[i].from_radius, arriving = 2.0 * beam[end].to_radius;
    const float first = beam[i].begun, final = beam[end].ended;
    for (; i <= end; ++i) {
      beam[i].leaves = beam[i].begun - first <= leaving;
      beam[i].arrives = final - beam[i].ended <= arriving;
    }
  }
}

bool BeamGuard::met(const Obstacle& obstacle, const Piece& piece, const Trail& trail,
                    const Arrival& end) const {
  const bool last = piece.stretch == trail.crossings();
  if (obstacle.kind != Met::portal_back)
    return piece.arrives && last && end.met == obstacle.kind && end.object == obstacle.index;
  const auto portals = space_->portals.portals();
  return (piece.arrives && !last && trail.portal_after(piece.stretch) == obstacle.index) ||
         (piece.leaves && piece.stretch > 0 &&
          portals[trail.portal_after(piece.stretch - 1)].pair == obstacle.index);
}

bool BeamGuard::touches(const Piece& piece, const Obstacle& obstacle, int halvings) {
  const double radius = std::max(piece.from_radius, piece.to_radius);
  const auto* quad = obstacle.shape ? std::get_if<Quad>(obstacle.shape) : nullptr;
  if (quad && beside_plane(*quad, piece.from, piece.to, radius)) return false;
  const Vec3d nearest = closest_on_segment(piece.from, piece.to, obstacle.center);
  if (length(nearest - obstacle.center) > obstacle.radius + radius) return false;
  if (obstacle.shape) {
    const Segment segment{piece.from, piece.to};
    const auto clearance = [&](const auto& shape) { return shape.clearance(segment); };
    if (std::visit(clearance, *obstacle.shape) > radius) return false;
  }
  if (halvings == 0) return true;
  Piece first = piece, second = piece;
  first.to = second.from = (piece.from + piece.to) * 0.5;
  first.to_radius = second.from_radius = 0.5 * (piece.from_radius + piece.to_radius);
  return touches(first, obstacle, halvings - 1) || touches(second, obstacle, halvings - 1);
}

bool BeamGuard::along_border(const std::vector<Piece>& beam) const {
  for (const Mass& mass : space_->masses) {
    if (std::isinf(mass.influence) || mass.gm == 0.0) continue;
    double least = std::numeric_limits<double>::infinity(), radius = 0.0;
    for (const Piece& piece : beam) {
      if (length(piece.middle - mass.center) - piece.reach < least) {
        const Vec3d nearest = closest_on_segment(piece.from, piece.to, mass.center);
        const double distance = length(nearest - mass.center);
        if (distance < least)
          least = distance, radius = std::max(piece.from_radius, piece.to_radius);
      }
      if (!piece.last) continue;
      if (std::fabs(least - mass.influence) <= 2.0 * radius) return true;
      least = std::numeric_limits<double>::infinity();
    }
  }
  return false;
}

bool BeamGuard::clear(const std::array<const Trail*, 4>& trails, const Arrival& end) const {
  const std::vector<Piece> beam = beam_of(trails);
  if (along_border(beam)) return false;
  for (const Obstacle& obstacle : obstacles_)
    for (const Piece& piece : beam)
      if (!apart(piece, obstacle) && !met(obstacle, piece, *trails[0], end) &&
          touches(piece, obstacle, most_halvings))
        return false;
  return true;
}

}  // namespace portalens
