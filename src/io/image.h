/// \file
/// Pictures in and out: EXR, PNG, HDR, JPEG in; EXR, PNG and JPEG out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/image.h"
#include "io/digest.h"

namespace portalens {

/// Three linear channels, finite, but perhaps below 0; 8-bit files are taken as sRGB. Of an EXR the
/// display window is the picture, black where it has no pixels. The kind is told by the file's
/// first bytes. The header's size is checked against a budget before anything is allocated.
/// @param asked_at  where the scene names the file
/// @param digests   if given, gets the file's
[[nodiscard]] std::optional<Image> read_image(const std::filesystem::path& file,
                                              const Location& asked_at, Faults& faults,
                                              Digests* digests = nullptr);

/// A named plane of a picture: `R`, `G`, `B`, `depth.Z`, ...
struct Channel {
  std::string name;
  std::vector<float> values;
};

/// A plane that lies elsewhere, perhaps among others: pixel i has `values[i * step]`.
struct ChannelView {
  std::string name;
  std::span<const float> values;
  std::size_t step = 1;
};

/// A picture with every channel that its file has, under the file's names.
struct ChannelPicture {
  int width = 0, height = 0;
  std::vector<Channel> channels;
};

/// All channels as they stand in the file: nothing is made linear, and values need not be finite;
/// but a Radiance picture has R, G and B as `read_image` gives them.
/// Otherwise as `read_image`; a picture may hold as many numbers as the largest of three channels.
[[nodiscard]] std::optional<ChannelPicture> read_channels(const std::filesystem::path& file,
                                                          const Location& asked_at, Faults& faults);

using Metadata = std::vector<std::pair<std::string, std::string>>;

/// What a file is packed for: few bytes, or little time, where it is needed for a while only.
enum class Packing { small, quick };

/// Writes the channels (all of width × height) as the suffix says: `.exr` float, linear, with the
/// metadata; `.png`, `.jpg`, `.jpeg` 8-bit sRGB of R, G, B; to standard output as PNG. Encoded to
/// memory, written to a temporary file beside the target, flushed, renamed, read back: the old
/// picture stays whole until the new one is.
/// @throws SceneError if the suffix is another, WorkError with the path and the cause
void write_image(const std::filesystem::path& file, int width, int height,
                 const std::vector<Channel>& channels, const Metadata& metadata);
/// The same of channels that lie elsewhere.
void write_views(const std::filesystem::path& file, int width, int height,
                 const std::vector<ChannelView>& channels, const Metadata& metadata,
                 Packing packing);

/// Whether a file of that name holds light itself, of any size and with any channels, and not a
/// picture to look at.
[[nodiscard]] bool keeps_light(const std::filesystem::path& file);

/// @throws SceneError if the suffix is not known, WorkError if `file` can't be written there: no
/// such folder, no permission. Called before the first photon.
void check_writable(const std::filesystem::path& file);

}  // namespace portalens
