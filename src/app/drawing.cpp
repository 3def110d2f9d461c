#include "app/drawing.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "app/canvas.h"
#include "app/drawing_svg.h"
#include "core/error.h"
#include "io/files.h"
#include "io/image.h"
#include "math/srgb.h"

namespace portalens {
namespace {

enum class Format { svg, png };

std::optional<Format> known_format(const std::filesystem::path& file) {
  if (file == standard_stream) return Format::png;
  std::string suffix = file.extension().string();
  for (char& letter : suffix)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  if (suffix == ".svg") return Format::svg;
  if (suffix == ".png") return Format::png;
  return std::nullopt;
}

Format format_of(const std::filesystem::path& file) {
  if (const auto format = known_format(file)) return *format;
  refuse("can't draw " + file.string() + ": its kind is not known",
         "a drawing's name ends in .svg or .png");
}

std::vector<Channel> linear_channels(const Image& image) {
  std::vector<Channel> channels = {{"R", {}}, {"G", {}}, {"B", {}}};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    std::vector<float>& values = channels[channel].values;
    values.reserve(image.pixels.size() / 3);
    for (std::size_t i = channel; i < image.pixels.size(); i += 3)
      values.push_back(linear_from_srgb(std::clamp(image.pixels[i], 0.0f, 1.0f)));
  }
  return channels;
}

}  // namespace

Color color_from_linear(const Rgb& linear) {
  const auto shown = [](double value) { return srgb_from_linear(std::clamp(value, 0.0, 1.0)); };
  return {shown(linear.x), shown(linear.y), shown(linear.z)};
}

Rgb linear_from_color(const Color& color) {
  return {linear_from_srgb(color.red), linear_from_srgb(color.green), linear_from_srgb(color.blue)};
}

bool is_drawing_file(const std::filesystem::path& file) { return known_format(file).has_value(); }

void check_drawable(const std::filesystem::path& file) {
  static_cast<void>(format_of(file));
  check_replaceable(file);
}

void write_drawing(const std::filesystem::path& file, const Drawing& drawing) {
  if (format_of(file) == Format::svg)
    replace_file(file, svg_text(drawing));
  else
    write_image(file, drawing.width, drawing.height, linear_channels(rasterized(drawing)), {});
}

}  // namespace portalens
