#include "lanes/driver.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "lanes/limits.h"
#include "lanes/polish.h"
#include "lanes/reached_portals.h"
#include "lanes/recorder.h"
#include "lanes/seen_path.h"
#include "lanes/states.h"
#include "photon/advance.h"
#include "photon/radau.h"
#include "photon/space.h"
#include "photon/vicinity.h"

namespace portalens {
namespace {

/// Keeps the lanes full until no photon is left.
template <class C, class W>
class LaneDriver {
 public:
  LaneDriver(const Space& space, const LanePlan& plan, LaneStep step, const C& coupling, W weighing,
             std::span<const Photon> photons, std::span<Arrival> arrivals,
             std::span<PathRecord> records)
      : space_(space),
        plan_(plan),
        step_(step),
        integrator_(Radau::from({space.physics.step, space.physics.tolerance})),
        scalar_(space, integrator_, coupling, weighing),
        vicinity_(space.mass_tree),
        obstacles_(space.surfaces, space.portals),
        has_flush_(space.surfaces.flush().any_shapes()),
        photons_(photons),
        arrivals_(arrivals),
        states_(space, plan),
        lanes_(states_.rows()),
        recorder_(space, plan, states_, photon_, records) {}

  void run() {
    for (int lane = 0; lane < lane_count; ++lane) refill(lane);
    while (in_flight_ > 0) {
      std::uint32_t events = step_(plan_.scene, lanes_);
      // Only where the step was not taken can a lane still be as it was put there.
      const std::uint32_t was_fresh = states_.take_fresh();
      recorder_.pass(events);
      for (; events != 0; events &= events - 1) {
        const int lane = std::countr_zero(events);
        const auto event = static_cast<LaneEvent>(static_cast<int>(lanes_.event[lane]));
        const bool was_put = (was_fresh >> lane & 1) != 0;
        if (plan_.scene.box_count > 0 && lanes_.seen.share[lane] > 0.0f) {
          if (meets_seen(lane, event, was_put)) continue;
          if (event == LaneEvent::none) recorder_.pass_lane(lane);
        }
        if (event == LaneEvent::none) continue;
        if (event == LaneEvent::cross) {
          recorder_.pass_isolated(lane);
          continue;
        }
        const bool stayed = event == LaneEvent::escape || event == LaneEvent::consult;
        handle(lane, event, stayed && was_put);
      }
    }
  }

 private:
  /// @param fresh  the lane is as it was put there
  void handle(int lane, LaneEvent event, bool fresh) {
    // -1 where nothing is met: a float below 0 is no unsigned number.
    const auto object = static_cast<std::uint32_t>(static_cast<int>(lanes_.object[lane]));
    Arrival& arrival = arrivals_[photon_[lane]];
    const bool whole = states_.is_whole(lane);
    if (whole) arrival = Arrival{};
    const double begun = arrival.length;
    State state = fresh ? states_.put_state(lane, photons_[photon_[lane]]) : states_.state_of(lane);
    const double length = fresh ? begun : lanes_.length[lane];
    if (!fresh) {
      arrival.length = length;
      arrival.turning = lanes_.turning[lane];
      arrival.steps = static_cast<std::uint32_t>(lanes_.steps[lane]);
    }
    if (event == LaneEvent::consult && !fresh)
      state.position = before_portals(space_, plan_.scene, state, lanes_.departed[lane]);
    if (event == LaneEvent::resign) {
      resign(lane);
      return;
    }
    if (event != LaneEvent::escape && event != LaneEvent::hit) {
      consult(lane, event, object, state, begun);
      return;
    }
    if (!states_.is_number(lane)) {
      arrival.fate = Fate::lost;
    } else if (event == LaneEvent::hit) {
      const double rest =
          distance_to_surface(space_, object, {state.position, state.direction}, length);
      state.position += state.direction * rest;
      arrival.length = length + rest;
      Encounter seen{0.0, Encounter::Kind::surface, object, 0};
      if (has_flush_) {
        seen = seen_at(object, state);
        if (seen.kind != Encounter::Kind::surface) {
          consult(lane, LaneEvent::portal, seen.object, state, begun);
          return;
        }
      }
      arrival.fate = Fate::hit;
      arrival.met = Met::surface;
      arrival.object = seen.object;
      arrival.face = seen.face;
    } else {
      arrival.fate = Fate::escaped;
    }
    arrival.position = state.position;
    arrival.direction = state.direction;
    end(lane, lanes_.askew[lane]);
  }

