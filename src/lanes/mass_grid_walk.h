/// \file
/// Over lanes: which balls of many masses (lanes/scene.h) a place lies in, and which a path comes
/// to next. Lane by lane through the grid, as lanes are apart; many balls of a cube at a time.
#pragma once

#include <cstdint>

#include "lanes/border.h"
#include "lanes/marks.h"
#include "lanes/path.h"
#include "lanes/scene.h"

namespace portalens {

/// 0, 1, 2…: as many as the widest pack has lanes.
inline constexpr float natural_numbers[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10,
                                            11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
                                            22, 23, 24, 25, 26, 27, 28, 29, 30, 31};

/// One of the balls for each lane; of radius 0 where there is none.
template <class R>
struct LaneBall {
  Vec3<R> center;
  R radius2;
};

/// What a path comes to.
template <class R>
struct LaneAhead {
  R entry;   ///< how far it is to the next ball that it does not begin in, or `never`
  R missed;  ///< at what distance it passes by balls, at the least
};

/// Paths through the grid.
template <class R>
class LaneMassGrid {
 public:
  using Mask = typename R::Mask;
  using V = Vec3<R>;

  /// @param ahead  whether they lie in a ball is decided that far ahead
  LaneMassGrid(const LaneManyMasses& many, V x, V t, float ahead) : many_(many), ahead_(ahead) {
    store(x, at_);
    store(t, along_);
  }

  /// Marks the masses in whose balls the places lie.
  /// @return of which lanes not all are marked: those in too many
  [[nodiscard]] Mask mark(LaneMarks<R>& marks) const {
    const int most = many_.count > max_lane_near ? max_lane_own : max_lane_near;
    alignas(64) float lacking[R::lanes];
    for (int lane = 0; lane < R::lanes; ++lane) {
      lacking[lane] = mark_about(lane, most, marks) ? 0.0f : 1.0f;
    }
    return R::load(lacking) > R(0);
  }

  /// Of the paths x + t s + bend s²/2; what is farther than `limit` need not be found.
  [[nodiscard]] LaneAhead<R> look_ahead(V bend, R limit) const {
    alignas(64) float bent[3][R::lanes], chords[3][R::lanes], found[R::lanes], missed[R::lanes];
    store(bend, bent);
    store(multiply_add(bend, R(0.5) * limit,
                       V{R::load(along_[0]), R::load(along_[1]), R::load(along_[2])}),
          chords);
    limit.store(found);
    for (int lane = 0; lane < R::lanes; ++lane) {
      const V bend_here{R(bent[0][lane]), R(bent[1][lane]), R(bent[2][lane])};
      const float chord[3] = {chords[0][lane], chords[1][lane], chords[2][lane]};
      found[lane] = first_on(lane, bend_here, chord, found[lane], missed[lane]);
    }
    return {R::load(found), R::load(missed)};
  }

  /// As a share of the step, where the paths of `which` enter a ball that they don't begin in; 2
  /// where they enter none.
  /// @param over  how far past a border a step ends
  [[nodiscard]] R first_entry(Mask which, const LanePath<R>& path, R over) const {
    alignas(64) float found[R::lanes], chords[3][R::lanes];
    R(2).store(found);
    store(path.place.at(R(1)) - path.place.c0, chords);
    for (std::uint32_t rest = bits(which); rest != 0; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      const float chord[3] = {chords[0][lane], chords[1][lane], chords[2][lane]};
      const LanePath<R> here = path.of(lane);
      const R last = last_look(here, of_lane(over, lane));
      for (Walk walk(*this, lane, chord); walk.goes_on(); walk.go_on()) {
        const float share = first_of_cube(lane, walk.cell(), here, last);
        if (share < found[lane]) found[lane] = share;
        if (!(walk.end() < 1.0f && walk.end() < found[lane])) break;
      }
    }
    return R::load(found);
  }

