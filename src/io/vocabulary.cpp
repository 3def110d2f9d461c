#include "io/vocabulary.h"

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

}  // namespace

Table* find_section(Scene& scene, std::string_view name) {
  for (const Section& section : sections) {
    if (section.name == name) return &(scene.*section.table);
  }
  return nullptr;
}

std::vector<std::string> sections_known() {
  std::vector<std::string> names;
  for (const Section& section : sections) names.emplace_back(section.name);
  return names;
}

}  // namespace portalens
