#include "app/layer_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

#include "core/error.h"
#include "render/layers.h"

namespace portalens {
namespace {

/// The channels that a name means: a layer's, or the one of that very name.
std::vector<const Channel*> channels_named(const ChannelPicture& picture, const std::string& name) {
  std::vector<std::string> wanted = {name};
  const auto layer = std::find(layer_names.begin(), layer_names.end(), name);
  if (layer != layer_names.end())
    wanted = channel_names(static_cast<Layer>(layer - layer_names.begin()));
  std::vector<const Channel*> found;
  for (const std::string& channel_name : wanted)
    for (const Channel& channel : picture.channels)
      if (channel.name == channel_name) found.push_back(&channel);
  if (!found.empty()) return found;
  std::string known;
  for (const Channel& channel : picture.channels)
    known += (known.empty() ? "" : ", ") + channel.name;
  refuse("--layer " + name + ": the picture has no such layer",
         "its channels are " + known + "; layers are in an .exr that render --layers wrote");
}

/// From the least to the largest number that is there.
ValueRange range_of(const std::vector<const Channel*>& channels, double absent) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Channel* channel : channels)
    for (const double value : channel->values)
      if (std::isfinite(value) && value < absent) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
  return low <= high ? ValueRange{low, high} : ValueRange{};
}

/// The names of a layer's whole numbers, as far as they have any.
std::map<int, std::string> known_names(const std::string& layer, const LayerStyle& style) {
  std::map<int, std::string> names;
  if (layer == "object") {
    names = style.objects;
    names.emplace(0, "none");
  }
  if (layer == "fate")
    for (int i = 0; i < fate_count; ++i) names.emplace(i, fate_names[static_cast<std::size_t>(i)]);
  return names;
}

/// Names for the legend of whole numbers.
/// @param known  of those that have names of their own
std::vector<NumberName> number_names(const std::map<int, std::string>& known,
                                     const std::vector<float>& values) {
  constexpr std::size_t most = 64;
  std::set<int> numbers;
  for (const float value : values)
    if (std::isfinite(value) && numbers.size() < most)
      numbers.insert(static_cast<int>(std::lround(std::clamp(value, -1e9f, 1e9f))));
  std::vector<NumberName> names;
  for (const int number : numbers) {
    const auto name = known.find(number);
    names.push_back({number, name == known.end() ? std::to_string(number) : name->second});
  }
  return names;
}

Image vector_picture(const ChannelPicture& picture, const std::string& layer,
                     const std::vector<const Channel*>& channels) {
  if (layer != "albedo")
    return axes_picture(picture.width, picture.height,
                        {channels[0]->values, channels[1]->values, channels[2]->values},
                        layer == "normal" ? ValueRange{-1.0, 1.0} : range_of(channels, no_depth));
  Image image(picture.width, picture.height, 3);
  for (std::size_t i = 0; i < channels.front()->values.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = channels[c]->values[i];
  return image;
}

}  // namespace

Image layer_picture(const ChannelPicture& picture, const std::string& layer,
                    const LayerStyle& style) {
  const auto channels = channels_named(picture, layer);
  if (channels.size() == 3) return vector_picture(picture, layer, channels);
  const Plane plane{picture.width, picture.height, channels.front()->values};
  if (layer == "object" || layer == "fate" || layer == "crossings" || layer == "order") {
    if (style.range)
      refuse("--range: the layer " + layer + " has a colour for each number", "leave it out");
    return number_picture(plane, number_names(known_names(layer, style), plane.values));
  }
  const double absent = layer == "depth" ? no_depth : std::numeric_limits<double>::infinity();
  return heat_picture(plane, style.range.value_or(range_of(channels, absent)), absent);
}

}  // namespace portalens
