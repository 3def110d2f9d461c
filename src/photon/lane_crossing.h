/// \file
/// Over lanes: the masses that are alone in their influence, crossed by table in one step
/// (gravity/crossing_table.h).
#pragma once

#include "gravity/crossing_formulas.h"
#include "photon/lane_border.h"
#include "photon/lane_path.h"
#include "photon/lane_rectangle.h"
#include "photon/lane_scene.h"

namespace portalens {

/// Where straight ways enter the influence of lone masses.
template <class R>
class LaneCrossing {
 public:
  using Mask = typename R::Mask;
  using V = Vec3<R>;

  R reach{never};  ///< how far it is to the first of them
  Mask inside;     ///< the way begins within one, and not at its rim

  /// @param x, t  of the ways
  LaneCrossing(const LaneScene& scene, V x, V t) : inside(R(1) < R(0)), scene_(scene), t_(t) {
    const R slack(scene.overshoot);
    for (int k = 0; k < scene.lone_count; ++k) {
      const LaneLone& lone = scene.lone[k];
      const V to_mass = spread<R>(lone.center) - x;
      const R along = dot(to_mass, t);
      const V aside = to_mass - t * along;
      const R half2 = R(lone.influence2) - dot(aside, aside);
      const Mask meets = half2 > R(scene.graze2);
      if (!any(meets)) continue;
      const R half = sqrt(max(half2, R(0)));
      const R begin = along - half;
      inside = inside | (meets & (begin <= -slack) & (along + half > slack));
      const Mask enters = meets & (along > R(0)) & (begin > -slack) & (begin < reach);
      reach = select(enters, begin, reach);
      which_ = select(enters, R(k), which_);
      half_ = select(enters, half, half_);
      aside_ = {select(enters, aside.x, aside_.x), select(enters, aside.y, aside_.y),
                select(enters, aside.z, aside_.z)};
    }
    reach = max(reach, R(0.01) * slack);
  }

  /// What becomes of lanes that cross.
  struct Passage {
    V place, direction;
    R length{0}, turning{0};
    R object{-1};
    R captured{0};  ///< 1 where they end on the horizon
  };

  /// @param which  the lanes that came to the rim
  [[nodiscard]] Passage pass(Mask which) const {
    Passage passage;
    const R b2 = dot(aside_, aside_);
    const V inwards = aside_ * (R(1) / sqrt(max(b2, R(1e-30))));
    for (int k = 0; k < scene_.lone_count; ++k) {
      const Mask here = which & (which_ == R(k));
      if (any(here)) cross(here, k, sqrt(b2), inwards, passage);
    }
    return passage;
  }

 private:
  void cross(Mask here, int k, R b, V inwards, Passage& passage) const {
    const LaneLone& lone = scene_.lone[k];
    const R per_radius(lone.per_influence);
    const CrossingRange<R> range{R(lone.range.capture), R(lone.range.scale), R(lone.range.stretch)};
    const R impact = b * per_radius;
    const Mask falls = impact < range.capture;
    // What is captured has no place among what passes.
    const auto falling = captured_place(range, impact);
    const auto passing = passing_place(range, max(impact, range.capture), half_ * per_radius);
    const R factor = select(falls, falling.factor, passing.factor);
    const Values found = look_up(here, lone, select(falls, falling.cell, passing.cell));

    const R tangent = found.half_tangent * factor, tangent2 = tangent * tangent;
    const R scale = R(1) / (R(1) + tangent2);
    const R cosine = (R(1) - tangent2) * scale, sine = R(2) * tangent * scale;
    const V out = t_ * cosine + inwards * sine, in = inwards * cosine - t_ * sine;
    const R horizon(lone.horizon);
    const R ahead = select(falls, -horizon * falling.cell * R(1.0 / captured_cells), half_);
    const R away = select(falls, horizon * falling.factor, b);
    const V place = spread<R>(lone.center) + out * ahead - in * away;
    put(here, place, passage.place);
    put(here, unit(out), passage.direction);
    put(here, found.length * select(falls, R(1), factor) * R(lone.influence), passage.length);
    put(here, found.turning * factor, passage.turning);
    put(here, R(most_lane_masses + k), passage.object);
    put(here, select(falls, R(1), R(0)), passage.captured);
  }

  struct Values {
    R half_tangent, turning, length;
  };

  /// What a cell holds of one power.
  struct Four {
    using Floats = float __attribute__((vector_size(16)));
    Floats values;

    static Four load(const float* at) {
      Four four;
      __builtin_memcpy(&four.values, at, sizeof four.values);
      return four;
    }
    friend Four operator+(Four a, Four b) { return {a.values + b.values}; }
    friend Four operator*(Four a, float s) { return {a.values * s}; }
  };

  /// Lane by lane: what one needs lies together.
  [[nodiscard]] static Values look_up(Mask here, const LaneLone& lone, R cell) {
    alignas(64) float cells[R::lanes], out[3][R::lanes] = {};
    // What is no number looks at the last.
    constexpr double last = captured_cells + passing_cells - 1e-4;
    max(min(cell, R(last)), R(0)).store(cells);
    for (std::uint32_t rest = bits(here); rest != 0; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      const int first = static_cast<int>(cells[lane]);
      const float u = cells[lane] - static_cast<float>(first);
      const float* at = lone.cells + floats_per_cell * first;
      const Four four =
          Four::load(at) +
          (Four::load(at + 4) + (Four::load(at + 8) + Four::load(at + 12) * u) * u) * u;
      for (int c = 0; c < 3; ++c) out[c][lane] = four.values[c];
    }
    return {R::load(out[0]), R::load(out[1]), R::load(out[2])};
  }

  static void put(Mask where, R value, R& to) { to = select(where, value, to); }
  static void put(Mask where, V value, V& to) {
    put(where, value.x, to.x);
    put(where, value.y, to.y);
    put(where, value.z, to.z);
  }

  const LaneScene& scene_;
  V t_;
  R which_{-1}, half_{0};
  V aside_{R(0), R(0), R(0)};  ///< from the way to the mass, at right angles
};

}  // namespace portalens
