// OpenEXR file layout (openexr.com, "OpenEXR File Layout").
#include "io/exr_texts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "io/bytes.h"
#include "io/exr_matrix.h"
#include "io/files.h"
#include "io/header_cursor.h"

namespace portalens {
namespace {

constexpr std::size_t max_header = std::size_t{16} << 20;

/// What a reader goes by, whatever the type that a file gives it.
bool is_structure(std::string_view name) {
  constexpr std::array<std::string_view, 14> names{"channels",
                                                   "compression",
                                                   "dataWindow",
                                                   "displayWindow",
                                                   "lineOrder",
                                                   "pixelAspectRatio",
                                                   "screenWindowCenter",
                                                   "screenWindowWidth",
                                                   "tiles",
                                                   "name",
                                                   "type",
                                                   "view",
                                                   "version",
                                                   "chunkCount"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string text_of_matrix(std::string_view bytes) {
  ExrMatrix matrix{};
  ByteReader(bytes).numbers(std::span<float>(matrix));
  return matrix_text(matrix);
}

Metadata texts_of(HeaderCursor in) {
  constexpr std::size_t magic_and_version = 8;
  in.take(magic_and_version);
  Metadata texts;
  while (!in.at_zero()) {
    const ExrAttribute attribute = take_exr_attribute(in);
    if (attribute.type == "string" && !is_structure(attribute.name))
      texts.emplace_back(attribute.name, attribute.value);
    if (attribute.name == matrix_entry && attribute.type == "m44f")
      texts.emplace_back(attribute.name, text_of_matrix(attribute.value));
  }
  return texts;
}

}  // namespace

Metadata read_exr_texts(const std::filesystem::path& file) {
  const std::string bytes = RegularFile(file).read(0, max_header);
  const std::string name = "the picture " + file.filename().string() + " ";
  if (image_format(bytes) != ImageFormat::exr) refuse(name + "is no EXR", "name an .exr file");
  try {
    return texts_of(HeaderCursor(bytes));
  } catch (const Refusal& refusal) {
    if (bytes.size() == max_header)
      refuse(name + "has a header of more than 16 MiB", "save it without");
    refuse(name + refusal.problem, refusal.remedy);
  }
}

}  // namespace portalens
