// The OBJ dialect: any bytes as a scene of it.
#include <string>

#include "io/obj.h"
#include "laws.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace portalens;
  static const auto name = std::make_shared<const std::string>("scene.obj");
  Scene scene;
  scene.file = *name;
  read_obj(fuzz::as_text(data, size), name, scene);
  fuzz::check_scene(scene);
  return 0;
}
