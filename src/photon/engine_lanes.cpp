#include "photon/engine_lanes.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "photon/advance.h"
#include "photon/radau.h"
#include "photon/space.h"

namespace portalens {
namespace {

/// Keeps the lanes full until no photon is left.
template <class C>
class LaneDriver {
 public:
  LaneDriver(const Space& space, const LanePlan& plan, LaneStep step, const C& coupling,
             std::span<const Photon> photons, std::span<Arrival> arrivals)
      : space_(space),
        plan_(plan),
        step_(step),
        integrator_(Radau::from({space.physics.step, space.physics.tolerance})),
        scalar_(space, integrator_, coupling),
        photons_(photons),
        arrivals_(arrivals) {}

  void run() {
    for (int lane = 0; lane < lane_count; ++lane) refill(lane);
    while (travelling_ > 0) {
      step_(plan_.scene, lanes_);
      // Only where the step was not taken can a lane still be as it was put there.
      std::array<int, lane_count> ended;
      int count = 0;
      for (int lane = 0; lane < lane_count; ++lane) {
        ended[count] = lane;
        count += lanes_.event[lane] != 0.0f ? 1 : 0;
      }
      const std::uint32_t was_fresh = std::exchange(fresh_, 0);
      for (int i = 0; i < count; ++i) {
        const int lane = ended[i];
        const auto event = static_cast<LaneEvent>(static_cast<int>(lanes_.event[lane]));
        const bool stayed = event == LaneEvent::escape || event == LaneEvent::consult;
        handle(lane, event, way_of(lane, stayed && (was_fresh >> lane & 1) != 0));
      }
    }
  }

 private:
  void handle(int lane, LaneEvent event, Travel way) {
    // -1 where nothing is met: a float below 0 is no unsigned number.
    const auto object = static_cast<std::uint32_t>(static_cast<int>(lanes_.object[lane]));
    if (event == LaneEvent::escape) {
      way.arrival.fate = Fate::escaped;
      arrive(lane, way);
    } else if (event == LaneEvent::hit) {
      way.arrival.met = Met::surface;
      way.arrival.object = object;
      way.arrival.face = 0;
      way.arrival.fate = Fate::hit;
      settle_on_surface(way);
      arrive(lane, way);
    } else {
      scalar_.resume(way);
      const bool arrived = event == LaneEvent::portal    ? meet_portal(way, object)
                           : event == LaneEvent::horizon ? scalar_.absorb(object)
                                                         : scalar_.one_step();
      if (arrived) {
        arrive(lane, scalar_.way());
      } else {
        put(lane, scalar_.way(), scalar_.free_length());
      }
    }
  }

  void arrive(int lane, const Travel& way) {
    arrivals_[photon_[lane]] = way.arrived();
    --travelling_;
    refill(lane);
  }

  /// Puts a hit that was found in float onto its surface in double.
  void settle_on_surface(Travel& way) const {
    const Ray ray{way.state.position, way.state.direction};
    const double reach = 1e-3 * (1e-3 * space_.extent + way.arrival.length);
    if (const auto contact = space_.surfaces.contact_near(way.arrival.object, 0, ray, reach)) {
      way.state.position = ray.at(contact->distance);
      way.arrival.length += contact->distance;
    }
  }

  [[nodiscard]] bool meet_portal(const Travel& way, std::uint32_t index) {
    const Portal& portal = space_.portals.portals()[index];
    Travel there = way;
    // Onto the plane, along the way.
    const double slope = dot(way.state.direction, portal.frame.normal);
    const double height = dot(way.state.position - portal.frame.origin, portal.frame.normal);
    if (std::fabs(slope) > 1e-6)
      there.state.position = way.state.position - way.state.direction * (height / slope);
    scalar_.resume(there);
    return scalar_.encounter(
        {0.0, slope < 0.0 ? Encounter::Kind::portal_front : Encounter::Kind::portal_back, index,
         0});
  }

