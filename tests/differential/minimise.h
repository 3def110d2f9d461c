/// \file
/// Making a scene in which a photon goes wrong as small as it can be.
#pragma once

#include "differential/compare.h"
#include "differential/draft.h"

namespace portalens::differential {

/// A scene and the one photon of it that matters.
struct Find {
  Draft draft;
  Photon photon;
  Difference difference;
};

/// Drops masses, bodies, pairs of portals, cores, weights and backs, takes usual settings for
/// unusual ones and rounds numbers, while the photon's answer in lanes stays as wrong: of the same
/// kind, explained or not, and if in direction no less than a tenth of how far it was off. The
/// camera then looks along the photon.
[[nodiscard]] Find minimised(const Find& find);

/// The command that traces the photon through that file by the scalar engine.
[[nodiscard]] std::string trace_command(const std::string& file, const Photon& photon);

}  // namespace portalens::differential
