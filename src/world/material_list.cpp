#include "world/material_list.h"

#include <utility>

#include "core/words.h"

namespace portalens {
namespace {

constexpr std::size_t max_compared = 1000;  // names a misspelt one is held against
constexpr std::size_t max_guesses = 100;    // among so many faults nobody needs another

}  // namespace

MaterialList::MaterialList(const std::vector<Table>& tables, Names& names, const ImageLoader& load,
                           Faults& faults) {
  for (const Table& table : tables) {
    Parameters parameters(table, faults);
    const std::string name = names.claim(parameters);
    Material material = Material::from(parameters, load);
    material.name = name;
    parameters.finish();
    by_name_.emplace(name, add(std::move(material)));
  }
}

std::uint32_t MaterialList::named_by(Parameters& parameters, std::string_view key) {
  if (!parameters.has(key)) return plain();
  const std::size_t before = parameters.faults().size();
  const std::string name = parameters.text(key);
  if (parameters.faults().size() > before) return plain();
  if (const auto found = by_name_.find(name); found != by_name_.end()) return found->second;
  const bool guess = before < max_guesses;
  std::vector<std::string> known;
  for (auto it = by_name_.begin(); guess && it != by_name_.end() && known.size() < max_compared;
       ++it)
    known.push_back(it->first);
  parameters.fault(key, "unknown material " + in_quotes(name),
                   known.empty() ? "define it in a [[material]] table of its own"
                                 : suggestion_or_list(name, known));
  return plain();
}

std::uint32_t MaterialList::add(Material material) {
  materials_.push_back(std::move(material));
  return static_cast<std::uint32_t>(materials_.size() - 1);
}

/// The material of what has none: mid-grey.
std::uint32_t MaterialList::plain() {
  if (!plain_) {
    Material material;
    material.name = "plain";
    plain_ = add(std::move(material));
  }
  return *plain_;
}

}  // namespace portalens
