#include "differential/random_scene.h"

#include "differential/free_scene.h"
#include "differential/pieces.h"
#include "differential/room_scene.h"

namespace portalens::differential {
namespace {

constexpr double share_of_rooms = 0.1;

}  // namespace

Draft random_scene(std::uint64_t seed, std::uint64_t index) {
  Lot lot(seed, index);
  Draft draft = lot.chance(share_of_rooms) ? room_scene(lot) : free_scene(lot);
  place_somewhere(draft, lot);
  return draft;
}

}  // namespace portalens::differential
