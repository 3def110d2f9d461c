/// \file
/// The list of passages: what leads light from one face of a pair to the other. A portal is a place
/// to meet, its aperture, and a passage.
///
/// To add one: a header beside this one, and a word in `Passage`, before the last, which takes
/// every pair. What a scene says of a face comes by `FaceInput` (`world/face_reader.h`). Each type
/// has
///   static constexpr std::string_view name;          for people
///   static std::optional<T> between(const PassageInput&);
///       the passage from the first face to the second; nothing where the pair is none of its kind
///   Passed pass(Vec3d position, Vec3d direction) const;
///       where light comes out that meets the first face there: on the second face, or nearly
///   const Rigid* motion() const;
///       the rigid motion that it equals everywhere; null where there is none. Couplings that have
///       `asks_motion` need it: a scene of such a coupling is refused. So do shadow rays: through
///       other passages no lamp lights a surface.
/// and a default constructor, and is immutable.
#pragma once

#include <variant>

#include "portal/rigid_passage.h"

namespace portalens {

using Passage = std::variant<RigidPassage>;

/// Asks the types in the list's order, and makes the first that takes the pair.
[[nodiscard]] Passage passage_between(const PassageInput& input);

[[nodiscard]] inline Passed pass(const Passage& passage, Vec3d position, Vec3d direction) {
  return std::visit([&](const auto& p) { return p.pass(position, direction); }, passage);
}

/// Null where it is no rigid motion.
[[nodiscard]] inline const Rigid* motion_of(const Passage& passage) {
  return std::visit([](const auto& p) { return p.motion(); }, passage);
}

[[nodiscard]] inline std::string_view name_of(const Passage& passage) {
  return std::visit([](const auto& p) { return p.name; }, passage);
}

}  // namespace portalens
