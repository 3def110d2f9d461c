#include "gravity/shortest_way.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "gravity/way_formulas.h"

namespace portalens {

namespace {

/// Lengths of paths over the insides of edges that differ by less than this share are a tie.
constexpr double tie = 1e-13;

/// Where, as a share of its length, the segment from a to b crosses the face from front to back;
/// negative if it doesn't. Ends are given in the face's coordinates.
double straight_through(const PortalFace& face, Vec3d a, Vec3d b) {
  if (a.z < -face.height_tolerance() || b.z > face.height_tolerance()) return -1.0;
  const double above = std::max(a.z, 0.0), below = std::max(-b.z, 0.0);
  const double t = above > 0.0 ? above / (above + below) : 0.0;
  const bool crosses = face.covers(a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t);
  return crosses ? t : -1.0;
}

/// Edges, or the whole rim of an ellipse.
std::uint32_t rim_pieces(const PortalFace& face) {
  return face.ellipse() ? 1 : static_cast<std::uint32_t>(face.edges().size());
}

/// A piece of the rim, in the face's coordinates or in space.
Slide slide_on(const Ellipse& ellipse, const Frame& frame) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {frame.origin, frame.right * ellipse.a(), -infinity, infinity,
          true,         frame.up * ellipse.b()};
}
Slide local_slide(const Ellipse& ellipse) {
  return slide_on(ellipse, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
}
Slide slide_of(const PortalFace& face, std::uint32_t piece) {
  if (const Ellipse* ellipse = face.ellipse()) return slide_on(*ellipse, face.frame());
  const FaceEdge& edge = face.edges()[piece];
  return {edge.start, edge.direction, 0.0, edge.length};
}

Turn rim_turn(const PortalFace& face, std::uint32_t edge, double place) {
  if (face.ellipse()) {
    constexpr double sectors = 16.0;
    const double turns = place / (2.0 * std::numbers::pi);
    const double share = turns - std::floor(turns);
    return {Turn::Kind::edge, static_cast<std::uint32_t>(share * sectors), place};
  }
  const auto count = static_cast<std::uint32_t>(face.edges().size());
  if (place <= 0.0) return {Turn::Kind::vertex, edge};
  if (place >= face.edges()[edge].length) return {Turn::Kind::vertex, (edge + 1) % count};
  return {Turn::Kind::edge, edge};
}

/// The best way over one piece of the rim; ends in the face's coordinates.
RimWay<double> over_piece(const PortalFace& face, std::uint32_t piece, Vec3d a, Vec3d b) {
  if (const Ellipse* ellipse = face.ellipse()) {
    const CurvePlace best = least_places(local_slide(*ellipse), a, b).front();
    return {best.length, best.angle};
  }
  const FaceEdge& edge = face.edges()[piece];
  const double outside_a = edge.outside(a.x, a.y), outside_b = edge.outside(b.x, b.y);
  const BesideLine<double> ends{edge.along(a.x, a.y), std::sqrt(outside_a * outside_a + a.z * a.z),
                                edge.along(b.x, b.y), std::sqrt(outside_b * outside_b + b.z * b.z)};
  return over_rim(ends, edge.length);
}

/// One face: straight, or the best of its edges.
bool shortest_by_one(Vec3d from, Vec3d to, const PortalFace& face, double limit, Turn& out) {
  const Vec3d a = face.frame().to_local(from), b = face.frame().to_local(to);
  if (straight_through(face, a, b) >= 0.0) {
    out = straight_on;
    const Vec3d apart = b - a;
    return dot(apart, apart) < limit * limit;
  }
  double best = limit;
  bool found = false;
  for (std::uint32_t i = 0; i < rim_pieces(face); ++i) {
    const RimWay<double> way = over_piece(face, i, a, b);
    const Turn turn = rim_turn(face, i, way.place);
    const bool between_insides =
        found && turn.kind == Turn::Kind::edge && out.kind == Turn::Kind::edge;
    if (!(way.length < best * (between_insides ? 1.0 - tie : 1.0))) continue;
    best = way.length;
    out = turn;
    found = true;
  }
  return found;
}

/// How far a place is from the part of a plane that a corner at the origin, with those sides,
/// opens.
double from_corner(Vec3d first, Vec3d second, Vec3d place) {
  const Vec3d normal = cross(first, second);
  const double size = length(normal);
  if (size > 0.0 && dot(cross(normal, first), place) >= 0.0 &&
      dot(cross(second, normal), place) >= 0.0)
    return std::fabs(dot(normal, place)) / size;
  const auto from_ray = [&](Vec3d ray) {
    const double along = std::max(0.0, dot(place, ray) / dot(ray, ray));
    return length(place - ray * along);
  };
  return std::min(from_ray(first), from_ray(second));
}

/// How far `a` may move, at the least, before a straight way through the face begins or ceases;
/// ends are given in the face's coordinates. It is straight from in front of the face, within the
/// pyramid over it whose top is `b`.
double clear_line(const PortalFace& face, Vec3d a, Vec3d b) {
  const double tolerance = face.height_tolerance(), height = a.z + tolerance;
  if (b.z > tolerance) return std::numeric_limits<double>::infinity();
  if (b.z >= 0.0) return 0.0;
  if (!face.is_convex_polygon()) {
    if (height < 0.0) return -height;
    const std::vector<Vec3d> outline = outline_of(face.aperture());
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3d &from = outline[i], &to = outline[(i + 1) % outline.size()];
      least = std::min(
          least, from_corner(Vec3d{from.x, from.y, 0.0} - b, Vec3d{to.x, to.y, 0.0} - b, a - b));
    }
    // The outline of an ellipse lies about it.
    if (face.ellipse()) {
      const double wider = 1e-3 * size_of(face.aperture()) * std::max(1.0, length(a - b) / -b.z);
      least = std::max(0.0, least - wider);
    }
    return straight_through(face, a, b) >= 0.0 ? std::min(least, height) : least;
  }
  double outside = -std::numeric_limits<double>::infinity();
  for (const FaceEdge& edge : face.edges()) {
    const Vec3d start{edge.start_x, edge.start_y, 0.0};
    const Vec3d normal = cross({edge.direction_x, edge.direction_y, 0.0}, start - b);
    outside = std::max(outside, dot(normal, a - start) / length(normal));
  }
  if (height < 0.0) return std::max(-height, outside);
  return outside <= 0.0 ? std::min(-outside, height) : outside;
}

/// How much longer than the shortest way round an ellipse that over a place far from it is.
double lead_round(const Ellipse& ellipse, Vec3d a, Vec3d b) {
  constexpr double far = std::numbers::pi / 3.0;
  const Slide rim = local_slide(ellipse);
  const std::vector<CurvePlace> places = least_places(rim, a, b);
  double second = std::numeric_limits<double>::infinity();
  if (places.size() > 1) second = places[1].length;
  for (double angle = far; angle < 2.0 * std::numbers::pi - far; angle += 0.1) {
    const Vec3d y = rim.at(places[0].angle + angle);
    second = std::min(second, length(y - a) + length(b - y));
  }
  return second - places[0].length;
}

/// How much longer than the shortest path over the rim that over another feature is.
double lead_over_rim(const PortalFace& face, Vec3d a, Vec3d b) {
  if (const Ellipse* ellipse = face.ellipse()) return lead_round(*ellipse, a, b);
  double least = std::numeric_limits<double>::infinity(), second = least;
  Turn best = straight_on;
  for (std::uint32_t i = 0; i < face.edges().size(); ++i) {
    const RimWay<double> way = over_piece(face, i, a, b);
    const Turn turn = rim_turn(face, i, way.place);
    const bool better = way.length < least;
    // A vertex is met along two edges.
    if (turn.code() != best.code()) second = std::min(second, better ? least : way.length);
    if (better) best = turn, least = way.length;
  }
  return second - least;
}

/// Branch and bound over which faces are passed by which edges.
class Search {
 public:
  Search(Vec3d from, Vec3d to, FaceRow faces, double limit, Turns& best)
      : faces_(faces), cutoff_(limit), best_(best) {
    way_.from = from;
    way_.to = to;
    choice_.fill(open);
  }

