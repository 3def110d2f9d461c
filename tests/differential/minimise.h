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

/// How wrong a find's photon is; nothing if it can't be told.
using Judge = std::function<std::optional<Difference>(const Find&)>;

/// An engine against the reference; nothing if the scene is refused, or has no lanes.
[[nodiscard]] Judge judged_by(Engine engine);

/// Drops masses, bodies, pairs of portals, cores, weights and backs, takes usual settings for
/// unusual ones and rounds numbers, while the photon stays as wrong: of the same
/// kind, explained or not, and if in direction no less than a tenth of how far it was off. The
/// camera then looks along the photon.
[[nodiscard]] Find minimised(const Find& find, const Judge& judge);

/// An engine's answer and the reference's, in words, each a line of comment.
[[nodiscard]] std::string answers_of(const Find& find, Engine engine);

/// The command that traces the photon through that file by the scalar engine.
[[nodiscard]] std::string trace_command(const std::string& file, const Photon& photon);

}  // namespace portalens::differential
