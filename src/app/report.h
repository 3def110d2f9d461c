/// \file
/// What a render tells about itself: for people, for programs, and in the picture's own header.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "app/json.h"
#include "io/image.h"
#include "render/partial_header.h"
#include "render/render.h"

namespace portalens {

/// "98.20 % hit, 1.80 % escaped": the shares of all photons, without those that are 0.
[[nodiscard]] std::string fates_text(const Tally& tally);

/// By which engine the photons go, and why, from what the header tells (`manner_metadata`): a line
/// for people, as "scalar, because ...".
[[nodiscard]] std::string engine_text(const Metadata& header);
/// Whether every sample has a photon of its own, likewise.
[[nodiscard]] std::string photon_mode_text(const Metadata& header);
/// Adds both to what is printed for programs.
void add_manner(const Metadata& header, Json& json);

/// What `--stats` prints: several lines, and a command for each of the first samples that lost a
/// photon.
/// @param provenance  with the scene and its settings as words of a command line
[[nodiscard]] std::string statistics_text(const RenderResult& result, const Provenance& provenance);

/// What `--json` prints.
[[nodiscard]] Json statistics_json(const RenderResult& result, const Provenance& provenance,
                                   const std::filesystem::path& picture);

/// What an EXR file keeps of the scene, the settings and the paths of photons from which it was
/// made.
[[nodiscard]] Metadata world_metadata(const World& world, const RenderOptions& options);
/// What it keeps besides: which part of the picture it is, and how its photons ended. The same
/// picture has the same.
[[nodiscard]] Metadata result_metadata(const RenderResult& result);

/// The objects' numbers in the layer `object`, a line each; those of large scenes are cut.
[[nodiscard]] std::string object_list(const World& world);
/// The names in such a list, by their numbers; what is no line of one is passed over.
[[nodiscard]] std::map<int, std::string> listed_names(const std::string& list);

/// Advice where photons were lost or trapped, or light was not a number; empty if there is none.
[[nodiscard]] std::string complaint(const Tally& tally);

}  // namespace portalens
