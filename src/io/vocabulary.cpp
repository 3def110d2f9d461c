#include "io/vocabulary.h"

#include <algorithm>
#include <array>

namespace portalens {
namespace {

struct Section {
  std::string_view name;
  Table Scene::*table;
};

constexpr std::array sections{
    Section{"camera", &Scene::camera},   Section{"film", &Scene::film},
    Section{"sampler", &Scene::sampler}, Section{"physics", &Scene::physics},
    Section{"shading", &Scene::shading}, Section{"environment", &Scene::environment}};

constexpr std::array<std::string_view, 11> lists{"material", "light", "sphere",   "quad",
                                                 "cube",     "cone",  "cylinder", "ring",
                                                 "mesh",     "mass",  "portal"};

}  // namespace

Table* find_section(Scene& scene, std::string_view name) {
  for (const Section& section : sections) {
    if (section.name == name) return &(scene.*section.table);
  }
  return nullptr;
}

bool is_list(std::string_view name) {
  return std::find(lists.begin(), lists.end(), name) != lists.end();
}

std::vector<std::string> sections_known() {
  std::vector<std::string> names;
  for (const Section& section : sections) names.emplace_back(section.name);
  return names;
}

std::vector<std::string> tables_known() {
  std::vector<std::string> names = sections_known();
  names.insert(names.end(), lists.begin(), lists.end());
  return names;
}

}  // namespace portalens
