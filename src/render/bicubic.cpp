#include "render/bicubic.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace portalens {
namespace {

template <class Four>
Vec3d part(Four values) {
  return {values[0], values[1], values[2]};
}

/// @pre its length is 1, or nearly
Vec3d unit(Vec3d a) {
  const double square = dot(a, a);
  // One step of Newton's method leaves 4e-11 of that, and is done in half the time.
  return std::fabs(square - 1.0) < 1e-5 ? a * (1.5 - 0.5 * square) : a * inverse_sqrt(square);
}

/// The weight of the turning beside the direction, in the square of a third difference: the turning
/// is only reported, and moves no light.
constexpr float turning_counts = 1.0f / 4.0f;

/// The largest third difference of directions, in tolerances. Beside where influences begin, as
/// beside a square root's zero, the polynomial errs by a fortieth of it. Where gravity through
/// portals bends sharply between two nodes it errs by a quarter and more.
double max_in_tolerances(const Space& space) {
  return std::holds_alternative<NoCoupling>(space.coupling) ? 400.0 : 40.0;
}

/// How much rougher what is absorbed may be.
constexpr double absorbed_may_differ = 8.0;

float in_float(double x) { return static_cast<float>(x); }

template <class Four>
Four four(Vec3d v, double last) {
  using Doubles = double __attribute__((vector_size(32)));
  const Doubles wide{v.x, v.y, v.z, last};
  return __builtin_convertvector(wide, Four);
}

/// What `size` says of the largest of the third differences along the rows and columns of sixteen.
/// What is no number counts as large.
template <class Value, class Size>
float largest_third(const Value& value, const Size& size) {
  float largest = 0.0f;
  const auto look = [&](std::size_t first, std::size_t step) {
    const float found = size(value(first + 3 * step) - value(first) +
                             (value(first + step) - value(first + 2 * step)) * 3.0f);
    largest = found <= largest ? largest : found;
  };
  for (std::size_t i = 0; i < 4; ++i) look(4 * i, 1), look(i, 4);
  return largest;
}

}  // namespace

bool Bicubic::can_tell(const Space& space, const Arrival& arrival) {
  if (arrival.fate == Fate::escaped || arrival.fate == Fate::absorbed) return true;
  if (arrival.fate != Fate::hit || arrival.met != Met::surface) return false;
  const Shape& shape = space.surfaces.shapes()[arrival.object];
  return std::holds_alternative<Quad>(shape) || std::holds_alternative<Sphere>(shape);
}

double Bicubic::through(const Space& space, const ProbeRays& probe_rays, const PixelSpan& pixel,
                        double most, double given_up) {
  const Arrival& model = *probe_rays[1][1];
  model_ = model;
  model_.steps = model_.handed_over = 0;
  const bool flat = model.fate == Fate::hit;
  sphere_ = flat ? std::get_if<Sphere>(&space.surfaces.shapes()[model.object]) : nullptr;
  std::array<Values, 16> values;
  for (std::size_t n = 0; n < 16; ++n) {
    const Arrival& probe_ray = *probe_rays[n / 4][n % 4];
    values[n].turn =
        four<Four>(probe_ray.direction - model.direction, probe_ray.turning - model.turning);
  }
  const auto square = [](Four v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; };
  const double turned = std::sqrt(largest_third(
      [&](std::size_t n) { return values[n].turn; },
      [&](Four third) { return square(third) + turning_counts * third[3] * third[3]; }));
  const double max_turn = std::min(most * (pixel.angle + pixel.aside / space.extent),
                                   max_in_tolerances(space) * space.physics.tolerance);
  double roughness = turned / max_turn;
  // Nothing is told of those but that they are absorbed; light may pass where they differ much.
  if (model.fate == Fate::absorbed) return roughness / absorbed_may_differ;
  if (!(roughness <= given_up)) return roughness;
  float reach = 0.0f;
  for (std::size_t n = 0; n < 16; ++n) {
    const Arrival& probe_ray = *probe_rays[n / 4][n % 4];
    const Vec3d aside = probe_ray.position - model.position;
    if (flat) {
      const double weight = model.length / probe_ray.length;
      reach = std::max(reach, in_float(dot(aside, aside)));
      values[n].place = four<Four>(aside * weight, weight - 1.0);
    } else {
      values[n].place = four<Four>(aside, probe_ray.length - model.length);
    }
  }
  if (flat) {
    reach = std::sqrt(reach);
    const double aside = largest_third(
        [&](std::size_t n) { return values[n].place; },
        [&](Four third) { return std::sqrt(square(third)) + reach * std::fabs(third[3]); });
    // The miss of a hit is measured in widths of a pixel at that length; in the sky only the
    // direction counts.
    const double share = aside / (most * (pixel.angle * model.length + pixel.aside));
    roughness = share <= roughness ? roughness : share;
  }
  if (!(roughness <= 1.0)) return roughness;
  std::array<Cubic, 4> rows;
  for (std::size_t j = 0; j < 4; ++j) {
    const Values* row = &values[4 * j];
    rows[j] = cubic_through(row[0], row[1], row[2], row[3]);
  }
  for (std::size_t k = 0; k < 4; ++k)
    cubics_[k] = cubic_through(rows[0][k], rows[1][k], rows[2][k], rows[3][k]);
  return roughness;
}

/// From Lagrange's polynomials over the nodes -1, 0, 1, 2.
Bicubic::Cubic Bicubic::cubic_through(const Values& before, const Values& first,
                                      const Values& second, const Values& after) {
  const Values bend = (before + second) * 0.5f - first;
  const Values twist = (after - before) * (1.0f / 6.0f) + (first - second) * 0.5f;
  return {first, second - first - bend - twist, bend, twist};
}

Bicubic::Values Bicubic::value(const Cubic& cubic, float at) {
  return ((cubic[3] * at + cubic[2]) * at + cubic[1]) * at + cubic[0];
}

Bicubic::Row::Row(const Bicubic& cell, double v)
    : cell_(cell), right_(in_float(cell.aside_.right)) {
  const float at = in_float(v - cell.aside_.down);
  for (std::size_t k = 0; k < 4; ++k) cubic_[k] = value(cell.cubics_[k], at);
}

void Bicubic::Row::tell(double u, Arrival& arrival) const {
  // Nothing is read from where it has just been written: that waits.
  const Arrival& model = cell_.model_;
  arrival = model;
  if (model.fate == Fate::absorbed) return;
  const Values sum = value(cubic_, in_float(u) - right_);
  arrival.direction = unit(model.direction + part(sum.turn));
  arrival.turning = model.turning + double{sum.turn[3]};
  if (model.fate == Fate::hit) {
    const double weight = 1.0 / (1.0 + double{sum.place[3]});
    arrival.position = model.position + part(sum.place) * weight;
    arrival.length = model.length * weight;
  } else {
    arrival.position = model.position + part(sum.place);
    arrival.length = model.length + double{sum.place[3]};
  }
  if (const Sphere* sphere = cell_.sphere_)
    arrival.position =
        sphere->center() + normalize(arrival.position - sphere->center()) * sphere->radius();
}

}  // namespace portalens
