#include "app/output.h"

#include <fmt/format.h>

#include <iostream>
#include <iterator>
#include <span>
#include <system_error>
#include <utility>

#include "app/development_options.h"
#include "app/report.h"
#include "io/files.h"

namespace portalens {

bool is_part(const std::filesystem::path& file) { return file.extension() == partial_suffix; }

std::ostream& words_beside(const std::filesystem::path& file) {
  return file == standard_stream ? std::cerr : std::cout;
}

void check_not_an_input(const std::filesystem::path& output,
                        const std::vector<std::filesystem::path>& inputs) {
  for (const std::filesystem::path& input : inputs) {
    std::error_code error;
    if (!std::filesystem::equivalent(output, input, error)) continue;
    refuse(output.string() + " would be written over what it is made from",
           "name another file with -o");
  }
}

void check_output(const std::filesystem::path& file, const Assignment& assignment) {
  if (is_part(file)) return check_replaceable(file);
  check_writable(file);
  if (!assignment.whole_pixels())
    refuse(file.string() + " can't hold some samples of each pixel",
           "name a .part file with -o, and merge it with the others");
  if (!assignment.layers.empty() && !keeps_light(file))
    refuse(file.string() + " can't hold the layers", "name an .exr file with -o");
}

void write_picture(const std::filesystem::path& file, const RenderResult& result,
                   const Provenance& provenance, Packing packing) {
  std::vector<ChannelView> channels;
  const Development development = development_in(provenance.metadata);
  const bool plain = keeps_light(file) || development.changes_nothing();
  const Image shown = plain ? Image{} : developed(result.image, development);
  const std::span<const float> colors(plain ? result.image.pixels : shown.pixels);
  for (const char* name : {"R", "G", "B"})
    channels.push_back({name, colors.subspan(channels.size()), 3});
  for (const Channel& layer : result.layers) channels.push_back({layer.name, layer.values});
  Metadata metadata = provenance.metadata;
  Metadata more = result_metadata(result);
  std::move(more.begin(), more.end(), std::back_inserter(metadata));
  write_views(file, result.window.width(), result.window.height(), channels, metadata, packing);
}

void write_output(const std::filesystem::path& file, const Exposure& exposure,
                  const RenderResult& result, const Provenance& provenance) {
  if (is_part(file))
    replace_file(file, encoded_partial(provenance, exposure));
  else
    write_picture(file, result, provenance);
}

void tell(const RenderResult& result, const Provenance& provenance,
          const std::filesystem::path& file, const Telling& telling) {
  std::ostream& out = words_beside(file);
  if (telling.json) {
    out << json_line(statistics_json(result, provenance, file)) << '\n';
  } else if (!telling.quiet) {
    out << fmt::format("{}: {} x {}, {} samples a pixel, {:.2f} s; {}\n", file.string(),
                       result.window.width(), result.window.height(), result.samples.count(),
                       result.seconds, fates_text(result.tally));
    if (telling.statistics) out << statistics_text(result, provenance);
  }
  if (!telling.quiet) std::cerr << complaint(result.tally);
}

}  // namespace portalens
