#include "gravity/polyline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "gravity/way_formulas.h"

namespace portalens {

namespace {

using Row = std::array<double, max_chain>;

/// First and second derivatives of the length in the places; the second are tridiagonal.
struct Slope {
  Row gradient, diagonal, beside;  ///< beside[i] couples i and i + 1
};

double segment_length(Vec3d segment, double blur) {
  return std::sqrt(dot(segment, segment) + blur * blur);
}

/// How the point of a slide moves with its place: the first and second derivative.
struct Motion {
  Vec3d tangent, second;
  double square;  ///< of the tangent

  Motion(const Slide& slide, double place) : tangent(slide.direction), square(1.0) {
    if (!slide.curved) return;
    const double c = std::cos(place), s = std::sin(place);
    tangent = slide.across * c - slide.direction * s;
    second = -(slide.direction * c + slide.across * s);
    square = dot(tangent, tangent);
  }
};

double total_length(const Polyline& way, double blur) {
  double sum = 0.0;
  Vec3d last = way.from;
  for (std::size_t i = 0; i < way.count; ++i) {
    const Vec3d next = way.point(i);
    sum += segment_length(next - last, blur);
    last = next;
  }
  return sum + segment_length(way.to - last, blur);
}

Slope slope_of(const Polyline& way, double blur) {
  Slope slope;
  Vec3d last = way.from, here = way.point(0);
  Vec3d unit_before = here - last;
  double before = segment_length(unit_before, blur);
  unit_before = unit_before / before;
  for (std::size_t i = 0; i < way.count; ++i) {
    const bool inner = i + 1 < way.count;
    const Vec3d next = inner ? way.point(i + 1) : way.to;
    Vec3d unit_after = next - here;
    const double after = segment_length(unit_after, blur);
    unit_after = unit_after / after;
    const Motion motion(way.slides[i], way.places[i]);
    const Vec3d& d = motion.tangent;
    const double in = dot(d, unit_before), out = dot(d, unit_after), whole = motion.square;
    slope.gradient[i] = in - out;
    // A little more than the true curvature: flat directions then stay put.
    slope.diagonal[i] =
        (whole - in * in + 1e-11 * whole) / before + (whole - out * out + 1e-11 * whole) / after;
    if (way.slides[i].curved) {
      const double curl = dot(motion.second, unit_before - unit_after);
      slope.diagonal[i] =
          std::max(slope.diagonal[i] + curl, 1e-3 * whole * (1.0 / before + 1.0 / after));
    }
    if (inner) {
      const Vec3d e = Motion(way.slides[i + 1], way.places[i + 1]).tangent;
      slope.beside[i] = -(dot(d, e) - out * dot(e, unit_after)) / after;
    }
    last = here;
    here = next;
    before = after;
    unit_before = unit_after;
  }
  return slope;
}

/// The Newton step; places that press against an end of their slide stay there.
Row newton_step(const Polyline& way, Slope slope) {
  const auto held = [&](std::size_t i) {
    const Slide& slide = way.slides[i];
    return (way.places[i] <= slide.low && slope.gradient[i] >= 0.0) ||
           (way.places[i] >= slide.high && slope.gradient[i] <= 0.0);
  };
  for (std::size_t i = 0; i < way.count; ++i) {
    if (!held(i)) continue;
    slope.gradient[i] = 0.0;
    slope.diagonal[i] = 1.0;
    slope.beside[i] = 0.0;
    if (i > 0) slope.beside[i - 1] = 0.0;
  }
  for (std::size_t i = 1; i < way.count; ++i) {
    const double factor = slope.beside[i - 1] / slope.diagonal[i - 1];
    slope.diagonal[i] -= factor * slope.beside[i - 1];
    slope.gradient[i] -= factor * slope.gradient[i - 1];
  }
  Row step;
  double next = 0.0;
  for (std::size_t i = way.count; i-- > 0;) {
    const double coupled = i + 1 < way.count ? slope.beside[i] * next : 0.0;
    next = (-slope.gradient[i] - coupled) / slope.diagonal[i];
    step[i] = next;
  }
  return step;
}

/// Newton's method with the corners of the length rounded off by `blur`.
void descend(Polyline& way, double blur) {
  double here = total_length(way, blur);
  for (int round = 0; round < 40; ++round) {
    const Row step = newton_step(way, slope_of(way, blur));
    const Row start = way.places;
    double moved = 0.0;
    bool better = false;
    for (double share = 1.0; share > 1e-9 && !better; share *= 0.5) {
      moved = 0.0;
      for (std::size_t i = 0; i < way.count; ++i) {
        const Slide& slide = way.slides[i];
        way.places[i] = std::clamp(start[i] + share * step[i], slide.low, slide.high);
        moved = std::max(moved, std::fabs(way.places[i] - start[i]) * slide.scale());
      }
      const double there = total_length(way, blur);
      better = there <= here * (1.0 + 1e-15);
      if (better) here = there;
    }
    if (!better) {
      way.places = start;
      return;
    }
    if (moved <= 1e-12 * here) return;
  }
}

/// True if some segment has shrunk to almost nothing: there the length has a corner.
bool cornered(const Polyline& way, double size) {
  Vec3d last = way.from;
  for (std::size_t i = 0; i <= way.count; ++i) {
    const Vec3d next = i < way.count ? way.point(i) : way.to;
    if (length(next - last) < 1e-4 * size) return true;
    last = next;
  }
  return false;
}

/// The length is convex, so it lies above its tangent plane everywhere; not so round ellipses.
/// @pre all slides end
double least_possible(const Polyline& way, double size, double blur) {
  for (std::size_t i = 0; i < way.count; ++i)
    if (way.slides[i].curved) return -std::numeric_limits<double>::infinity();
  const Slope slope = slope_of(way, blur);
  double least = size - blur * static_cast<double>(way.count + 1);
  for (std::size_t i = 0; i < way.count; ++i) {
    const double g = slope.gradient[i];
    least += g * ((g > 0.0 ? way.slides[i].low : way.slides[i].high) - way.places[i]);
  }
  return least;
}

}  // namespace

double best_place(const Slide& slide, Vec3d a, Vec3d b) {
  if (slide.curved) return least_places(slide, a, b).front().angle;
  const double along_a = dot(a - slide.start, slide.direction);
  const double along_b = dot(b - slide.start, slide.direction);
  const BesideLine<double> ends{along_a, length(a - slide.at(along_a)), along_b,
                                length(b - slide.at(along_b))};
  return std::clamp(ends.meeting(), slide.low, slide.high);
}

double follow_curve(const Slide& slide, double place, Vec3d a, Vec3d b) {
  const auto over = [&](double at) {
    const Vec3d y = slide.at(at);
    return length(y - a) + length(b - y);
  };
  double here = over(place);
  for (int round = 0; round < 60; ++round) {
    const Motion motion(slide, place);
    const Vec3d y = slide.at(place), to_a = y - a, to_b = y - b;
    const double from = length(to_a), on = length(to_b);
    if (!(from > 0.0) || !(on > 0.0)) return place;
    const Vec3d both = to_a / from + to_b / on;
    const double in = dot(motion.tangent, to_a) / from, out = dot(motion.tangent, to_b) / on;
    const double first = in + out, most = motion.square * (1.0 / from + 1.0 / on);
    const double second = (motion.square - in * in) / from + (motion.square - out * out) / on +
                          dot(motion.second, both);
    const bool bowl = second > 1e-6 * most;
    double by = std::clamp(-first / (bowl ? second : most), -0.3, 0.3);
    double there = over(place + by);
    for (int k = 0; k < 8 && there > here * (1.0 + 1e-15); ++k) {
      by *= 0.4;
      there = over(place + by);
    }
    place += by;
    here = there;
    if (std::fabs(by) < (bowl ? 1e-9 : 1e-14)) return place;
  }
  return place;
}

std::vector<CurvePlace> least_places(const Slide& slide, Vec3d a, Vec3d b) {
  constexpr std::size_t count = 32;
  constexpr double step = 2.0 * std::numbers::pi / count;
  std::array<double, count> lengths;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d y = slide.at(static_cast<double>(i) * step);
    lengths[i] = length(y - a) + length(b - y);
  }
  std::vector<CurvePlace> found;
  for (std::size_t i = 0; i < count; ++i) {
    if (lengths[i] > lengths[(i + 1) % count] || lengths[i] >= lengths[(i + count - 1) % count])
      continue;
    const double angle = follow_curve(slide, static_cast<double>(i) * step, a, b);
    const Vec3d y = slide.at(angle);
    found.push_back({angle, length(y - a) + length(b - y)});
  }
  if (found.empty()) found.push_back({0.0, lengths[0]});  // from the axis of a circle
  std::stable_sort(found.begin(), found.end(), [](const CurvePlace& p, const CurvePlace& q) {
    return p.length < q.length * (1.0 - 1e-13);
  });
  return found;
}

double Polyline::total() const { return total_length(*this, 0.0); }

bool shorten(Polyline& way, double limit) {
  const int sweeps = way.count > 1 ? 2 : 1;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t i = 0; i < way.count; ++i) {
      const Vec3d before = i == 0 ? way.from : way.point(i - 1);
      const Vec3d after = i + 1 < way.count ? way.point(i + 1) : way.to;
      way.places[i] = way.slides[i].curved
                          ? follow_curve(way.slides[i], way.places[i], before, after)
                          : best_place(way.slides[i], before, after);
    }
  if (way.count < 2) return true;
  const double size = way.total(), blur = 1e-14 * size;
  if (size > limit && least_possible(way, size, blur) > limit) return false;
  if (cornered(way, size)) {
    for (double coarse = 1e-2; coarse > 1e-11; coarse *= 1e-2) descend(way, coarse * size);
  } else {
    descend(way, blur);
  }
  return true;
}

}  // namespace portalens