  /// Whether a step's path meets something in a box before the step's end: looked at in double, and
  /// seen to.
  /// @param fresh  the lane was as it was put there before the step
  [[gnu::noinline]] bool meets_seen(int lane, LaneEvent event, bool fresh) {
    const Photon& photon = photons_[photon_[lane]];
    Arrival before = states_.is_whole(lane) ? Arrival{} : arrivals_[photon_[lane]];
    const double begun = before.length;
    if (!fresh) {
      before.length = lanes_.seen.length[lane];
      before.turning = lanes_.seen.turning[lane];
    }
    const State from = fresh ? states_.put_state(lane, photon) : states_.seen_from(lane);
    const PathStart start = states_.start_of(lane, photon).after(before.length - begun);
    SeenPath path(lanes_.seen, lane, from);
    const auto met = path.first(obstacles_, start, event == LaneEvent::escape,
                                space_.physics.tolerance, before.length);
    if (path.free() >= path.length())
      lanes_.clear[lane] =
          static_cast<float>(path.free() + lanes_.seen.length[lane]) - lanes_.length[lane];
    if (!met || says_the_same(event, lanes_.object[lane], *met)) return false;
    RayState way{from, start, before, {lanes_.astray[lane], lanes_.askew[lane]}};
    // The lane has counted the step if it has taken it; the scalar engine counts its own.
    way.arrival.steps = static_cast<std::uint32_t>(lanes_.steps[lane]) +
                        (event == LaneEvent::escape ? 1 : 0) - (path.rough() ? 1 : 0);
    if (!path.rough()) path.lead(way, met->distance);
    arrivals_[photon_[lane]] = way.arrival;
    hand_over(lane, way, !path.rough() && met->leads_on() ? met->object : no_object,
              [&] { return path.rough() ? scalar_.one_step() : scalar_.encounter(*met); });
    return true;
  }

  /// Lets the scalar engine see to what lanes don't. Never inlined: it is seldom, and large.
  [[gnu::noinline]] void consult(int lane, LaneEvent event, std::uint32_t object,
                                 const State& state, double begun) {
    Arrival& arrival = arrivals_[photon_[lane]];
    if (event == LaneEvent::portal) object = portal_at(object, state);
    const PathStart start = states_.start_of(lane, photons_[photon_[lane]]);
    const Drift<double> drift{lanes_.astray[lane], lanes_.askew[lane]};
    const RayState way{state, start.after(arrival.length - begun), arrival, drift};
    if (event == LaneEvent::horizon && LanePlan::is_isolated(object)) recorder_.pass_isolated(lane);
    hand_over(lane, way, event == LaneEvent::portal ? object : no_object, [&] {
      return event == LaneEvent::portal    ? meet_portal(way, object)
             : event == LaneEvent::horizon ? scalar_.absorb(plan_.mass_of(object))
                                           : scalar_.one_step();
    });
  }

  /// Takes the path up in double, there, and puts it back where that leads.
  /// @param portal  which it crosses, if that is known
  /// @param act     of the scalar engine; whether the path has arrived
  template <class Act>
  void hand_over(int lane, const RayState& way, std::uint32_t portal, const Act& act) {
    Arrival& arrival = arrivals_[photon_[lane]];
    recorder_.pass_place(lane, way.state.position, arrival);
    scalar_.resume(way);
    bool arrived = act();
    if (!arrived && scalar_.way().arrival.crossings != arrival.crossings)
      arrived = swallowed_at(scalar_.way().state.position);
    const std::uint32_t handed_over =
        arrival.handed_over + scalar_.way().arrival.steps - arrival.steps;
    if (arrived || scalar_.gives_up()) {
      arrival = scalar_.way().arrived();
      arrival.handed_over = handed_over;
      end(lane, scalar_.way().drift.direction);
    } else {
      if (scalar_.way().arrival.crossings != arrival.crossings)
        portal != no_object ? recorder_.cross(lane, portal) : recorder_.lose_track(lane);
      arrival = scalar_.way().arrival;
      arrival.handed_over = handed_over;
      recorder_.pass_place(lane, scalar_.way().state.position, arrival);
      states_.put_back(lane, scalar_.way(), scalar_.free_length());
    }
  }

  /// Leaves a photon to the scalar engine, from its start.
  [[gnu::noinline]] void resign(int lane) {
    recorder_.lose_track(lane);
    Arrival& arrival = arrivals_[photon_[lane]];
    arrival = scalar_.advance(photons_[photon_[lane]], nullptr);
    arrival.handed_over = arrival.steps;
    finish(lane);
  }

  /// Where the path of a lane has ended: one that may have drifted too far is taken again.
  /// @param drifted  by how much its direction may have
  void end(int lane, double drifted) {
    const Arrival& arrival = arrivals_[photon_[lane]];
    const double trusted = arrival.fate == Fate::absorbed
                               ? absorbed_drift
                               : plan_.max_drift * lane_strictness[states_.strictness(lane)].drifts;
    if (drifted <= trusted)
      finish(lane);
    else
      take_again(lane);
  }

