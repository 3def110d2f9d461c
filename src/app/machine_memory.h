/// \file
/// How much memory there is, and whether a picture fits into it.
#pragma once

#include <cstdint>
#include <string>

#include "render/memory.h"

namespace portalens {

/// Bytes that this program may take: the machine's, or less where the user's limits or the control
/// group of a container say so.
[[nodiscard]] std::uint64_t machine_memory();

/// "512 MiB", "3.2 GiB"
[[nodiscard]] std::string memory_text(std::uint64_t bytes);

/// @throws SceneError with a way out if the picture needs more than there is
void check_memory(const MemoryEstimate& estimate);

}  // namespace portalens
