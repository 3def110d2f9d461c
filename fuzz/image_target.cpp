// Pictures: any bytes as an EXR, PNG, HDR or JPEG, read as a texture and with all its channels.
#include <string>

#include "io/exr_texts.h"
#include "io/image.h"
#include "laws.h"
#include "support/scene_folder.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace portalens;
  static const SceneFolder folder;
  const auto file = folder.write("picture", std::string(fuzz::as_text(data, size)));
  Faults faults;
  if (const auto image = read_image(file, {}, faults)) fuzz::check_image(*image);
  if (const auto picture = read_channels(file, {}, faults))
    for (const Channel& channel : picture->channels)
      fuzz::require(channel.values.size() == static_cast<std::size_t>(picture->width) *
                                                 static_cast<std::size_t>(picture->height),
                    "a channel has as many pixels as its picture");
  try {
    for (const auto& [name, text] : read_exr_texts(file))
      fuzz::require(name.find('\0') == std::string::npos, "a name ends at its first zero");
  } catch (const SceneError& error) {
    fuzz::check_faults(error.faults());
  }
  try {
    faults.raise();
  } catch (const SceneError& error) {
    fuzz::check_faults(error.faults());
  }
  return 0;
}
