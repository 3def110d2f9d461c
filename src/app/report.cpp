#include "app/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string_view>
#include <utility>

#include "app/development_options.h"
#include "app/progress_bar.h"
#include "app/view_metadata.h"
#include "core/words.h"
#include "portalens/version.h"
#include "render/manner.h"

namespace portalens {
namespace {

double per(std::uint64_t amount, double of) {
  return of > 0.0 ? static_cast<double>(amount) / of : 0.0;
}

std::string vector_text(Vec3d v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

std::uint64_t count_of(const Tally& tally, Fate fate) {
  return tally.fates[static_cast<std::size_t>(fate)];
}

/// How the threads' time divides; what they do besides is small.
std::string time_shares(const Tally& tally) {
  const double whole = tally.advancing + tally.shading + tally.shadowing;
  const auto percent = [&](double part) { return whole > 0.0 ? 100.0 * part / whole : 0.0; };
  return fmt::format("{:.1f} % field and surfaces, {:.1f} % shading, {:.1f} % shadow rays",
                     percent(tally.advancing), percent(tally.shading), percent(tally.shadowing));
}

/// What the header has under that name after "portalens:", or nothing.
std::string entry(const Metadata& header, std::string_view name) {
  for (const auto& [key, value] : header)
    if (key == fmt::format("portalens:{}", name)) return value;
  return "";
}

/// "NAME, because WHY", or NAME alone.
std::string with_reason(const Metadata& header, const std::string& name) {
  const std::string why = entry(header, name + "_because");
  return entry(header, name) + (why.empty() ? "" : ", because " + why);
}

/// How many steps of lanes were left to the scalar engine.
std::string handed_over_text(const Tally& tally) {
  return fmt::format("{}, {:.2f} % of all", tally.handed_over,
                     100.0 * per(tally.handed_over, static_cast<double>(tally.steps)));
}

Json lost_json(const RenderResult& result) {
  Json list = Json::array();
  for (const PixelSample& at : result.lost)
    list.push_back({{"pixel", {at.x, at.y}}, {"sample", at.sample}});
  return list;
}

}  // namespace

std::string fates_text(const Tally& tally) {
  std::string text;
  for (int i = 0; i < fate_count; ++i) {
    if (tally.fates[i] == 0) continue;
    const double percent = 100.0 * per(tally.fates[i], static_cast<double>(tally.photons));
    if (!text.empty()) text += ", ";
    text += fmt::format("{} {} %{}", fate_names[i],
                        percent < 0.01 ? "< 0.01" : fmt::format("{:.2f}", percent), "");
  }
  return text;
}

std::string engine_text(const Metadata& header) {
  const std::string looked_at = entry(header, "engine_in_double");
  const std::string rounding = entry(header, "engine_rounding");
  return with_reason(header, "engine") + (rounding.empty() ? "" : "; " + rounding) +
         (looked_at.empty() ? "" : "; paths near " + looked_at + " are looked along in double");
}

std::string photon_mode_text(const Metadata& header) { return with_reason(header, "photon_mode"); }

void add_manner(const Metadata& header, Json& json) {
  const auto text_or_null = [&](const char* name) {
    const std::string text = entry(header, name);
    return text.empty() ? Json() : Json(text);
  };
  json["engine"] = {{"name", text_or_null("engine")},
                    {"because", text_or_null("engine_because")},
                    {"rounding", text_or_null("engine_rounding")},
                    {"in_double", text_or_null("engine_in_double")}};
  json["photon_mode"] = {{"name", text_or_null("photon_mode")},
                         {"because", text_or_null("photon_mode_because")}};
}

std::string statistics_text(const RenderResult& result, const Provenance& provenance) {
  const Tally& tally = result.tally;
  const auto photons = static_cast<double>(tally.photons);
  std::string text;
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<16}{}\n", name, value);
  };
  line("engine", engine_text(provenance.metadata));
  line("photon mode", photon_mode_text(provenance.metadata));
  line("camera samples", fmt::format("{}", tally.samples));
  line("photons", fmt::format("{}", tally.photons));
  if (tally.interpolated > 0)
    line("interpolated",
         fmt::format("{}, with {} probe rays", tally.interpolated, tally.probe_rays));
  for (int i = 0; i < fate_count; ++i)
    line("", fmt::format("{:<10}{:>12}  {:6.2f} %", fate_names[i], tally.fates[i],
                         100.0 * per(tally.fates[i], photons)));
  if (tally.out_of_crossings > 0)
    line("", fmt::format("{} of those lost ran out of crossings", tally.out_of_crossings));
  line("steps a photon", fmt::format("{:.2f}", per(tally.steps, photons)));
  if (tally.handed_over > 0) line("left to scalar", handed_over_text(tally));
  line("crossings", fmt::format("{}", tally.crossings));
  line("shadow queries", fmt::format("{}", tally.shadow_queries));
  line("time", fmt::format("{:.2f} s", result.seconds));
  line("of it", time_shares(tally));
  line("rate",
       fmt::format("{} photons/s, {} steps/s", rounded_count(per(tally.photons, result.seconds)),
                   rounded_count(per(tally.steps, result.seconds))));
  if (!result.lost.empty()) line("lost first", "");
  for (const PixelSample& at : result.lost)
    text += fmt::format("    portalens trace {} --pixel {} {} --sample {}\n",
                        harmless(provenance.scene_words), at.x, at.y, at.sample);
  return text;
}