  /// Of each lane of `which` the ball in which `end` lies the deepest and its path does not begin,
  /// if there is one.
  [[nodiscard]] LaneBall<R> entered(Mask which, V end) const {
    alignas(64) float ends[3][R::lanes], ball[4][R::lanes] = {};
    store(end, ends);
    for (std::uint32_t rest = bits(which); rest != 0; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      const std::uint32_t k = deepest_about(lane, ends[0][lane], ends[1][lane], ends[2][lane]);
      if (k == no_ball) continue;
      ball[0][lane] = many_.x[k];
      ball[1][lane] = many_.y[k];
      ball[2][lane] = many_.z[k];
      ball[3][lane] = many_.reach2[k];
    }
    return {{R::load(ball[0]), R::load(ball[1]), R::load(ball[2])}, R::load(ball[3])};
  }

 private:
  static void store(V value, float (&out)[3][R::lanes]) {
    value.x.store(out[0]);
    value.y.store(out[1]);
    value.z.store(out[2]);
  }

  /// A lane's path, in all lanes.
  struct Way {
    V x, t;
    Way(const LaneMassGrid& grid, int lane)
        : x{R(grid.at_[0][lane]), R(grid.at_[1][lane]), R(grid.at_[2][lane])},
          t{R(grid.along_[0][lane]), R(grid.along_[1][lane]), R(grid.along_[2][lane])} {}
  };

  /// Balls of a cube, one a lane, as seen from a path: those from the `first` on.
  struct Balls {
    V to_middle;
    R square, towards, reach2;
    Mask there;   ///< before the end of the cube's
    Mask within;  ///< the path begins in them

    Balls(const LaneMassGrid& grid, const Way& way, std::uint32_t first, std::uint32_t end)
        : to_middle(V{R::load(grid.many_.x + first), R::load(grid.many_.y + first),
                      R::load(grid.many_.z + first)} -
                    way.x),
          square(dot(to_middle, to_middle)),
          towards(dot(to_middle, way.t)),
          reach2(R::load(grid.many_.reach2 + first)),
          there(R::load(natural_numbers) < R(static_cast<float>(end - first))),
          within(there & (subtract_product(square, R(2) * R(grid.ahead_), towards) < reach2)) {}
  };

  /// The cubes along a straight path from where a lane is.
  class Walk {
   public:
    /// @param chord  its direction
    Walk(const LaneMassGrid& grid, int lane, const float* chord) : many_(grid.many_) {
      const float low[3] = {many_.low.x, many_.low.y, many_.low.z};
      const int counts[3] = {many_.cells_x, many_.cells_y, many_.cells_z};
      float enters = 0.0f, leaves = never;
      for (int a = 0; a < 3; ++a) {
        const float t = chord[a];
        Axis& axis = axes_[a];
        axis = {counts[a], 0, t < 0.0f ? -1 : 1, low[a] - grid.at_[a][lane], 0.0f, 0.0f};
        axis.per_way = 1.0f / (t < 0.0f ? (t < -1e-20f ? t : -1e-20f) : (t > 1e-20f ? t : 1e-20f));
        const float one = axis.low * axis.per_way;
        const float other = axis.border(counts[a], many_.size) * axis.per_way;
        const float near = one < other ? one : other, far = one < other ? other : one;
        enters = near > enters ? near : enters;
        leaves = far < leaves ? far : leaves;
      }
      goes_on_ = enters <= leaves;
      if (!goes_on_) return;
      for (int a = 0; a < 3; ++a) {
        Axis& axis = axes_[a];
        const float along = (chord[a] * enters - axis.low) * many_.per_size;
        const auto last = static_cast<float>(axis.count - 1);
        axis.at = static_cast<int>(along > 0.0f ? (along < last ? along : last) : 0.0f);
        axis.look_ahead(many_.size);
      }
    }
    [[nodiscard]] bool goes_on() const { return goes_on_; }
    [[nodiscard]] int cell() const {
      return (axes_[2].at * axes_[1].count + axes_[1].at) * axes_[0].count + axes_[0].at;
    }
    /// How far along the way the cube ends.
    [[nodiscard]] float end() const {
      const float end = axes_[0].next < axes_[1].next ? axes_[0].next : axes_[1].next;
      return end < axes_[2].next ? end : axes_[2].next;
    }
    void go_on() {
      const float s = end();
      Axis& axis = s == axes_[0].next ? axes_[0] : (s == axes_[1].next ? axes_[1] : axes_[2]);
      axis.at += axis.turn;
      goes_on_ = axis.at >= 0 && axis.at < axis.count;
      axis.look_ahead(many_.size);
    }

