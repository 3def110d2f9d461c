/// \file
/// `portalens image`: a picture as another kind of file, a layer as a picture with a legend, and
/// how much two pictures differ.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

#include "app/choices.h"
#include "app/command.h"
#include "app/development_options.h"
#include "app/false_color.h"
#include "app/json.h"
#include "app/layer_picture.h"
#include "app/output.h"
#include "app/recipe.h"
#include "app/report.h"
#include "app/spooled_input.h"
#include "core/words.h"
#include "io/exr_texts.h"
#include "io/files.h"
#include "io/image.h"
#include "io/image_bytes.h"

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
  std::array<CLI::Option*, 3> developing{};  ///< exposure, tone and white balance
};

bool is_exr(const std::filesystem::path& file) {
  constexpr std::size_t enough = 16;
  return image_format(RegularFile(file).read(0, enough)) == ImageFormat::exr;
}

ChannelPicture read_layers(const std::filesystem::path& file) {
  Faults faults;
  auto picture = read_channels(file, Location{}, faults);
  faults.raise();
  return std::move(*picture);
}

Image read_color(const std::filesystem::path& file) {
  Faults faults;
  auto image = read_image(file, Location{}, faults);
  faults.raise();
  return std::move(*image);
}

bool is_given(const CLI::Option* option) { return option->count() > 0; }

/// The channels that can be written, and the colours in place of those that are there.
std::vector<Channel> kept_channels(ChannelPicture picture, std::vector<Channel> colors) {
  std::vector<Channel> kept = std::move(colors);
  for (Channel& channel : picture.channels) {
    const auto same = [&](const Channel& one) { return one.name == channel.name; };
    if (std::any_of(kept.begin(), kept.end(), same)) continue;
    const auto finite = [](float value) { return std::isfinite(value); };
    if (std::all_of(channel.values.begin(), channel.values.end(), finite))
      kept.push_back(std::move(channel));
    else
      std::cerr << "note: the channel " << harmless(channel.name)
                << " is left out: it has values that are not finite\n";
  }
  return kept;
}

/// What a header asks for, without what the options have done instead.
Development left_of(Development asked, const ImageArguments& arguments) {
  const auto& [exposure, tone, white_balance] = arguments.developing;
  if (is_given(exposure)) asked.exposure = 0.0;
  if (is_given(tone)) asked.tone = Tone::linear;
  if (is_given(white_balance)) asked.white_balance.reset();
  return asked;
}

/// All that an EXR holds, its colours developed as the options say.
int develop_into_exr(const ImageArguments& arguments) {
  Metadata header = read_exr_texts(arguments.file);
  // What has been done to the light must not be asked for once more, nor made again without it.
  if (std::any_of(arguments.developing.begin(), arguments.developing.end(), is_given)) {
    const Development rest = left_of(development_in(header), arguments);
    header = without_recipe(without_development(std::move(header)));
    for (auto& entry : development_metadata(rest)) header.push_back(std::move(entry));
  }
  const Image image = developed(read_color(arguments.file), arguments.development);
  write_image(arguments.output, image.width, image.height,
              kept_channels(read_layers(arguments.file), color_channels(image)), header);
  return exit_done;
}

/// What the picture's header says of it, but for what the options say.
Development development_of(const ImageArguments& arguments) {
  if (!is_exr(arguments.file)) return arguments.development;
  Development development = development_in(read_exr_texts(arguments.file));
  const auto& [exposure, tone, white_balance] = arguments.developing;
  if (is_given(exposure)) development.exposure = arguments.development.exposure;
  if (is_given(tone)) development.tone = arguments.development.tone;
  if (is_given(white_balance)) development.white_balance = arguments.development.white_balance;
  return development;
}

int develop(const ImageArguments& arguments) {
  check_writable(arguments.output);
  if (keeps_light(arguments.output) && is_exr(arguments.file)) return develop_into_exr(arguments);
  const Image image = developed(read_color(arguments.file), development_of(arguments));
  write_image(arguments.output, image.width, image.height, color_channels(image), {});
  return exit_done;
}

int show_layer(const ImageArguments& arguments) {
  check_writable(arguments.output);
  LayerStyle style;
  if (!arguments.range.empty()) {
    style.range = ValueRange{arguments.range[0], arguments.range[1]};
    if (!(style.range->low < style.range->high))
      refuse(fmt::format("--range {} {} is empty", style.range->low, style.range->high),
             "give the lower end first");
  }
  if (is_exr(arguments.file))
    for (const auto& [name, text] : read_exr_texts(arguments.file))
      if (name == "portalens:objects") style.objects = listed_names(text);
  const Image image = layer_picture(read_layers(arguments.file), arguments.layer, style);
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
  check_not_an_input(arguments.output, arguments.compared);
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
  std::ostream& out = words_beside(arguments.output);
  if (arguments.json)
    out << json_line({{"mean", result.mean},
                      {"max", result.max},
                      {"p99", result.p99},
                      {"max_at", {result.x, result.y}},
                      {"alike", alike}})
        << '\n';
  else
    out << fmt::format("mean {:.6g}, 99 % below {:.6g}, max {:.6g} at pixel {} {}\n", result.mean,
                       result.p99, result.max, result.x, result.y);
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
  const bool develops =
      std::any_of(arguments->developing.begin(), arguments->developing.end(), is_given);
  if (develops && (!arguments->layer.empty() || !arguments->compared.empty()))
    throw CLI::ArgumentMismatch(
        "--exposure, --tone and --white-balance are of no use to --layer and --compare");
  const bool shows = !arguments->file.empty() || !arguments->layer.empty();
  if (!arguments->compared.empty()) {
    if (shows) throw CLI::ExcludesError("--compare", "FILE and --layer");
    return [arguments] { return compare(*arguments); };
  }
  if (arguments->file.empty() || arguments->output.empty())
    throw CLI::RequiredError("FILE and -o, or --compare A B,");
  return [arguments] {
    const SpooledInput input(arguments->file);
    check_not_an_input(arguments->output, {arguments->file});
    arguments->file = input.file();
    return arguments->layer.empty() ? develop(*arguments) : show_layer(*arguments);
  };
}

}  // namespace

void add_image_command(CLI::App& program, Command& chosen) {
  const auto arguments = std::make_shared<ImageArguments>();
  CLI::App& command = *program.add_subcommand(
      "image", "Turn a picture into another kind, show a layer, or compare two");
  command.add_option("FILE", arguments->file,
                     "A picture: EXR, PNG, HDR or JPEG; with layers by render --layers; - is "
                     "standard input");
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
                               ->check(number_within(0.0, 1e30))
                               ->type_name("T");
  command.add_option("--measure", arguments->measure, "Which difference the threshold is for")
      ->capture_default_str()
      ->needs(threshold)
      ->check(CLI::IsMember({"mean", "p99", "max"}));
  command
      .add_option("-o,--output", arguments->output,
                  "The picture to write, .png, .jpg or .exr, or - for standard output, as PNG; of "
                  "a comparison, its differences")
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
