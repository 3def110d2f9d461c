#include "photon/beam.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <variant>

#include "geometry/closest_point.h"

namespace portalens {
namespace {

/// More would take longer than the photons that are saved.
constexpr std::size_t most_obstacles = 256;
/// The beam is taken wider than the four trails are from its middle.
constexpr double widening = 1.1;
/// How often a piece of a beam is halved that comes near an obstacle.
constexpr int most_halvings = 5;

/// A place, and how long the way to it is.
using Reached = float __attribute__((vector_size(16)));

Reached reached(const Waypoint& point) {
  static_assert(offsetof(Waypoint, place) == 0 && offsetof(Waypoint, length) == 12);
  Reached found;
  std::memcpy(&found, &point, sizeof found);
  return found;
}
Vec3d place_of(Reached at) { return {at[0], at[1], at[2]}; }
float square_between(Reached a, Reached b) {
  const Reached d = a - b, squares = d * d;
  return squares[0] + squares[1] + squares[2];
}

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
  [[nodiscard]] Reached place(float length) {
    Reached a = reached(points_[at_]);
    if (length <= a[3]) return a;
    for (; more(); ++at_) {
      const Reached b = reached(points_[at_ + 1]);
      if (!(b[3] < length)) return a + (b - a) * ((length - a[3]) / (b[3] - a[3]));
      a = b;
    }
    return a;
  }
  [[nodiscard]] Reached here() const { return reached(points_[at_]); }
  [[nodiscard]] Reached last() {
    while (more()) ++at_;
    return reached(points_[at_]);
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
    // In pieces of four corners, or three.
    const std::vector<Vec3d>& corners = portals[i].vertices;
    for (std::size_t k = 1; k + 1 < corners.size(); k += 2) {
      const std::array<Vec3d, 4> piece = {corners[0], corners[k], corners[k + 1],
                                          corners[std::min(k + 2, corners.size() - 1)]};
      const std::size_t count = std::min<std::size_t>(4, corners.size() - k + 1);
      const Quad face(std::span<const Vec3d>(piece).first(count));
      add(&faces_.emplace_back(face), face.bounds(), Met::portal_back, i);
    }
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
  Reached from{};
  double before = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Waypoint& point = points[i];
    const bool first = i == 0 || points[i - 1].stretch != point.stretch;
    const bool last = i + 1 == points.size() || points[i + 1].stretch != point.stretch;
    const Reached here = reached(point);
    std::array<Reached, 3> places, begun{};
    Reached sum = here;
    for (std::size_t k = 0; k < 3; ++k) {
      if (first) {
        others[k].enter(point.stretch);
        begun[k] = others[k].here();
      }
      places[k] = others[k].place(point.length);
      sum += places[k];
    }
    const Reached to = sum * 0.25f;
    float square = square_between(here, to);
    for (std::size_t k = 0; k < 3; ++k) {
      square = std::max(square, square_between(places[k], to));
      if (first) square = std::max(square, square_between(begun[k], to));
      if (last) square = std::max(square, square_between(others[k].last(), to));
    }
    const double apart = widening * double{std::sqrt(square)};
    if (!first) {
      const Waypoint& begin = points[i - 1];
      Piece& piece = beam.emplace_back();
      piece.from = place_of(from);
      piece.to = place_of(to);
      const double rounding =
          1e-6 * (std::fabs(piece.to.x) + std::fabs(piece.to.y) + std::fabs(piece.to.z));
      const double aside = 2.0 * stray(begin, point) + rounding;
      piece.from_radius = before + aside;
      piece.to_radius = apart + aside;
      piece.middle = (piece.from + piece.to) * 0.5;
      // The way is no shorter than the straight one.
      piece.reach = 0.5 * double{point.length - begin.length} + rounding +
                    std::max(piece.from_radius, piece.to_radius);
      piece.stretch = point.stretch;
      piece.begun = begin.length;
      piece.ended = point.length;
      piece.last = last;
    }
    from = to;
    before = apart;
  }
  mark_ends(beam);
  return beam;
}

/// What a stretch begins or ends at, its beam touches there: on as much of the way as the places
/// lie apart where the four ways come from it, or meet it.
void BeamGuard::mark_ends(std::span<Piece> beam) {
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

bool BeamGuard::along_border(std::span<const Piece> beam) const {
  for (std::size_t begin = 0; begin < beam.size();) {
    std::size_t end = begin;
    while (!beam[end++].last) continue;
    const auto stretch = beam.subspan(begin, end - begin);
    for (const Mass& mass : space_->masses)
      if (std::isfinite(mass.influence) && mass.gm != 0.0 &&
          along_sphere(stretch, mass.center, mass.influence))
        return true;
    begin = end;
  }
  return false;
}

/// Whether a sphere might be entered by some of the light, and not by all.
bool BeamGuard::along_sphere(std::span<const Piece> stretch, Vec3d center, double radius) {
  double widest = 0.0;
  for (const Piece& piece : stretch)
    widest = std::max({widest, piece.from_radius, piece.to_radius});
  // Mostly it begins far within.
  const double within = radius - 2.0 * widest;
  const auto square_to = [&](Vec3d place) { return dot(place - center, place - center); };
  if (within > 0.0 && square_to(stretch[0].from) < within * within) return false;
  double least = std::numeric_limits<double>::infinity(), wide = 0.0;
  for (const Piece& piece : stretch) {
    const double reach = least + piece.reach;
    if (square_to(piece.middle) >= reach * reach) continue;
    const double distance = length(closest_on_segment(piece.from, piece.to, center) - center);
    if (distance < least) least = distance, wide = std::max(piece.from_radius, piece.to_radius);
  }
  return std::fabs(least - radius) <= 2.0 * wide;
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
