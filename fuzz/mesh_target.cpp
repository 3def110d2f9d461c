// Ordinary OBJ meshes: any bytes as a mesh, and what follows the line "#mtl" as the `m.mtl` beside
// it.
#include <string>

#include "io/read_mesh.h"
#include "laws.h"
#include "support/scene_folder.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace portalens;
  constexpr std::string_view mark = "#mtl\n";
  static const SceneFolder folder;
  const std::string_view text = fuzz::as_text(data, size);
  const std::size_t end = std::min(text.find(mark), text.size());
  const std::size_t begin = std::min(end + mark.size(), text.size());
  folder.write("m.mtl", std::string(text.substr(begin)));
  Faults faults;
  fuzz::check_mesh(read_mesh(folder.write("m.obj", std::string(text.substr(0, end))), {},
                             FileMaterials::read, faults));
  try {
    faults.raise();
  } catch (const SceneError& error) {
    fuzz::check_faults(error.faults());
  }
  return 0;
}
