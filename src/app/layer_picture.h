/// \file
/// A layer of a picture in colours, with a legend.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "app/false_color.h"
#include "core/image.h"
#include "io/image.h"

namespace portalens {

struct LayerStyle {
  std::optional<ValueRange> range;     ///< at the legend's ends; by default what there is
  std::map<int, std::string> objects;  ///< names of the numbers in the layer `object`
};

/// @param layer  the name of a layer, or of a channel
/// @throws SceneError if the picture has no such layer
[[nodiscard]] Image layer_picture(const ChannelPicture& picture, const std::string& layer,
                                  const LayerStyle& style);

}  // namespace portalens
