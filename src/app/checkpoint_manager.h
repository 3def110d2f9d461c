/// \file
/// Keeping what was done: a render that attends to signals and the clock, and leaves a checkpoint
/// and a labelled partial picture when it is ended.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "app/interrupt.h"
#include "render/partial.h"
#include "render/render.h"

namespace portalens {

/// Whether a picture can have a checkpoint beside it: not one for standard output.
[[nodiscard]] bool is_kept(const std::filesystem::path& picture);

/// Where the checkpoint of a picture lies: beside it.
[[nodiscard]] std::filesystem::path checkpoint_of(const std::filesystem::path& picture);

/// Where what stands of a picture goes when it is interrupted: never over a whole one.
[[nodiscard]] std::filesystem::path unfinished(const std::filesystem::path& picture);

/// What to do about a checkpoint that lies there when a render begins.
enum class Found { refuse, resume, restart };

/// The exposure to begin with: the checkpoint's, or a new one.
/// @param provenance  of this render
/// @throws SceneError if the checkpoint is of something else, naming each difference; if there is
///         none to resume; or if there is one and nothing was said of it
[[nodiscard]] std::unique_ptr<Exposure> begun_exposure(const std::filesystem::path& checkpoint,
                                                       Found found, const Provenance& provenance,
                                                       const Assignment& assignment);

/// How a render is kept.
struct Keeping {
  std::filesystem::path picture;
  std::optional<double> seconds;  ///< between two checkpoints; none: only when it is ended
  bool quiet = false;
  /// Writes what stands to that place.
  std::function<void(const std::filesystem::path&, const RenderResult&)> write_picture;
};

/// Runs an exposure to its end, with checkpoints on the path. A request to end is obeyed within a
/// few seconds whatever the photons do: what stands is written, and where threads don't come back
/// the program ends from here.
/// @return the exit code if it was ended, after telling what was written where
/// @throws what rendering may, and WorkError if the last checkpoint can't be written
[[nodiscard]] std::optional<int> run_kept(const World& world, Exposure& exposure,
                                          const RenderOptions& options,
                                          const Provenance& provenance, const Keeping& keeping,
                                          Signals& signals, Progress* progress);

/// Writes the checkpoint of what stands, if the picture is kept.
/// @throws WorkError
void keep(const Keeping& keeping, const Provenance& provenance, const Exposure& exposure);

/// The same where the work is failing already: a second failure is passed over.
void keep_if_possible(const Keeping& keeping, const Provenance& provenance,
                      const Exposure& exposure) noexcept;

}  // namespace portalens
