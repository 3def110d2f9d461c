/// \file
/// One step of every lane: the default integrator over packs, with the events it may end in.
#pragma once

#include "lanes/any_face.h"
#include "lanes/coupled.h"
#include "lanes/crossing.h"
#include "lanes/few_masses.h"
#include "lanes/gates.h"
#include "lanes/graviton_map.h"
#include "lanes/many_masses.h"
#include "lanes/meetings.h"
#include "lanes/outline_rim.h"
#include "lanes/shortest_path.h"
#include "lanes/simple_outline.h"

namespace portalens {

/// @tparam F  the field: `LaneMasses`, or what has its members
template <class R, class F>
class LaneStepper {
 public:
  using Mask = typename R::Mask;
  using V = Vec3<R>;

  LaneStepper(const LaneScene& scene, Lanes& lanes, int first)
      : scene_(scene), pack_(scene, lanes, first) {}

  /// Bit i where lane `first` + i ends in an event.
  std::uint32_t step() {
    const Mask live = pack_.read(&Lanes::live) > R(0);
    if (!any(live)) return 0;
    const V x = pack_.position(), t = pack_.direction();
    F field(scene_);
    field.decide(x, t);
    const StateOf<R> here{x, t};
    const Mask flies = !field.acting;
    const BendingOf<R> start = field.bending(x, t);
    LaneCrossing<R> isolated(scene_);
    const Reach reach = foresee(field, here, start, flies, isolated);

    const auto acceleration = [&](V place) { return field.acceleration(place); };
    const Bends<R> bends = Radau::bends(acceleration, here, start.acceleration, reach.length);
    LanePath<R> path(here, bends, reach.length);
    const Judgement judgement = judge(here, path, bends, start, flies);
    if constexpr (F::foresees_planes) mend_length(reach, judgement.smooth() & !flies, path);

    Course course;
    course.resigns = live & must_resign(field, start, x, reach.most, flies);
    LaneFinding<R> found = meet(here, path, field, flies, isolated, course);
    settle(path, field, live, flies, judgement, found, course);
    course.escapes = live & flies & (reach.border.at >= R(never)) & !(found.share <= R(1)) &
                     !(course.consults | course.resigns);
    if (has_isolated()) {
      isolated.enters = live & isolated.enters & !(course.consults | course.resigns | course.ends);
      course.escapes = course.escapes & !isolated.enters;
    }
    std::uint32_t seen = 0;
    if (scene_.box_count > 0) {
      course.sees = course.sees & live & !(course.consults | course.resigns | course.again);
      const R share = select(course.sees, select(course.ends, found.share, R(1)), R(0));
      seen = pack_.show(path, share, !(flies | judgement.smooth()));
    }
    const Mask stays = course.stays() | !live;
    pack_.write(&Lanes::longest, select(live, course.next, R(never)));

    typename LanePack<R>::Move move = to_end(here, path, found.share, course.ends);
    move.clear = course.clear;
    move.gradient = start.shear;
    if constexpr (!F::Weight::uniform)
      move.gradient = select(start.sinking > R(0), R(0), move.gradient);
    move.error = R(scene_.tolerance) * select(flies, R(0), judgement.error);
    R crossed(0);
    const bool crosses = has_isolated() && any(isolated.enters);
    if (crosses) crossed = cross(isolated, move, found);
    const Mask within = pack_.take(move, stays);

    R event = select(live & !course.again & !within, code(LaneEvent::limit), R(0));
    if (crosses) {
      const Mask counts = (event == R(0)) | (crossed == code(LaneEvent::horizon));
      event = select(isolated.enters & counts, crossed, event);
    }
    return tell(event, found, course) | seen;
  }

 private:
  /// How far a step is to go.
  struct Reach {
    R most;                ///< no step is longer, whatever borders there are
    LaneBorder<R> border;  ///< the first place where a decision changes
    R length;
  };
  /// What its own parts say of a step (`Radau::roughness`).
  struct Judgement {
    R error;      ///< its roughness where a path is judged as the scene says
    R roughness;  ///< the same as this path is judged, more strictly if it is taken again
    R next;       ///< how long the next step may be
    [[nodiscard]] Mask smooth() const { return roughness <= R(Radau::smooth); }
  };
  /// What becomes of a step.
  struct Course {
    Mask resigns;   ///< the path is left to others
    Mask consults;  ///< the scalar engine is to take this step
    Mask again;     ///< it is taken again, shorter
    Mask ends;      ///< it ends within, in what was found
    Mask escapes;   ///< nothing is ahead
    Mask doubtful;  ///< lanes can't judge it
    Mask sees;      ///< its path may meet what boxes hold
    R next;         ///< how long the next step may be
    R clear;        ///< nothing that boxes hold is met within that much path from its end
    [[nodiscard]] Mask stays() const { return consults | resigns | escapes | again; }
  };