  [[nodiscard]] bool run() {
    guess();
    explore();
    return found_;
  }

 private:
  static constexpr std::int32_t open = -1;      ///< nothing is asked of the face yet
  static constexpr std::int32_t straight = -2;  ///< it must be passed straight in the end

  /// What stands against the path as it is: a face to decide next, or none.
  struct Verdict {
    bool legal = true;
    std::size_t next = max_chain;
  };

  /// Bounds the search by the length of some allowed path: each face in turn is passed as is best
  /// between its neighbours.
  void guess() {
    std::array<Vec3d, max_chain> points;
    for (std::size_t i = 0; i < faces_.size(); ++i) points[i] = faces_[i]->frame().origin;
    for (int sweep = 0; sweep < 2; ++sweep)
      for (std::size_t i = 0; i < faces_.size(); ++i) {
        const PortalFace& face = *faces_[i];
        const Vec3d& before = i > 0 ? points[i - 1] : way_.from;
        const Vec3d& after = i + 1 < faces_.size() ? points[i + 1] : way_.to;
        const Vec3d a = face.frame().to_local(before), b = face.frame().to_local(after);
        const double t = straight_through(face, a, b);
        choice_[i] = t >= 0.0 ? open : 0;
        points[i] = before + (after - before) * t;
        if (t >= 0.0) continue;
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t e = 0; e < rim_pieces(face); ++e) {
          const RimWay<double> way = over_piece(face, e, a, b);
          if (!(way.length < least)) continue;
          least = way.length;
          choice_[i] = static_cast<std::int32_t>(e);
          points[i] = slide_of(face, e).at(way.place);
        }
      }
    if (relax() && judge().legal) cutoff_ = std::min(cutoff_, way_.total() * (1.0 + 1e-12));
    choice_.fill(open);
  }

