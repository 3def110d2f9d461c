/// \file
/// `portalens image`: a picture as another kind of file, a layer as a picture with a legend, and
/// how much two pictures differ.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <set>

#include "app/command.h"
#include "app/development_options.h"
#include "app/false_color.h"
#include "app/json.h"
#include "io/image.h"
#include "render/layers.h"

namespace portalens {
namespace {

struct ImageArguments {
  std::filesystem::path file, output;
  std::string layer;
  std::vector<double> range;
  std::vector<std::filesystem::path> compared;
  std::optional<double> threshold;
  std::string measure = "max";
  bool json = false;
  Development development;
  std::vector<CLI::Option*> developing;  ///< the options that say how
};

[[noreturn]] void refuse(const std::string& problem, const std::string& remedy) {
  throw SceneError({{Location{}, problem, remedy}});
}

ChannelPicture read_layers(const std::filesystem::path& file) {
  Faults faults;
  auto picture = read_channels(file, Location{}, faults);
  faults.raise();
  return std::move(*picture);
}

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

/// Names for the legend of whole numbers: fates have theirs.
std::vector<NumberName> number_names(const std::string& layer, const std::vector<float>& values) {
  constexpr std::size_t most = 64;
  std::set<int> numbers;
  for (const float value : values)
    if (std::isfinite(value) && numbers.size() < most)
      numbers.insert(static_cast<int>(std::lround(std::clamp(value, -1e9f, 1e9f))));
  std::vector<NumberName> names;
  for (const int number : numbers) {
    const bool fate = layer == "fate" && number >= 0 && number < fate_count;
    names.push_back({number, fate ? std::string(fate_names[static_cast<std::size_t>(number)])
                                  : std::to_string(number)});
  }
  return names;
}

Image vector_picture(const ChannelPicture& picture, const std::string& layer,
                     const std::vector<const Channel*>& channels) {
  const ValueRange range = layer == "normal"   ? ValueRange{-1.0, 1.0}
                           : layer == "albedo" ? ValueRange{0.0, 1.0}
                                               : range_of(channels, no_depth);
  Image image(picture.width, picture.height, 3);
  const double span = range.high > range.low ? range.high - range.low : 1.0;
  for (std::size_t i = 0; i < channels.front()->values.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[3 * i + c] = static_cast<float>((channels[c]->values[i] - range.low) / span);
  return image;
}

Image read_color(const std::filesystem::path& file) {
  Faults faults;
  auto image = read_image(file, Location{}, faults);
  faults.raise();
  return std::move(*image);
}

int develop(const ImageArguments& arguments) {
  check_writable(arguments.output);
  const Image image = developed(read_color(arguments.file), arguments.development);
  if (keeps_light(arguments.output))
    std::cerr << "note: " << arguments.output.string()
              << " gets the colours alone: no layers, and nothing of the header\n";
  write_image(arguments.output, image.width, image.height, color_channels(image), {});
  return exit_done;
}

int show_layer(const ImageArguments& arguments) {
  check_writable(arguments.output);
  const ChannelPicture picture = read_layers(arguments.file);
  const std::string& layer = arguments.layer;
  const auto channels = channels_named(picture, layer);
  Image image;
  if (channels.size() == 3) {
    image = vector_picture(picture, layer, channels);
  } else {
    const Plane plane{picture.width, picture.height, channels.front()->values};
    const bool counted =
        layer == "object" || layer == "fate" || layer == "crossings" || layer == "order";
    const double absent = layer == "depth" ? no_depth : std::numeric_limits<double>::infinity();
    const ValueRange range = arguments.range.empty()
                                 ? range_of(channels, absent)
                                 : ValueRange{arguments.range[0], arguments.range[1]};
    image = counted ? number_picture(plane, number_names(layer, plane.values))
                    : heat_picture(plane, range, absent);
  }
  write_image(arguments.output, image.width, image.height, color_channels(image), {});
  return exit_done;
}

/// How far two pictures lie apart; a pixel's difference is the largest of its three channels'.
struct Comparison {
  double mean = 0.0, max = 0.0, p99 = 0.0;
  int x = 0, y = 0;  ///< where it is largest
  Plane differences;
};

Comparison comparison_of(const Image& a, const Image& b) {
  Comparison result;
  result.differences = {a.width, a.height, {}};
  std::vector<float>& values = result.differences.values;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); i += 3) {
    double most = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
      most = std::max(most, std::fabs(double{a.pixels[i + c]} - double{b.pixels[i + c]}));
    if (most > result.max) {
      result.max = most;
      result.x = static_cast<int>(i / 3) % a.width;
      result.y = static_cast<int>(i / 3) / a.width;
    }
    sum += most;
    values.push_back(static_cast<float>(most));
  }
  result.mean = sum / static_cast<double>(values.size());
  // The least value that 99 % of the pixels do not exceed.
  std::vector<float> sorted = values;
  const std::size_t rank = (99 * sorted.size() + 99) / 100 - 1;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank),
                   sorted.end());
  result.p99 = std::min(double{sorted[rank]}, result.max);
  return result;
}

