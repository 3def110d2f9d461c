// Random rooms full of things in the planes of their walls: both engines against brute force.
#include <gtest/gtest.h>

#include <cmath>

#include "support/flat_rooms.h"
#include "support/plain_tracer.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

constexpr std::size_t max_crossings = 6;

/// What both engines tell of photons, held against straight light.
class RoomCheck {
 public:
  RoomCheck(const FlatRoom& room, std::uint64_t seed)
      : room_(room),
        space_(physics_with(1e-4), max_crossings, room.shapes, room.portals, {}),
        // Floats place nothing finer than this, and what is far away less so.
        blur_(2e-5 * room.size + 1e-9 * length(room.middle)),
        tracer_(room, blur_),
        random_(seed) {}

  [[nodiscard]] bool has_lanes() const { return space_.lanes != nullptr; }

  /// @return how many photons were compared
  int run(int photons) {
    std::vector<Photon> wave;
    std::vector<std::optional<std::size_t>> left;
    for (int i = 0; i < photons; ++i) {
      const double spread = i % 4 == 0 ? 3.0 : 0.9;  // some see the walls from outside
      const Vec3d from = room_.middle + random_.point(spread * room_.size);
      wave.push_back(photon_at(from, random_.direction()));
      left.emplace_back();
    }
    int compared = 0;
    for (int bounce = 0; bounce < 3 && !wave.empty(); ++bounce) compared += one_wave(wave, left);
    return compared;
  }

 private:
  int one_wave(std::vector<Photon>& wave, std::vector<std::optional<std::size_t>>& left) {
    std::vector<Arrival> scalar(wave.size()), lanes(wave.size());
    advance(space_, wave, scalar, Engine::scalar);
    advance(space_, wave, lanes, Engine::automatic);
    std::vector<Photon> next;
    std::vector<std::optional<std::size_t>> next_left;
    int compared = 0;
    for (std::size_t i = 0; i < wave.size(); ++i) {
      const auto met = tracer_.follow(wave[i].position, wave[i].direction, left[i], max_crossings);
      if (!met) continue;
      ++compared;
      expect(scalar[i], *met, "scalar");
      expect(lanes[i], *met, "lanes");
      if (met->shape && !met->lost && room_.mirrors[*met->shape]) {
        next.push_back(mirrored(scalar[i], *met));
        next_left.emplace_back(met->wall);
      }
    }
    wave = std::move(next);
    left = std::move(next_left);
    return compared;
  }

  void expect(const Arrival& arrival, const Met& met, const char* engine) const {
    const Fate fate = met.lost ? Fate::lost : met.shape ? Fate::hit : Fate::escaped;
    EXPECT_EQ(fate_names[static_cast<int>(arrival.fate)], fate_names[static_cast<int>(fate)])
        << engine;
    EXPECT_EQ(arrival.crossings, met.crossed.size()) << engine;
    if (fate != Fate::hit || arrival.fate != fate) return;
    EXPECT_EQ(arrival.object, *met.shape) << engine;
    EXPECT_LT(length(arrival.position - met.position), 10.0 * blur_) << engine;
  }

  [[nodiscard]] Photon mirrored(const Arrival& arrival, const Met& met) const {
    const Vec3d n = room_.walls[met.wall].normal;
    Photon photon = photon_at(arrival.position, met.direction - n * (2.0 * met.slope));
    const double side = dot(photon.direction, std::get<Quad>(room_.shapes[*met.shape]).normal());
    photon.guard = {*met.shape, 0, side < 0.0 ? -1.0 : 1.0,
                    guard_reach(length(photon.position) + room_.size, side)};
    return photon;
  }

  const FlatRoom& room_;
  PlannedSpace space_;
  double blur_;
  PlainTracer tracer_;
  Random random_;
};

TEST(FlushRooms, EveryPhotonMeetsWhatStraightLightMeetsInBothEngines) {
  const int rooms = scaled(100);
  int compared = 0, in_lanes = 0;
  for (int i = 0; i < rooms && !testing::Test::HasFailure(); ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random scales(seed + 1000);
    const double size = std::pow(10.0, scales.uniform(-3, 5));
    const double away = std::pow(10.0, scales.uniform(-3, 5));
    const FlatRoom room = RoomBuilder(seed, size, away).build();
    RoomCheck check(room, seed);
    in_lanes += check.has_lanes();
    compared += check.run(400);
  }
  EXPECT_GT(compared, rooms * 250);
  EXPECT_GT(in_lanes, rooms / 2);
}

}  // namespace
}  // namespace portalens::test
