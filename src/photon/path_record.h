/// \file
/// The path that a photon took, in few words: places on it, in order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/vec3.h"

namespace portalens {

/// A place on a path; between two neighbours of a stretch the path strays from the straight one by
/// no more than a quarter of its length times what it turns.
struct Waypoint {
  Vec3<float> place;
  float length = 0.0f;       ///< of the path until here
  float turning = 0.0f;      ///< likewise, radians
  std::int32_t stretch = 0;  ///< how many portals were crossed before
};

/// A path, recorded while its photon was followed; of a photon that escaped, up to where nothing
/// more could be met.
class PathRecord {
 public:
  static constexpr std::size_t max_points = 64;

  PathRecord() = default;
  PathRecord(const PathRecord& other) { *this = other; }
  /// Copies no more than there is: most path records are short.
  PathRecord& operator=(const PathRecord& other) {
    portals_ = other.portals_;
    count_ = other.count_;
    crossings_ = other.crossings_;
    known_ = other.known_;
    if (count_ <= few_points)
      std::copy_n(other.few_.begin(), count_, few_.begin());
    else
      many_ = other.many_;
    return *this;
  }

  /// Forgets everything, for another way.
  void restart() {
    count_ = 0;
    portals_ = 0;
    crossings_ = 0;
    known_ = true;
  }
  void pass(Vec3d place, double length, double turning) {
    const Waypoint point{
        {static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)},
        static_cast<float>(length),
        static_cast<float>(turning),
        crossings_};
    if (known_ && count_ < few_points)
      few_[count_++] = point;
    else
      add_to_many(point);
  }
  /// The next place lies beyond that portal.
  void cross(std::uint32_t portal) {
    if (portal >= max_portals || ++crossings_ > max_crossings) known_ = false;
    portals_ = portals_ * (max_portals + 1) + portal + 1;
  }
  /// It did something that can't be told here.
  void lose_track() { known_ = false; }

  /// False if it was too long to be told.
  [[nodiscard]] bool known() const { return known_ && count_ > 0; }
  [[nodiscard]] std::span<const Waypoint> points() const {
    return {count_ > few_points ? many_.data() : few_.data(), count_};
  }
  /// The portals that it entered, in order, as one number: equal for the same portals only.
  [[nodiscard]] std::uint64_t portals() const { return portals_; }
  [[nodiscard]] std::int32_t crossings() const { return crossings_; }
  /// The portal that ends a stretch. @pre known(), 0 <= stretch < crossings()
  [[nodiscard]] std::uint32_t portal_after(std::int32_t stretch) const {
    std::uint64_t rest = portals_;
    for (std::int32_t i = stretch + 1; i < crossings_; ++i) rest /= max_portals + 1;
    return static_cast<std::uint32_t>(rest % (max_portals + 1)) - 1;
  }

 private:
  static constexpr std::size_t few_points = 20;
  static constexpr std::uint32_t max_portals = 31;
  static constexpr int max_crossings = 12;  // 32^12 fits 64 bits

  /// Never inlined: it is seldom.
  [[gnu::noinline]] void add_to_many(const Waypoint& point) {
    if (count_ == max_points) known_ = false;
    if (!known_) return;
    if (count_ == few_points) many_.assign(few_.begin(), few_.end());
    many_.push_back(point);
    ++count_;
  }

  std::uint64_t portals_ = 0;
  std::size_t count_ = 0;
  std::int32_t crossings_ = 0;
  bool known_ = true;
  std::array<Waypoint, few_points> few_;  ///< the first `count_` of them
  std::vector<Waypoint> many_;            ///< all, where there are more
};

}  // namespace portalens
