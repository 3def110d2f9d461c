#include "portalens/picture.h"

#include <span>

#include "api/access.h"
#include "io/image.h"

namespace portalens::api {

void write_picture(const std::filesystem::path& file, const Picture& picture,
                   const Metadata& metadata) {
  guarded([&] {
    check_writable(file);
    const std::size_t pixels =
        picture.width < 1 || picture.height < 1
            ? 0
            : static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    if (pixels == 0 || picture.rgb.size() != 3 * pixels)
      throw asked("the picture for " + file.string() + " is not of the size it says",
                  "width and height of at least 1 are needed, and three numbers a pixel");
    if (!picture.layers.empty() && !keeps_light(file))
      throw asked(file.string() + " can't hold layers", "name an .exr file");
    const std::span<const float> colors(picture.rgb);
    std::vector<ChannelView> channels;
    for (const char* name : {"R", "G", "B"})
      channels.push_back({name, colors.subspan(channels.size()), 3});
    for (const Channel& layer : picture.layers) {
      if (layer.values.size() != pixels)
        throw asked("layer " + layer.name + " is not of the picture's size",
                    "one number a pixel is needed");
      channels.push_back({layer.name, layer.values});
    }
    write_views(file, picture.width, picture.height, channels, metadata, Packing::small);
  });
}

}  // namespace portalens::api