   private:
    struct Axis {
      int count, at, turn;  ///< of the cubes, which one, and which way on
      float low;            ///< from the start of the path
      float per_way;        ///< length of path for a length along the axis
      float next;           ///< how far along the way the cube ends on this axis

      [[nodiscard]] float border(int index, float size) const {
        return low + static_cast<float>(index) * size;
      }
      void look_ahead(float size) { next = border(turn > 0 ? at + 1 : at, size) * per_way; }
    };

    const LaneManyMasses& many_;
    Axis axes_[3];
    bool goes_on_;
  };

  /// The cube that the place lies in, or -1.
  [[nodiscard]] int cell_about(float x, float y, float z) const {
    x = (x - many_.low.x) * many_.per_size;
    y = (y - many_.low.y) * many_.per_size;
    z = (z - many_.low.z) * many_.per_size;
    const bool within =
        x >= 0.0f && y >= 0.0f && z >= 0.0f && x < static_cast<float>(many_.cells_x) &&
        y < static_cast<float>(many_.cells_y) && z < static_cast<float>(many_.cells_z);
    if (!within) return -1;
    return (static_cast<int>(z) * many_.cells_y + static_cast<int>(y)) * many_.cells_x +
           static_cast<int>(x);
  }

  /// @return false if there are more than `most`
  [[nodiscard]] bool mark_about(int lane, int most, LaneMarks<R>& marks) const {
    const int cell = cell_about(at_[0][lane], at_[1][lane], at_[2][lane]);
    if (cell < 0) return true;
    const Way way(*this, lane);
    const std::uint32_t end = many_.begins[cell + 1];
    int own = 0;
    for (std::uint32_t first = many_.begins[cell]; first < end; first += R::lanes) {
      const Mask within = Balls(*this, way, first, end).within;
      if (!any(within)) continue;
      for (std::uint32_t rest = bits(within); rest != 0; rest &= rest - 1) {
        if (++own > most) return false;
        marks.add(many_.which[first + static_cast<std::uint32_t>(__builtin_ctz(rest))]);
      }
    }
    return true;
  }

  static constexpr std::uint32_t no_ball = ~std::uint32_t{0};

  [[nodiscard]] std::uint32_t deepest_about(int lane, float x, float y, float z) const {
    const int cell = cell_about(x, y, z);
    if (cell < 0) return no_ball;
    const Way way(*this, lane);
    const V end{R(x), R(y), R(z)};
    const std::uint32_t last = many_.begins[cell + 1];
    float most = 0.0f;
    std::uint32_t deepest = no_ball;
    for (std::uint32_t first = many_.begins[cell]; first < last; first += R::lanes) {
      const Balls balls(*this, way, first, last);
      const V from = balls.to_middle + way.x - end;
      const R depth = balls.reach2 - dot(from, from);
      const Mask entered = balls.there & !balls.within & (depth > R(0));
      if (!any(entered)) continue;
      alignas(64) float depths[R::lanes];
      depth.store(depths);
      for (std::uint32_t rest = bits(entered); rest != 0; rest &= rest - 1) {
        const int k = __builtin_ctz(rest);
        if (!(depths[k] > most)) continue;
        most = depths[k];
        deepest = first + static_cast<std::uint32_t>(k);
      }
    }
    return deepest;
  }

