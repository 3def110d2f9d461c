/// \file
/// A picture from its parts: windows of it, ranges of its samples, or both.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "render/partial.h"

namespace portalens {

/// The parts put together, to the same bits as if one render had taken all, whatever the order of
/// the parts. They must be finished, belong to the same picture, and hold each of its samples once.
/// @param crop  the part of the picture that is wanted, instead of the whole
/// @pre there is at least one part
/// @throws SceneError with all that hinders
[[nodiscard]] std::unique_ptr<Exposure> merged(std::span<const PartialFile> parts,
                                               const std::optional<Window>& crop);

}  // namespace portalens