  void explore() {
    if (!relax()) return;
    const double length = way_.total();
    if (!(length < cutoff_)) return;
    const Verdict verdict = judge();
    if (verdict.legal) {
      keep(length);
      return;
    }
    if (verdict.next == max_chain) return;
    const std::size_t i = verdict.next;
    const PortalFace& face = *faces_[i];
    const Vec3d a = face.frame().to_local(way_.from), b = face.frame().to_local(way_.to);
    for (std::uint32_t edge = 0; edge < rim_pieces(face); ++edge) {
      if (!(over_piece(face, edge, a, b).length < cutoff_)) continue;
      choice_[i] = static_cast<std::int32_t>(edge);
      explore();
    }
    choice_[i] = straight;
    const auto end = choice_.begin() + static_cast<std::ptrdiff_t>(faces_.size());
    if (std::find(choice_.begin(), end, open) != end) explore();
    choice_[i] = open;
  }

  /// The shortest path over the chosen edges that ignores all other faces.
  /// @return false if it can't be short enough
  bool relax() {
    way_.count = 0;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (choice_[i] < 0) continue;
      const Slide slide = slide_of(*faces_[i], static_cast<std::uint32_t>(choice_[i]));
      way_.slides[way_.count] = slide;
      way_.places[way_.count] =
          slide.curved ? best_place(slide, way_.from, way_.to) : 0.5 * slide.high;
      ++way_.count;
    }
    return shorten(way_, cutoff_);
  }

  /// Whether the path runs straight through all the faces that it has no edge of; if not, the face
  /// to branch on: one that it misses, else, if a face that must be passed straight is missed,
  /// any that is open.
  [[nodiscard]] Verdict judge() const {
    Verdict verdict;
    std::size_t bend = 0, missed_open = max_chain, any_open = max_chain;
    Vec3d last = way_.from, next = bend < way_.count ? way_.point(bend) : way_.to;
    double reached = 0.0;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (choice_[i] >= 0) {
        last = next;
        ++bend;
        next = bend < way_.count ? way_.point(bend) : way_.to;
        reached = 0.0;
        continue;
      }
      const Frame& frame = faces_[i]->frame();
      const double t = straight_through(*faces_[i], frame.to_local(last), frame.to_local(next));
      const bool passed = t >= reached - 1e-12;
      if (passed) reached = std::max(reached, t);
      if (!passed) verdict.legal = false;
      if (choice_[i] == open) any_open = i;
      if (choice_[i] == open && !passed && missed_open == max_chain) missed_open = i;
    }
    verdict.next = missed_open < max_chain ? missed_open : any_open;
    return verdict;
  }

  void keep(double length) {
    Turns turns;
    bool insides = true;
    std::size_t bend = 0;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      turns[i] = straight_on;
      if (choice_[i] < 0) continue;
      turns[i] = rim_turn(*faces_[i], static_cast<std::uint32_t>(choice_[i]), way_.places[bend++]);
      insides = insides && turns[i].kind == Turn::Kind::edge;
    }
    const double margin = insides && best_insides_ ? tie * best_length_ : 0.0;
    if (found_ && !(length < best_length_ - margin)) return;
    std::copy(turns.begin(), turns.begin() + faces_.size(), best_.begin());
    best_length_ = length;
    cutoff_ = std::min(cutoff_, length * (1.0 + tie));
    best_insides_ = insides;
    found_ = true;
  }

  FaceRow faces_;
  double cutoff_;  ///< paths must be shorter
  Turns& best_;
  double best_length_ = std::numeric_limits<double>::infinity();
  bool best_insides_ = false, found_ = false;
  std::array<std::int32_t, max_chain> choice_;
  Polyline way_;
};

}  // namespace

