#include "photon/beam_sections.h"

#include <cmath>
#include <cstring>

namespace portalens {
namespace {

/// The beam is taken wider than the four path records are from its middle.
constexpr float widening = 1.1f;

Reached reached(const Waypoint& point) {
  static_assert(offsetof(Waypoint, place) == 0 && offsetof(Waypoint, length) == 12);
  Reached found;
  std::memcpy(&found, &point, sizeof found);
  return found;
}

/// Goes along a path beside another.
class Follower {
 public:
  explicit Follower(const PathRecord& record) : points_(record.points()) {}

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

}  // namespace

Beam::Beam(const std::array<const PathRecord*, 4>& records) {
  std::array<Follower, 3> others{Follower(*records[1]), Follower(*records[2]),
                                 Follower(*records[3])};
  const auto points = records[0]->points();
  Reached from{};
  float before = 0.0f;
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
    Reached to = sum * 0.25f;
    to[3] = point.length;
    float square = square_of_place(here - to);
    for (std::size_t k = 0; k < 3; ++k) {
      square = std::max(square, square_of_place(places[k] - to));
      if (first) square = std::max(square, square_of_place(begun[k] - to));
      if (last) square = std::max(square, square_of_place(others[k].last() - to));
    }
    const float apart = widening * std::sqrt(square);
    if (!first) add(from, to, point.turning - points[i - 1].turning, before, apart, point, last);
    from = to;
    before = apart;
  }
  mark_ends();
}

void Beam::add(Reached from, Reached to, float turning, float from_radius, float to_radius,
               const Waypoint& point, bool last) {
  BeamSection& section = pieces_[count_++];
  const float length = to[3] - from[3];
  const float rounding = 2e-6f * (std::fabs(to[0]) + std::fabs(to[1]) + std::fabs(to[2]));
  // Twice as far as a path can be from the straight one between two of its points.
  const float aside = 0.5f * length * turning + rounding;
  section.from = from;
  section.to = to;
  section.from_radius = from_radius + aside;
  section.to_radius = to_radius + aside;
  // The path is no shorter than the straight one.
  section.reach = 0.5f * length + rounding + section.radius();
  section.stretch = point.stretch;
  section.last = last;
}

/// Marks the sections in which a stretch leaves the face where it begins, or meets the face where
/// it ends. The four paths do so at different lengths, up to the beam's width apart.
void Beam::mark_ends() {
  for (std::size_t i = 0; i < count_;) {
    std::size_t end = i;
    while (!pieces_[end].last) ++end;
    const float leaving = 2.0f * pieces_[i].from_radius, arriving = 2.0f * pieces_[end].to_radius;
    const float first = pieces_[i].from[3], final = pieces_[end].to[3];
    for (; i <= end; ++i) {
      pieces_[i].leaves = pieces_[i].from[3] - first <= leaving;
      pieces_[i].arrives = final - pieces_[i].to[3] <= arriving;
    }
  }
}

}  // namespace portalens
