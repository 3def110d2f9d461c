#include "world/names.h"

#include "core/words.h"

namespace portalens {

std::string Names::claim(Parameters& parameters) {
  const int index = count_of_[parameters.kind()]++;
  const bool given = parameters.has("name");
  const std::string usual = parameters.kind() + std::to_string(index);
  std::string name = parameters.text("name", usual);
  if (name.empty()) {
    parameters.fault("name", "a name is empty", "give at least one letter, or leave it out");
    name = usual;
  }
  const auto [place, is_new] = taken_.emplace(name, parameters.where("name"));
  if (!is_new) {
    const std::string taken =
        in_quotes(name) + " is taken by line " + std::to_string(place->second.line);
    parameters.fault("name", (given ? "the name " : "its usual name ") + taken,
                     "give it a name of its own");
  }
  return name;
}

}  // namespace portalens