bool shortest_passages(Vec3d from, Vec3d to, FaceRow faces, double limit, Turns& out) {
  if (faces.size() == 1) return shortest_by_one(from, to, *faces[0], limit, out[0]);
  return Search(from, to, faces, limit, out).run();
}

double clear_passage(Vec3d from, Vec3d to, const PortalFace& face) {
  const Vec3d a = face.frame().to_local(from), b = face.frame().to_local(to);
  const double sight = clear_line(face, a, b);
  if (straight_through(face, a, b) >= 0.0) return sight;
  // Both lengths change by no more than the place does.
  return std::min(sight, 0.5 * lead_over_rim(face, a, b));
}

Polyline bends(Vec3d from, Vec3d to, FaceRow faces, const Turns& turns) {
  Polyline way;
  way.from = from;
  way.to = to;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (turns[i].kind == Turn::Kind::straight) continue;
    if (const Ellipse* ellipse = faces[i]->ellipse()) {
      way.slides[way.count] = slide_on(*ellipse, faces[i]->frame());
      way.places[way.count++] = turns[i].angle;
      continue;
    }
    const FaceEdge& edge = faces[i]->edges()[turns[i].index];
    const bool fixed = turns[i].kind == Turn::Kind::vertex;
    way.slides[way.count] = {edge.start, edge.direction, fixed ? 0.0 : -infinity,
                             fixed ? 0.0 : infinity};
    way.places[way.count] = fixed ? 0.0 : 0.5 * edge.length;
    ++way.count;
  }
  shorten(way, infinity);
  return way;
}

Way follow(Vec3d from, Vec3d to, FaceRow faces, const Turns& turns) {
  const Polyline way = bends(from, to, faces, turns);
  return {way.total(), way.count > 0 ? way.point(0) : to, way.count == 0};
}

}  // namespace portalens