  [[nodiscard]] static R code(LaneEvent event) { return LanePack<R>::code(event); }
  /// Scenes without isolated masses pay for a branch.
  [[nodiscard]] bool has_isolated() const { return scene_.isolated_count > 0; }

  [[nodiscard]] Reach foresee(F& field, const StateOf<R>& here, const BendingOf<R>& start,
                              Mask flies, LaneCrossing<R>& isolated) const {
    const V x = here.position, t = here.direction;
    Reach reach;
    reach.most =
        min(longest(x, start, flies), select(flies, R(never), pack_.read(&Lanes::longest)));
    reach.border = field.boundary(x, t, turning_part(start.acceleration, t), reach.most);
    // What is decided holds from slightly ahead on: a border nearer than that is past.
    reach.length = min(reach.most, max(reach.border.at + R(scene_.overshoot), R(scene_.ahead)));
    if (has_isolated()) {
      isolated.seek(x, t, flies, reach.length);
      reach.length = isolated.reach;
    }
    return reach;
  }

  /// How long a step may be before borders cut it: what the field allows, or, where nothing acts,
  /// out of the scene.
  [[nodiscard]] R longest(V x, const BendingOf<R>& start, Mask flies) const {
    const R proposed = Radau::propose(start.stiffness, start.nearness, R(scene_.stiffness_weight),
                                      R(scene_.nearness_weight));
    return select(flies, span(x) + R(scene_.radius),
                  min(proposed * pack_.read(&Lanes::shorter), R(scene_.farthest)));
  }

  [[nodiscard]] Judgement judge(const StateOf<R>& here, const LanePath<R>& path,
                                const Bends<R>& bends, const BendingOf<R>& start,
                                Mask flies) const {
    const R pull2 = dot(start.acceleration, start.acceleration);
    Judgement judgement;
    judgement.error =
        Radau::roughness(Radau::doubt(here, bends, path.h, path.turn), pull2, start.gradient,
                         path.h, R(scene_.third_weight), R(scene_.feedback_weight));
    judgement.roughness = judgement.error * pack_.read(&Lanes::judged);
    judgement.next = R(never);
    if (any(judgement.roughness > R(Radau::smooth)))
      judgement.next = select(flies, judgement.next,
                              Radau::longest_after(path.h, judgement.roughness, judgement.next));
    return judgement;
  }

  /// A border was foreseen as if the path bent evenly. A step that ends a little before or past the
  /// plane that it was to end behind, ends there now: as near to its end its path is as exact.
  void mend_length(const Reach& reach, Mask may, LanePath<R>& path) const {
    constexpr double max_share = 1.0 / 32.0;
    const R h = path.h;
    const R height =
        reach.border.height + dot(path.end.position - path.place.c0, reach.border.normal);
    const R more = R(scene_.overshoot) - height / dot(path.end.direction, reach.border.normal);
    const Mask mends = may & (reach.border.at < h) & (abs(more) < h * R(max_share)) &
                       (h + more <= reach.most) & (h > R(64) * R(scene_.overshoot));
    if (any(mends)) path.stretch(mends, R(1) + more / h);
  }

  [[nodiscard]] Mask must_resign(const F& field, const BendingOf<R>& start, V x, R most,
                                 Mask flies) const {
    const Mask winds = pack_.read(&Lanes::steps) > R(max_lane_steps);
    // Borders are exact to `overshoot` only: steps hardly longer are left to the scalar engine.
    Mask crawls = (most < R(4) * R(scene_.overshoot)) & !flies;
    if constexpr (!F::Weight::uniform) crawls = crawls & !(start.sinking > R(0));
    return winds | field.too_near(x) | crawls;
  }

