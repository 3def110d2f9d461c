// What a picture's header says of its making, and its window: `--from` reads it.
#include <string>

#include "app/recipe.h"
#include "io/bytes.h"
#include "laws.h"
#include "support/scene_folder.h"
#include "target.h"

namespace {

using namespace portalens;

/// The header of an EXR with that entry and nothing else.
std::string header_with(std::string_view name, std::string_view text) {
  constexpr std::uint32_t magic = 20000630, version = 2;
  ByteWriter header;
  header.number(magic);
  header.number(version);
  header.raw(name);
  header.raw(std::string_view("\0string\0", 8));
  header.text(text);
  header.raw(std::string_view("\0", 1));
  return std::move(header).release();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const SceneFolder folder;
  const auto read = [](std::string_view text) {
    return read_recipe(folder.write("picture.exr", header_with("portalens:recipe", text)));
  };
  try {
    const Recipe recipe = read(fuzz::as_text(data, size));
    fuzz::require(recipe.scene_name.find('/') == std::string::npos, "a scene's name is no path");
    const Metadata again = recipe_metadata(recipe);
    fuzz::require(recipe_metadata(read(again.front().second)) == again,
                  "a recipe comes back as it was written");
  } catch (const SceneError& error) {
    fuzz::check_faults(error.faults());
  }
  return 0;
}
