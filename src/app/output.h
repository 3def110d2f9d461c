/// \file
/// What a render ends in: a picture with its layers, or a part of one, and what is said about it.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "io/image.h"
#include "render/partial.h"
#include "render/render.h"

namespace portalens {

/// Whether the file's name says that it is to be a part of a picture.
[[nodiscard]] bool is_part(const std::filesystem::path& file);

/// Where words go while something is written to that file: to standard error if it is standard
/// output.
[[nodiscard]] std::ostream& words_beside(const std::filesystem::path& file);

/// Keeps what was read from being written over.
/// @throws SceneError if the output is one of the inputs, by whatever name
void check_not_an_input(const std::filesystem::path& output,
                        const std::vector<std::filesystem::path>& inputs);

/// Finds out before the work whether the result can be written.
/// @param assignment  what will be taken
/// @throws SceneError if the file can't hold it, WorkError if the place can't be written
void check_output(const std::filesystem::path& file, const Assignment& assignment);

/// Writes a picture and its layers.
/// @throws WorkError
void write_picture(const std::filesystem::path& file, const RenderResult& result,
                   const Provenance& provenance, Packing packing = Packing::small);

/// Writes a complete exposure as its file's name says.
/// @throws WorkError
void write_output(const std::filesystem::path& file, const Exposure& exposure,
                  const RenderResult& result, const Provenance& provenance);

/// How much is said.
struct Telling {
  bool quiet = false, statistics = false, json = false;
};

/// What `render` and `merge` print in the end.
void tell(const RenderResult& result, const Provenance& provenance,
          const std::filesystem::path& file, const Telling& telling);

}  // namespace portalens