  /// What the step meets first, and where lanes can't tell.
  [[nodiscard]] LaneFinding<R> meet(const StateOf<R>& here, LanePath<R>& path, const F& field,
                                    Mask flies, const LaneCrossing<R>& isolated,
                                    Course& course) const {
    const V x = here.position;
    Mask& doubtful = course.doubtful;
    doubtful = flies & (span(x) > R(F::sees_borders_far_off ? scene_.flight_limit : -1.0f));
    // Out there nothing is ahead of a path that leads further out.
    if (F::sees_borders_far_off && any(doubtful))
      doubtful = doubtful & (dot(x, here.direction) < R(0));
    course.clear = pack_.read(&Lanes::clear) - path.h;
    LaneFinding<R> found;
    const LaneMeetings<R> meetings(scene_, pack_);
    meetings.find_horizons(path, field, found, course.resigns);
    if constexpr (requires { F::Weight::greatest_potential; })
      meetings.find_depth(path, field, found);
    meetings.find_portals(path, found);
    meetings.find_polygons(path, found, doubtful);
    meetings.find_spheres(path, found);
    course.sees = meetings.find_boxes(path, course.clear, doubtful);
    if (has_isolated())
      doubtful = doubtful | isolated.inside | (isolated.enters & may_end_within());
    if constexpr (F::may_lack_room) doubtful = doubtful | field.lacks_room;
    path.met = min(found.share, R(1));
    return found;
  }

  /// Whether a path may reach a limit before it has crossed the influence of an isolated mass.
  [[nodiscard]] Mask may_end_within() const {
    constexpr double max_turned = 1.6;  // by one mass
    return (pack_.read(&Lanes::length) + R(scene_.farthest) > R(scene_.max_length)) |
           (pack_.read(&Lanes::turning) + R(max_turned) > R(scene_.max_turning));
  }

  /// Decides which steps are taken again, left to the scalar engine, or end within.
  void settle(const LanePath<R>& path, const F& field, Mask live, Mask flies,
              const Judgement& judgement, LaneFinding<R>& found, Course& course) const {
    course.next = judgement.next;
    course.again = live & (judgement.roughness > R(Radau::roughest)) & !(flies | course.resigns);
    if constexpr (F::may_lack_room) course.again = course.again & !field.lacks_room;
    find_change(path, field, live & !(flies | course.again | course.resigns | course.doubtful),
                found, course.doubtful);
    course.consults = live & course.doubtful & !(course.again | course.resigns);
    course.ends = (found.share <= R(1)) & live & !(course.consults | course.again | course.resigns);
    // Within a step a path is not as exact as at its end: where that counts, it is gone again.
    const Mask cut = course.ends & (found.share < R(0.98)) &
                     !(flies | judgement.smooth() | (found.event == code(LaneEvent::horizon)));
    if (!any(cut)) return;
    course.next = select(cut, path.h * found.share * R(1.002), course.next);
    course.again = course.again | cut;
    course.ends = course.ends & !cut;
  }

  /// Ends the step where what acts changes, if `boundary` has not foreseen it. A straight flight
  /// ends where it has.
  void find_change(const LanePath<R>& path, const F& field, Mask which, LaneFinding<R>& found,
                   Mask& doubtful) const {
    if (!any(which)) return;
    const R over(scene_.overshoot);
    FirstMeeting<R> first;
    // Decisions are made slightly ahead of the start: a step that is hardly longer than that, or
    // that meets something so soon, needs no search.
    const Mask soon = (found.share <= R(1)) & (path.met * path.h < R(8) * R(scene_.ahead));
    field.find_changes(first, which & (path.h > R(8) * over) & !soon, path, over);
    doubtful = doubtful | first.missed;
    // So close before what it meets, a step's end might be rounded to behind that.
    const R past = first.share + over / path.h;
    const Mask apart = past + R(8) * R(scene_.ahead) / path.h < found.share;
    found.offer((first.share <= R(1)) & apart, past, LaneEvent::none, R(-1));
  }

  /// Where the step leads: to its end, or, where it `ends`, to a share of it.
  [[nodiscard]] typename LanePack<R>::Move to_end(const StateOf<R>& here, const LanePath<R>& path,
                                                  R share, Mask ends) const {
    typename LanePack<R>::Move move;
    move.from = here.position;
    move.along = here.direction;
    move.place = path.end.position;
    move.direction = path.end.direction;
    move.length = path.h;
    if (any(ends)) {
      const R u = select(ends, share, R(1));
      move.length = path.h * u;
      move.place = choose(ends, path.place.at(u), move.place);
      move.direction = choose(ends, unit(path.place.slope(u) * (R(1) / path.h)), move.direction);
    }
    const V turned = move.direction - move.along;
    const R chord2 = dot(turned, turned);
    move.turning = sqrt(chord2) * multiply_add(chord2, R(1.0 / 24.0), R(1));
    return move;
  }

