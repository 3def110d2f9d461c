/// \file
/// Over lanes: the masses that are alone in their influence, crossed by table in one step
/// (gravity/crossing_table.h).
#pragma once

#include "gravity/crossing_formulas.h"
#include "lanes/border.h"
#include "lanes/face_axes.h"
#include "lanes/four.h"
#include "lanes/path.h"
#include "lanes/scene.h"

namespace portalens {

/// Where straight paths enter the influence of isolated masses.
template <class R>
class LaneCrossing {
 public:
  using Mask = typename R::Mask;
  using V = Vec3<R>;

  R reach;      ///< how far it is to the first of them, or to the end of the step before
  Mask enters;  ///< the first of them comes before the end
  Mask inside;  ///< the path begins within one, and not at its rim

  /// Says nothing before it has sought.
  explicit LaneCrossing(const LaneScene& scene) : scene_(scene) {}

  /// @param x, t  of the paths
  /// @param flies, h  those that are straight, and where they end
  void seek(V x, V t, Mask flies, R h) {
    const R slack(scene_.overshoot);
    t_ = t;
    reach = h;
    enters = inside = R(1) < R(0);
    which_ = half_ = R(0);
    aside_ = {R(0), R(0), R(0)};
    for (int k = 0; k < scene_.isolated_count; ++k) {
      const LaneIsolated& isolated = scene_.isolated[k];
      const V to_mass = spread<R>(isolated.center) - x;
      const R along = dot(to_mass, t);
      const V aside = to_mass - t * along;
      const R half2 = R(isolated.influence2) - dot(aside, aside);
      const Mask meets = flies & (half2 > R(scene_.graze2));
      if (!any(meets)) continue;
      const R half = sqrt(max(half2, R(0)));
      const R begin = along - half;
      inside = inside | (meets & (begin <= -slack) & (along + half > slack));
      const Mask nearer = meets & (along > R(0)) & (begin > -slack) & (begin < reach);
      enters = enters | nearer;
      reach = select(nearer, begin, reach);
      which_ = select(nearer, R(k), which_);
      half_ = select(nearer, half, half_);
      aside_ = {select(nearer, aside.x, aside_.x), select(nearer, aside.y, aside_.y),
                select(nearer, aside.z, aside_.z)};
    }
    reach = select(enters, max(reach, R(0.01) * slack), reach);
  }

  /// What becomes of lanes that cross.
  struct Passage {
    V place, direction;
    R length, turning;  ///< 0 in other lanes
    R gain;             ///< radians that it turns more by, for each length that it is nearer, about
    R object;
    Mask captured;  ///< they end on the horizon
  };

  /// Of the lanes that still are said to enter; of no others is anything told.
  [[nodiscard]] Passage pass() const {
    const Mask here = enters;
    const Masses masses(scene_, here, which_);
    const CrossingRange<R> range{R::load(masses.capture), R::load(masses.scale),
                                 R::load(masses.stretch)};
    const R influence = R::load(masses.influence), per_radius = R(1) / influence;
    const R b2 = dot(aside_, aside_), b = sqrt(b2), impact = b * per_radius;
    const V inwards = aside_ * (R(1) / sqrt(max(b2, R(1e-30))));
    const Mask falls = impact < range.capture;
    // What is captured has no place among what passes.
    const auto falling = captured_place(range, impact);
    const auto passing = passing_place(range, max(impact, range.capture), half_ * per_radius);
    const R factor = select(falls, falling.factor, passing.factor);
    const Values found = look_up(here, masses, select(falls, falling.cell, passing.cell));

    const R tangent = found.half_tangent * factor, tangent2 = tangent * tangent;
    const R scale = R(1) / (R(1) + tangent2);
    const R cosine = (R(1) - tangent2) * scale, sine = R(2) * tangent * scale;
    const V out = t_ * cosine + inwards * sine, in = inwards * cosine - t_ * sine;
    const R horizon = R::load(masses.horizon);
    const R ahead = select(falls, -horizon * falling.cell * R(1.0 / captured_cells), half_);
    const R away = select(falls, horizon * falling.factor, b);
    const V center{R::load(masses.x), R::load(masses.y), R::load(masses.z)};
    const R none(0), turning = select(here, found.turning * factor, none);
    // Of α = a/b that is α/b, and where α = -ln(b - b_c) nears capture, no more.
    const R above_capture = max(impact - range.capture, R(1e-6)) * influence;
    return {center + out * ahead - in * away,
            unit(out),
            select(here, found.length * select(falls, R(1), factor) * influence, none),
            turning,
            select(here & !falls, turning / above_capture, none),
            which_ + R(first_isolated_object),
            here & falls};
  }

 private:
  /// The masses that lanes cross, lane by lane.
  struct alignas(64) Masses {
    float x[R::lanes] = {}, y[R::lanes] = {}, z[R::lanes] = {};
    float influence[R::lanes] = {}, horizon[R::lanes] = {};
    float capture[R::lanes] = {}, scale[R::lanes] = {}, stretch[R::lanes] = {};
    const float* cells[R::lanes];

    Masses(const LaneScene& scene, Mask here, R which) {
      float indices[R::lanes];
      which.store(indices);
      for (std::uint32_t rest = bits(here); rest != 0; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        const LaneIsolated& isolated = scene.isolated[static_cast<int>(indices[lane])];
        x[lane] = isolated.center.x;
        y[lane] = isolated.center.y;
        z[lane] = isolated.center.z;
        influence[lane] = isolated.influence;
        horizon[lane] = isolated.horizon;
        capture[lane] = isolated.range.capture;
        scale[lane] = isolated.range.scale;
        stretch[lane] = isolated.range.stretch;
        cells[lane] = isolated.cells;
      }
    }
  };

  struct Values {
    R half_tangent, turning, length;
  };

  /// What a cell holds of one power.
  using Four = LaneFour<R>;

  /// Lane by lane: what one needs lies together.
  [[nodiscard]] static Values look_up(Mask here, const Masses& masses, R cell) {
    alignas(64) float cells[R::lanes], out[3][R::lanes] = {};
    // What is no number looks at the last.
    constexpr double last = captured_cells + passing_cells - 1e-4;
    max(min(cell, R(last)), R(0)).store(cells);
    for (std::uint32_t rest = bits(here); rest != 0; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      const int first = static_cast<int>(cells[lane]);
      const float u = cells[lane] - static_cast<float>(first);
      const float* at = masses.cells[lane] + floats_per_cell * first;
      const Four four =
          Four::load(at) +
          (Four::load(at + 4) + (Four::load(at + 8) + Four::load(at + 12) * u) * u) * u;
      for (int c = 0; c < 3; ++c) out[c][lane] = four.values[c];
    }
    return {R::load(out[0]), R::load(out[1]), R::load(out[2])};
  }

  const LaneScene& scene_;
  V t_;
  R which_, half_;
  V aside_;  ///< from the path to the mass, at right angles
};

}  // namespace portalens