  /// In finer steps, until it drifts no more, or two in a row end alike; else by the scalar engine.
  /// Near a mass, two paths in floats may end alike because both begin beside their place: that
  /// counts only where the drift comes from what pulls through portals.
  [[gnu::noinline]] void take_again(int lane) {
    Arrival& arrival = arrivals_[photon_[lane]];
    const int strictness = states_.strictness(lane);
    if (strictness > 0 && looks_through(plan_.scene) &&
        end_alike(coarser_[lane], arrival, space_.physics.tolerance)) {
      finish(lane);
    } else if (strictness < max_lane_strictness) {
      coarser_[lane] = arrival;
      begin(lane, strictness + 1);
    } else {
      recorder_.lose_track(lane);
      arrival = scalar_.advance_finer(photons_[photon_[lane]], nullptr, arrival, 1e-2);
      arrival.handed_over = arrival.steps;
      finish(lane);
    }
  }

  /// Whether a portal led into a horizon: lanes look for those that a path comes to, not for one
  /// about its start.
  [[nodiscard]] bool swallowed_at(Vec3d x) {
    vicinity_.cover(x, 0.0);
    const auto mass = horizon_around(space_, vicinity_.near(), x);
    return mass && scalar_.absorb(*mass);
  }

  void finish(int lane) {
    recorder_.end(lane, arrivals_[photon_[lane]]);
    --in_flight_;
    refill(lane);
  }

  /// What is met where the path comes to that surface: it, or what lies in its plane.
  [[nodiscard, gnu::noinline]] Encounter seen_at(std::uint32_t object, const State& state) const {
    const Ray ray{state.position, state.direction};
    return obstacles_.uppermost(space_.surfaces.uppermost({object, 0, 0.0}, ray), ray);
  }

  [[nodiscard]] bool meet_portal(const RayState& way, std::uint32_t index) {
    const Portal& portal = space_.portals.portals()[index];
    RayState there = way;
    there.state.position = onto_plane(portal, way.state);
    scalar_.resume(there);
    return scalar_.encounter(obstacles_.at_portal(index, side_met(portal, way.state), 0.0));
  }

  /// The portal that is met where the path comes to that one: it, or another in its plane.
  [[nodiscard]] std::uint32_t portal_at(std::uint32_t index, const State& state) const {
    const PortalSide side = side_met(space_.portals.portals()[index], state);
    return space_.portals.uppermost({index, side, 0.0}, {state.position, state.direction}).portal;
  }

  /// Puts the lane's photon at its start.
  /// @param strictness  which `lane_strictness`
  void begin(int lane, int strictness) {
    const Photon& photon = photons_[photon_[lane]];
    states_.begin(lane, photon, strictness);
    recorder_.begin(lane, photon.position);
  }

  void refill(int lane) {
    while (next_ < photons_.size()) {
      const std::size_t index = next_++;
      const Photon& photon = photons_[index];
      if (!can_begin(photon)) {  // it ends at once
        scalar_.resume(RayState::of(photon));
        scalar_.one_step();
        arrivals_[index] = scalar_.way().arrived();
        continue;
      }
      photon_[lane] = index;
      begin(lane, 0);
      ++in_flight_;
      return;
    }
    states_.rest(lane);
  }

  /// Most photons of a batch begin where the one before did.
  [[nodiscard]] bool can_begin(const Photon& photon) {
    const Vec3d &x = photon.position, &t = photon.direction;
    if (!std::isfinite(t.x + t.y + t.z)) return false;
    if (begun_ && *begun_ == x) return true;
    if (!is_finite(x)) return false;
    vicinity_.cover(x, 0.0);
    if (horizon_around(space_, vicinity_.near(), x)) return false;
    begun_ = x;
    return true;
  }

  const Space& space_;
  const LanePlan& plan_;
  LaneStep step_;
  Radau integrator_;
  Tracer<Radau, C, W> scalar_;
  Vicinity vicinity_;  ///< of where photons begin, and where portals lead
  Obstacles obstacles_;
  bool has_flush_;  ///< some surface lies in the plane of something else
  std::span<const Photon> photons_;
  std::span<Arrival> arrivals_;
  std::optional<Vec3d> begun_;  ///< the last place from which a photon could begin
  LaneStates states_;
  Lanes& lanes_;
  std::array<std::size_t, lane_count> photon_{};
  LaneRecorder recorder_;
  /// How those that are taken again ended before.
  std::array<Arrival, lane_count> coarser_{};
  std::size_t next_ = 0;
  int in_flight_ = 0;
};

}  // namespace

void advance_in_lanes(const Space& space, const LanePlan& plan, LaneStep step,
                      std::span<const Photon> photons, std::span<Arrival> arrivals,
                      std::span<PathRecord> records) {
  visit_weighing(space.law, [&](auto weighing) {
    std::visit(
        [&](const auto& coupling) {
          LaneDriver(space, plan, step, coupling, weighing, photons, arrivals, records).run();
        },
        space.coupling);
  });
}

}  // namespace portalens
