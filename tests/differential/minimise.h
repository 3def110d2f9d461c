/// \file
/// Making a scene in which a photon goes wrong as small as it can be.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "differential/compare.h"
#include "differential/draft.h"

namespace portalens::differential {

/// A scene and the one photon of it that matters.
struct Find {
  Draft draft;
  Photon photon;
  Difference difference;
};

/// What a photon comes to in lanes, and by the reference.
struct Answers {
  Arrival lanes, exact;
  Difference difference;
};

/// Nothing if the scene has no lanes.
[[nodiscard]] std::optional<Answers> answers_in(const Stage& stage, const Photon& photon);

/// How wrong a find's photon is; nothing if it can't be told.
using Judge = std::function<std::optional<Difference>(const Find&)>;

/// Against the reference, in lanes; nothing if the scene is refused, or has none.
[[nodiscard]] std::optional<Difference> judged_in_lanes(const Find& find);

/// Drops masses, bodies, pairs of portals, cores, weights and backs, takes usual settings for
/// unusual ones and rounds numbers, while the photon stays as wrong: of the same
/// kind, explained or not, and if in direction no less than a tenth of how far it was off. The
/// camera then looks along the photon.
[[nodiscard]] Find minimised(const Find& find, const Judge& judge = judged_in_lanes);

/// Both answers of a find in words, each a line of comment.
[[nodiscard]] std::string answers_of(const Find& find);

/// The command that traces the photon through that file by the scalar engine.
[[nodiscard]] std::string trace_command(const std::string& file, const Photon& photon);

}  // namespace portalens::differential