int compare(const ImageArguments& arguments) {
  if (!arguments.output.empty()) check_writable(arguments.output);
  const Image a = read_color(arguments.compared[0]), b = read_color(arguments.compared[1]);
  if (a.width != b.width || a.height != b.height)
    refuse(
        fmt::format("--compare: {} x {} and {} x {} pixels", a.width, a.height, b.width, b.height),
        "two pictures of the same size are needed");
  const Comparison result = comparison_of(a, b);
  const double measured = arguments.measure == "mean"  ? result.mean
                          : arguments.measure == "p99" ? result.p99
                                                       : result.max;
  const bool alike = !arguments.threshold || measured <= *arguments.threshold;
  if (arguments.json)
    std::cout << json_line({{"mean", result.mean},
                            {"max", result.max},
                            {"p99", result.p99},
                            {"max_at", {result.x, result.y}},
                            {"alike", alike}})
              << '\n';
  else
    std::cout << fmt::format("mean {:.6g}, 99 % below {:.6g}, max {:.6g} at pixel {} {}\n",
                             result.mean, result.p99, result.max, result.x, result.y);
  if (!arguments.output.empty()) {
    const Image picture = heat_picture(result.differences, {0.0, result.max},
                                       std::numeric_limits<double>::infinity());
    write_image(arguments.output, picture.width, picture.height, color_channels(picture), {});
  }
  if (!alike)
    std::cerr << fmt::format("{} difference {:.6g} is above the threshold {:.6g}\n",
                             arguments.measure, measured, *arguments.threshold);
  return alike ? exit_done : exit_work_failed;
}

/// Which of the three was asked for, or why none.
Command command_of(const std::shared_ptr<ImageArguments>& arguments) {
  const auto asked = [](const CLI::Option* option) { return option->count() > 0; };
  const bool develops =
      std::any_of(arguments->developing.begin(), arguments->developing.end(), asked);
  if (develops && (!arguments->layer.empty() || !arguments->compared.empty()))
    throw CLI::ExcludesError("--exposure, --tone and --white-balance", "--layer and --compare");
  const bool shows = !arguments->file.empty() || !arguments->layer.empty();
  if (!arguments->compared.empty()) {
    if (shows) throw CLI::ExcludesError("--compare", "FILE and --layer");
    return [arguments] { return compare(*arguments); };
  }
  if (arguments->file.empty() || arguments->output.empty())
    throw CLI::RequiredError("FILE and -o, or --compare A B,");
  if (arguments->layer.empty()) return [arguments] { return develop(*arguments); };
  return [arguments] { return show_layer(*arguments); };
}

}  // namespace

void add_image_command(CLI::App& program, Command& chosen) {
  const auto arguments = std::make_shared<ImageArguments>();
  CLI::App& command = *program.add_subcommand(
      "image", "Turn a picture into another kind, show a layer, or compare two");
  command.add_option("FILE", arguments->file,
                     "A picture: EXR, PNG, HDR or JPEG; with layers by render --layers");
  arguments->developing = add_development_options(command, arguments->development);
  CLI::Option* layer = command
                           .add_option("--layer", arguments->layer,
                                       "The layer to show in colours with a legend, or a channel")
                           ->type_name("NAME");
  command
      .add_option("--range", arguments->range,
                  "The numbers at the legend's ends; by default the least and the largest")
      ->expected(2)
      ->needs(layer)
      ->type_name("LOW HIGH");
  CLI::Option* compared =
      command
          .add_option("--compare", arguments->compared,
                      "How much the colours of two pictures differ: linear values, of each pixel "
                      "the largest of its three channels' differences")
          ->expected(2)
          ->type_name("A B");
  CLI::Option* threshold = command
                               .add_option("--threshold", arguments->threshold,
                                           "Exit with 1 if the difference is above this")
                               ->needs(compared)
                               ->check(CLI::NonNegativeNumber)
                               ->type_name("T");
  command.add_option("--measure", arguments->measure, "Which difference the threshold is for")
      ->capture_default_str()
      ->needs(threshold)
      ->check(CLI::IsMember({"mean", "p99", "max"}));
  command
      .add_option("-o,--output", arguments->output,
                  "The picture to write, .png, .jpg or .exr; of a comparison, its differences")
      ->type_name("FILE");
  command.add_flag("--json", arguments->json, "Print the differences as one JSON object")
      ->needs(compared);
  command.footer(R"(
Examples:
  portalens image scene.exr -o scene.png --exposure 1 --tone filmic
  portalens image scene.exr --layer turning -o turning.png
  portalens image --compare a.png b.png --threshold 0.01 -o difference.png)");
  command.callback([arguments, &chosen] { chosen = command_of(arguments); });
}

}  // namespace portalens