  /// A lane's way in double. One that has just been put there is taken as it was.
  [[nodiscard]] Travel way_of(int lane, bool fresh) const {
    Travel way = travels_[lane];
    if (!fresh) {
      way.state.position = plan_.center + Vec3d{lanes_.x[lane], lanes_.y[lane], lanes_.z[lane]};
      way.state.direction = normalize(Vec3d{lanes_.tx[lane], lanes_.ty[lane], lanes_.tz[lane]});
      way.start = way.start.after(lanes_.length[lane] - way.arrival.length);
      way.arrival.length = lanes_.length[lane];
      way.arrival.turning = lanes_.turning[lane];
      way.arrival.steps = static_cast<std::uint32_t>(lanes_.steps[lane]);
    }
    return way;
  }

  /// @param clear  nothing is met within that much path
  void put(int lane, const Travel& way, double clear) {
    travels_[lane] = way;
    fresh_ |= std::uint32_t{1} << lane;
    const Vec3d x = way.state.position - plan_.center;
    lanes_.x[lane] = static_cast<float>(x.x);
    lanes_.y[lane] = static_cast<float>(x.y);
    lanes_.z[lane] = static_cast<float>(x.z);
    lanes_.tx[lane] = static_cast<float>(way.state.direction.x);
    lanes_.ty[lane] = static_cast<float>(way.state.direction.y);
    lanes_.tz[lane] = static_cast<float>(way.state.direction.z);
    lanes_.length[lane] = static_cast<float>(way.arrival.length);
    lanes_.turning[lane] = static_cast<float>(way.arrival.turning);
    lanes_.steps[lane] = static_cast<float>(way.arrival.steps);
    const Departure& departure = way.start.departure;
    lanes_.departed[lane] =
        departure.shape == no_object ? -1.0f : static_cast<float>(departure.shape);
    lanes_.departed_side[lane] = static_cast<float>(departure.side);
    lanes_.clear[lane] = static_cast<float>(clear);
    lanes_.live[lane] = 1.0f;
    lanes_.event[lane] = 0.0f;
  }

  void rest(int lane) {
    lanes_.x[lane] = lanes_.y[lane] = lanes_.z[lane] = static_cast<float>(space_.extent);
    lanes_.tx[lane] = 1.0f;
    lanes_.ty[lane] = lanes_.tz[lane] = 0.0f;
    lanes_.length[lane] = lanes_.turning[lane] = lanes_.steps[lane] = 0.0f;
    lanes_.departed[lane] = -1.0f;
    lanes_.departed_side[lane] = 1.0f;
    lanes_.clear[lane] = 0.0f;
    lanes_.live[lane] = 0.0f;
    lanes_.event[lane] = 0.0f;
  }

  void refill(int lane) {
    while (next_ < photons_.size()) {
      const std::size_t index = next_++;
      const Travel way = Travel::of(photons_[index]);
      // What can't begin ends at once.
      if (!is_finite(way.state.position) || !is_finite(way.state.direction) ||
          horizon_around(space_.masses, way.state.position)) {
        scalar_.resume(way);
        scalar_.one_step();
        arrivals_[index] = scalar_.way().arrived();
        continue;
      }
      photon_[lane] = index;
      put(lane, way, 0.0);
      ++travelling_;
      return;
    }
    rest(lane);
  }

  const Space& space_;
  const LanePlan& plan_;
  LaneStep step_;
  Radau integrator_;
  Tracer<Radau, C> scalar_;
  std::span<const Photon> photons_;
  std::span<Arrival> arrivals_;
  Lanes lanes_;
  std::array<Travel, lane_count> travels_;
  std::array<std::size_t, lane_count> photon_{};
  std::uint32_t fresh_ = 0;  ///< lanes that have not moved since they were filled, a bit each
  std::size_t next_ = 0;
  int travelling_ = 0;
};

}  // namespace

void advance_in_lanes(const Space& space, const LanePlan& plan, LaneStep step,
                      std::span<const Photon> photons, std::span<Arrival> arrivals) {
  std::visit(
      [&](const auto& coupling) {
        LaneDriver(space, plan, step, coupling, photons, arrivals).run();
      },
      space.coupling);
}

}  // namespace portalens
