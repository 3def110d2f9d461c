#include "gravity/way_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "gravity/rim_ways.h"

namespace portalens {
namespace {

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
    const double margin = insides && best_insides_ ? length_tie * best_length_ : 0.0;
    if (found_ && !(length < best_length_ - margin)) return;
    std::copy(turns.begin(), turns.begin() + faces_.size(), best_.begin());
    best_length_ = length;
    cutoff_ = std::min(cutoff_, length * (1.0 + length_tie));
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

bool search_passages(Vec3d from, Vec3d to, FaceRow faces, double limit, Turns& out) {
  return Search(from, to, faces, limit, out).run();
}

}  // namespace portalens
