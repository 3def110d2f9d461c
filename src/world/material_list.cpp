#include "world/material_list.h"

#include <utility>

#include "core/words.h"

namespace portalens {

MaterialList::MaterialList(const std::vector<Table>& tables, Names& names, const ImageLoader& load,
                           Faults& faults) {
  for (const Table& table : tables) {
    Parameters parameters(table, faults);
    const std::string name = names.claim(parameters);
    Material material = Material::from(parameters, load);
    material.name = name;
    parameters.finish();
    materials_.push_back(std::move(material));
  }
  named_ = materials_.size();
}

std::uint32_t MaterialList::named_by(Parameters& parameters, std::string_view key) {
  if (!parameters.has(key)) return plain();
  const std::size_t before = parameters.faults().size();
  const std::string name = parameters.text(key);
  if (parameters.faults().size() > before) return plain();
  std::vector<std::string> known;
  for (std::uint32_t i = 0; i < named_; ++i) {
    if (materials_[i].name == name) return i;
    known.push_back(materials_[i].name);
  }
  parameters.fault(key, "unknown material " + portalens::quoted(name),
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
