// The native format: any bytes as a scene's TOML, and as the value of a --set.
#include <string>

#include "io/override.h"
#include "io/read_scene.h"
#include "io/toml.h"
#include "laws.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace portalens;
  const std::string_view text = fuzz::as_text(data, size);
  static const auto name = std::make_shared<const std::string>("scene.toml");
  Scene scene;
  try {
    read_toml(text, name, scene);
    fuzz::check_scene(scene);
  } catch (const SceneError& error) {
    fuzz::check_faults(error.faults());
  }
  Faults faults;
  Scene changed;
  override_value(changed, std::string(text), faults);
  static_cast<void>(read_toml_value(std::string(text)));
  return 0;
}