  /// Of the balls of one cube: where a path enters the first, up to the share `last`; else 2.
  /// @param path  of one lane, in all
  [[nodiscard]] float first_of_cube(int lane, int cell, const LanePath<R>& path, R last) const {
    const Way way(*this, lane);
    const std::uint32_t end = many_.begins[cell + 1];
    float least = 2.0f;
    for (std::uint32_t first = many_.begins[cell]; first < end; first += R::lanes) {
      const Balls balls(*this, way, first, end);
      const LaneDistance<R> outside{path, balls.to_middle + way.x, balls.reach2};
      const R nearest = min(outside.nearest(), last);
      const Mask enters =
          balls.there & !balls.within & (nearest > R(0)) & (outside.at(nearest) < R(0));
      if (!any(enters)) continue;
      const R guess = outside.surface_from(nearest, R(-1));
      alignas(64) float shares[R::lanes];
      crossing(enters, outside, guess, R(1), R(0), nearest).store(shares);
      for (std::uint32_t rest = bits(enters); rest != 0; rest &= rest - 1) {
        const float share = shares[__builtin_ctz(rest)];
        least = share < least ? share : least;
      }
    }
    return least;
  }

  /// Of one lane; `never` where nothing comes before the limit.
  /// @param[out] missed  at what distance it passes by balls, at the least
  [[nodiscard]] float first_on(int lane, V bend, const float* chord, float limit,
                               float& missed) const {
    const Way way(*this, lane);
    const R most(limit);
    float least = limit;
    R passes(never);
    for (Walk walk(*this, lane, chord); walk.goes_on(); walk.go_on()) {
      const int cell = walk.cell();
      const std::uint32_t end = many_.begins[cell + 1];
      for (std::uint32_t first = many_.begins[cell]; first < end; first += R::lanes) {
        const Balls balls(*this, way, first, end);
        // The place of the parabola that is nearest to the middle, or nearly.
        const R near = min(max(balls.towards, R(0)), most);
        const V bent = bend * near, direction = way.t + bent;
        const V from = balls.to_middle - (way.t + bent * R(0.5)) * near;
        const R along = dot(from, direction), speed2 = dot(direction, direction);
        const R distance2 = max(dot(from, from) - along * along / speed2, R(0));
        const Mask comes = balls.there & !balls.within & (balls.towards > R(0));
        const R inside = balls.reach2 - distance2;
        passes = min(passes, select(comes & (inside <= R(0)), sqrt(distance2) - sqrt(balls.reach2),
                                    R(never)));
        const Mask meets = comes & (inside > R(0));
        if (!any(meets)) continue;
        // Straight on from the start if that meets it, else straight back from there; then a step
        // of Newton's method. A guess that is too late is mended after the step.
        const R off = balls.square - balls.reach2;
        const R straight = balls.towards * balls.towards - off;
        const R root = sqrt(max(select(straight > R(0), straight, inside * speed2), R(0)));
        const R middle = near + along / speed2;
        const R guess = select(straight > R(0), balls.towards - root, middle - root / speed2);
        const V there = balls.to_middle - (way.t + bend * (R(0.5) * guess)) * guess;
        const R slope = dot(there, way.t + bend * guess);
        const R better = guess + (dot(there, there) - balls.reach2) / (slope + slope);
        alignas(64) float found[R::lanes];
        select((better > R(0)) & (better <= max(near, middle)), better, near * R(0.5)).store(found);
        for (std::uint32_t rest = bits(meets); rest != 0; rest &= rest - 1) {
          const float s = found[__builtin_ctz(rest)];
          least = s < least ? s : least;
        }
      }
      if (!(walk.end() < least)) break;
    }
    alignas(64) float distances[R::lanes];
    passes.store(distances);
    missed = distances[0];
    for (const float distance : distances) missed = distance < missed ? distance : missed;
    return least < limit ? least : never;
  }

  const LaneManyMasses& many_;
  float ahead_;
  alignas(64) float at_[3][R::lanes];
  alignas(64) float along_[3][R::lanes];
};

}  // namespace portalens