Json statistics_json(const RenderResult& result, const Provenance& provenance,
                     const std::filesystem::path& picture) {
  const Tally& tally = result.tally;
  Json fates = Json::object();
  for (int i = 0; i < fate_count; ++i) fates[std::string(fate_names[i])] = tally.fates[i];
  Json json = {
      {"picture", picture.string()},
      {"complete", result.completion == Completion::complete},
      {"width", result.window.width()},
      {"height", result.window.height()},
      {"samples_per_pixel", result.samples.count()},
      {"samples", tally.samples},
      {"photons", tally.photons},
      {"interpolated", tally.interpolated},
      {"probe_rays", tally.probe_rays},
      {"fates", fates},
      {"lost_by_crossings", tally.out_of_crossings},
      {"not_finite", tally.not_finite},
      {"steps", tally.steps},
      {"steps_handed_over", tally.handed_over},
      {"steps_per_photon", per(tally.steps, static_cast<double>(tally.photons))},
      {"crossings", tally.crossings},
      {"shadow_queries", tally.shadow_queries},
      {"lost_first", lost_json(result)},
      {"seconds", result.seconds},
      {"thread_seconds",
       {{"advance", tally.advancing}, {"shading", tally.shading}, {"shadows", tally.shadowing}}},
      {"photons_per_second", per(tally.photons, result.seconds)}};
  add_manner(provenance.metadata, json);
  return json;
}

Metadata world_metadata(const World& world, const RenderOptions& options) {
  const Physics& physics = world.space.physics;
  const ShadingLimits& limits = world.appearance.limits;
  Metadata metadata = {
      {"Software", "portalens " + std::string(api::version)},
      {"portalens:scene", world.file.filename().string()},
      {"portalens:film", fmt::format("{} x {}", world.film.width, world.film.height)},
      {"portalens:samples", fmt::format("{}", world.sampling.samples)},
      {"portalens:seed", fmt::format("{}", world.sampling.seed)},
      {"portalens:G", fmt::format("{}", physics.G)},
      {"portalens:c", fmt::format("{}", physics.c)},
      {"portalens:min_force", fmt::format("{}", physics.min_force)},
      {"portalens:law", physics.law},
      {"portalens:integrator", physics.integrator},
      {physics.integrator == "adaptive" ? "portalens:tolerance" : "portalens:step",
       fmt::format("{}", physics.integrator == "adaptive" ? physics.tolerance : physics.step)},
      {"portalens:max_steps", fmt::format("{}", physics.max_steps)},
      {"portalens:max_length", fmt::format("{}", physics.max_length)},
      {"portalens:max_turning", fmt::format("{}", physics.max_turning)},
      {"portalens:portal_gravity", physics.portal_gravity},
      {"portalens:portal_gravity_depth", fmt::format("{}", physics.portal_gravity_depth)},
      {"portalens:max_crossings", fmt::format("{}", world.space.max_crossings)},
      {"portalens:max_bounces", fmt::format("{}", limits.max_bounces)},
      {"portalens:shadow_samples", fmt::format("{}", limits.shadow_samples)},
      {"portalens:ambient", vector_text(limits.ambient)}};
  for (auto& entry : view_metadata(world)) metadata.push_back(std::move(entry));
  for (auto& entry : development_metadata(world.film.development))
    metadata.push_back(std::move(entry));
  for (auto& entry : manner_metadata(manner_of(world, options)))
    metadata.push_back(std::move(entry));
  return metadata;
}

Metadata result_metadata(const RenderResult& result) {
  const Window& window = result.window;
  Metadata metadata = {
      {"portalens:window", fmt::format("{} {} {} {}", window.x0, window.y0, window.x1, window.y1)},
      {"portalens:complete", result.completion == Completion::complete ? "yes" : "no"},
      {"portalens:photons", fmt::format("{}", result.tally.photons)}};
  for (int i = 0; i < fate_count; ++i)
    metadata.emplace_back(fmt::format("portalens:{}", fate_names[i]),
                          fmt::format("{}", result.tally.fates[i]));
  return metadata;
}

std::string object_list(const World& world) {
  constexpr std::size_t most = 1000;
  const std::vector<std::string> names = object_names(world);
  std::string list;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
    list += fmt::format("{} {}\n", i + 1, names[i]);
  return list;
}

std::map<int, std::string> listed_names(const std::string& list) {
  std::map<int, std::string> names;
  std::istringstream lines(list);
  for (std::string line; std::getline(lines, line);) {
    int number = 0;
    const char* const end = line.data() + line.size();
    const auto [stopped, error] = std::from_chars(line.data(), end, number);
    if (error == std::errc{} && stopped != end && *stopped == ' ')
      names.emplace(number, harmless(std::string(stopped + 1, end)));
  }
  return names;
}

std::string complaint(const Tally& tally) {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("note: {} {}\n", count, what);
  };
  add(tally.out_of_crossings,
      "photons were lost at the portal after shading.max_crossings others: they show the "
      "environment, or shading.lost_color if that is given");
  add(count_of(tally, Fate::lost) - tally.out_of_crossings,
      "photons were lost (shading.lost_color): they ran out of physics.max_steps or "
      "physics.max_length, or came where a pull has no bound");
  add(count_of(tally, Fate::trapped),
      "photons were trapped (black): they turned by more than physics.max_turning");
  add(tally.not_finite,
      "samples gave light that is not a number; they are shown as lost (--stats names the "
      "first)");
  return text;
}

}  // namespace portalens
