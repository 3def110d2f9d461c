/// \file
/// Everything that decides a picture's bits, as names and values. Two partial pictures belong to
/// the same picture if their fingerprints are equal; if not, the fingerprints name each difference.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/assignment.h"
#include "render/render.h"
#include "scene/scene.h"
#include "world/world.h"

namespace portalens {

/// Names and values, each name once.
using Fingerprint = std::vector<std::pair<std::string, std::string>>;

/// The program's version and sources, the kind of processor, the engine, every key of the scene and
/// the digest of every file that it names. The objects of a large scene share one digest.
/// @param scene    with all that was overridden in it, as `world` was compiled from it
/// @param options  of which the engine and the photons are looked at
[[nodiscard]] Fingerprint fingerprint_of(const Scene& scene, const World& world,
                                         const RenderOptions& options);

/// The part of the picture, as the options that ask for it.
[[nodiscard]] Fingerprint fingerprint_of(const Assignment& assignment);

/// One name whose values differ; "not set" where one side lacks it.
struct Difference {
  std::string name, before, now;
};

/// In the order of `before`, then what only `now` has.
[[nodiscard]] std::vector<Difference> differences(const Fingerprint& before,
                                                  const Fingerprint& now);

}  // namespace portalens
