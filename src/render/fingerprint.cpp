#include "render/fingerprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "io/digest.h"
#include "lanes/instruction_sets.h"
#include "portalens/version.h"
#include "render/source_digest.h"

namespace portalens {
namespace {

/// The most values of objects, materials and lights that are listed one by one.
constexpr std::size_t max_entries = 2000;

std::string value_text(const Value& value) {
  struct Text {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const Value::List& list) const {
      std::string text;
      for (const Value& one : list) text += (text.empty() ? "[" : ", ") + value_text(one);
      return (text.empty() ? "[" : text) + "]";
    }
    std::string operator()(const Value::Dictionary& entries) const {
      std::string text;
      for (const auto& [key, one] : entries)
        text += (text.empty() ? "{" : ", ") + key + " = " + value_text(one);
      return (text.empty() ? "{" : text) + "}";
    }
  };
  return std::visit(Text{}, value.data);
}

void add_table(const std::string& name, const Table& table, Fingerprint& fingerprint) {
  for (const auto& [key, value] : table.entries)
    fingerprint.emplace_back(name + "." + key, value_text(value));
}

/// `sphere 'ball'`, or `sphere #3` if it has no name of its own: the fourth of all tables.
std::string table_name(const Table& table, std::size_t index) {
  const Value* name = table.find("name");
  const auto* text = name ? std::get_if<std::string>(&name->data) : nullptr;
  return text ? fmt::format("{} '{}'", table.kind, *text)
              : fmt::format("{} #{}", table.kind, index);
}

void add_objects(const Scene& scene, Fingerprint& fingerprint) {
  Fingerprint all;
  std::string order;
  for (const auto* tables : {&scene.materials, &scene.lights, &scene.objects})
    for (std::size_t i = 0; i < tables->size(); ++i) {
      const Table& table = (*tables)[i];
      const std::string name = table_name(table, i);
      order += name + '\n';
      add_table(name, table, all);
    }
  if (all.size() > max_entries) {
    std::string text;
    for (const auto& [name, value] : all) text += name + '\n' + value + '\n';
    all = {{"the objects", digest(text)}};
  }
  fingerprint.insert(fingerprint.end(), all.begin(), all.end());
  fingerprint.emplace_back("the order of the objects", digest(order));
}

/// The widest instructions that the processor has: what libraries choose their paths by.
std::string processor_kind() {
  for (const char* name : {"avx512", "avx2", "sse4"})
    if (lane_engine(name).step) return name;
  return "older than sse4";
}

std::string engine_name(const World& world, const RenderOptions& options) {
  if (!takes_lanes(world.space, options.engine)) return "scalar";
  return fmt::format("lanes of {}, {}", lane_engine().name,
                     interpolates(world, options) ? "fewer photons" : "all photons");
}

std::string layer_list(const std::vector<Layer>& layers) {
  std::string text;
  for (const Layer layer : layers)
    text += (text.empty() ? "" : ",") + std::string(layer_names[static_cast<std::size_t>(layer)]);
  return text.empty() ? "none" : text;
}

}  // namespace

Fingerprint fingerprint_of(const Scene& scene, const World& world, const RenderOptions& options) {
  Fingerprint fingerprint = {
      {"the program", std::string(api::version) + " (sources " PORTALENS_SOURCE_DIGEST ")"},
      {"the kind of processor", processor_kind()},
      {"the engine", engine_name(world, options)},
      {"film.width", fmt::format("{}", world.film.width)},
      {"film.height", fmt::format("{}", world.film.height)},
      {"sampler.samples", fmt::format("{}", world.sampling.samples)},
      {"sampler.seed", fmt::format("{}", world.sampling.seed)}};
  add_table("camera", scene.camera, fingerprint);
  add_table("physics", scene.physics, fingerprint);
  add_table("shading", scene.shading, fingerprint);
  add_table("environment", scene.environment, fingerprint);
  for (const auto& [name, content] : world.files)
    fingerprint.emplace_back("the file " + name, content);
  add_objects(scene, fingerprint);
  return fingerprint;
}

Fingerprint fingerprint_of(const Assignment& assignment) {
  const auto& [x0, y0, x1, y1] = assignment.window;
  const auto& [begin, end] = assignment.range;
  const bool whole = assignment.window == assignment.film;
  return {{"--crop", whole ? "the whole picture" : fmt::format("{} {} {} {}", x0, y0, x1, y1)},
          {"--samples-from", fmt::format("{}", begin)},
          {"--samples-to", end == assignment.samples ? "the last" : fmt::format("{}", end)},
          {"--layers", layer_list(assignment.layers)},
          {"--tile", fmt::format("{}", assignment.tile_size)}};
}

std::vector<Difference> differences(const Fingerprint& before, const Fingerprint& now) {
  const std::map<std::string, std::string> known(now.begin(), now.end());
  const std::map<std::string, std::string> old(before.begin(), before.end());
  std::vector<Difference> list;
  for (const auto& [name, value] : before) {
    const auto found = known.find(name);
    if (found == known.end())
      list.push_back({name, value, "not set"});
    else if (found->second != value)
      list.push_back({name, value, found->second});
  }
  for (const auto& [name, value] : now)
    if (old.count(name) == 0) list.push_back({name, "not set", value});
  return list;
}

}  // namespace portalens