  /// Goes on through the influence of isolated masses, where paths enter one; the event that this
  /// is.
  [[nodiscard]] R cross(const LaneCrossing<R>& isolated, typename LanePack<R>::Move& move,
                        LaneFinding<R>& found) const {
    const auto passage = isolated.pass();
    const R aside = pack_.aside_after(move.length, move.place);
    move.error = multiply_add(passage.gain, aside, move.error);
    move.place = choose(isolated.enters, passage.place, move.place);
    move.direction = choose(isolated.enters, passage.direction, move.direction);
    move.length = move.length + passage.length;
    move.turning = move.turning + passage.turning;
    move.clear = move.clear - passage.length;
    found.object = select(isolated.enters, passage.object, found.object);
    return select(passage.captured, code(LaneEvent::horizon), code(LaneEvent::cross));
  }

  /// @param event  a limit that is passed, or an isolated mass that is crossed
  [[nodiscard]] std::uint32_t tell(R event, const LaneFinding<R>& found,
                                   const Course& course) const {
    event = select(course.ends & (found.event > R(0)), found.event, event);
    event = select(course.escapes, code(LaneEvent::escape), event);
    event = select(course.consults, code(LaneEvent::consult), event);
    event = select(course.resigns, code(LaneEvent::resign), event);
    return pack_.tell(event, found.object);
  }

  const LaneScene& scene_;
  LanePack<R> pack_;
};

/// Never inlined: one function of all fields is more than compilers find registers for.
template <class R, class F>
[[gnu::noinline]] std::uint32_t step_lanes_in(const LaneScene& scene, Lanes& lanes) {
  std::uint32_t events = 0;
  for (int first = 0; first < lane_count; first += R::lanes)
    events |= LaneStepper<R, F>(scene, lanes, first).step() << first;
  return events;
}

/// By the law that bends light about few masses.
template <class R, class... Laws>
std::uint32_t step_by_law(const LaneScene& scene, Lanes& lanes, const std::variant<Laws...>*) {
  std::uint32_t events = 0;
  int law = 0;
  static_cast<void>(
      ((scene.law == law++
            ? (events = step_lanes_in<R, LaneMasses<R, Weighing<Laws>>>(scene, lanes), true)
            : false) ||
       ...));
  return events;
}

template <class R>
std::uint32_t step_lanes(const LaneScene& scene, Lanes& lanes) {
  if (scene.map_count > 0 && scene.outline_count > 0)
    return step_lanes_in<R, LaneCoupled<R, LaneGravitonMap<R, LaneAnyNearest<R>>>>(scene, lanes);
  if (scene.map_count > 0)
    return step_lanes_in<R, LaneCoupled<R, LaneGravitonMap<R, LaneNearest<R>>>>(scene, lanes);
  if (scene.way_count > 0 && scene.outline_count > 0)
    return step_lanes_in<R, LaneCoupled<R, LaneShortestPath<R, LaneOutlineRim<R>>>>(scene, lanes);
  if (scene.way_count > 0)
    return step_lanes_in<R, LaneCoupled<R, LaneShortestPath<R, LaneRim<R>>>>(scene, lanes);
  if (scene.gate_count > 0 && scene.any_round)
    return step_lanes_in<R, LaneCoupled<R, LaneGates<R, LaneAnyNearest<R>>>>(scene, lanes);
  if (scene.gate_count > 0 && scene.outline_count > 0 && !scene.all_convex)
    return step_lanes_in<R, LaneCoupled<R, LaneGates<R, LaneSimpleNearest<R>>>>(scene, lanes);
  if (scene.gate_count > 0 && scene.outline_count > 0)
    return step_lanes_in<R, LaneCoupled<R, LaneGates<R, LaneOutlineNearest<R>>>>(scene, lanes);
  if (scene.gate_count > 0)
    return step_lanes_in<R, LaneCoupled<R, LaneGates<R, LaneNearest<R>>>>(scene, lanes);
  if (scene.many.count > 0) return step_lanes_in<R, LaneManyMassesField<R>>(scene, lanes);
  return step_by_law<R>(scene, lanes, static_cast<const Law*>(nullptr));
}

}  // namespace portalens
