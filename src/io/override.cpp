#include "io/override.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/words.h"
#include "io/toml.h"
#include "io/vocabulary.h"

namespace portalens {
namespace {

/// `key` of `[section]`, or of the `[[section]]` of that name.
struct Target {
  std::string section;
  std::optional<std::string> name;
  std::string key;
};

/// What stands before the equals sign; a name may have dots in it, a key none.
std::optional<Target> target_in(const std::string& path) {
  const std::size_t first = path.find('.'), last = path.rfind('.');
  if (first == std::string::npos || first == 0 || last + 1 == path.size()) return std::nullopt;
  Target target{path.substr(0, first), std::nullopt, path.substr(last + 1)};
  if (last > first + 1) target.name = path.substr(first + 1, last - first - 1);
  if (last == first + 1) return std::nullopt;
  return target;
}

/// Numbers as shells print them: TOML wants a digit before the point. Within quotes all stays.
std::string with_leading_zeros(const std::string& value) {
  if (value.find_first_of("\"'") != std::string::npos) return value;
  std::string spelled;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const bool begins =
        i == 0 || std::string_view("[, +-=").find(value[i - 1]) != std::string::npos;
    const bool point =
        value[i] == '.' && i + 1 < value.size() && value[i + 1] >= '0' && value[i + 1] <= '9';
    if (begins && point) spelled += '0';
    spelled += value[i];
  }
  return spelled;
}

std::vector<Table*> tables_of(Scene& scene) {
  std::vector<Table*> tables;
  for (auto* list : {&scene.materials, &scene.lights, &scene.objects})
    for (Table& table : *list) tables.push_back(&table);
  return tables;
}

std::string name_of(const Table& table, std::size_t index) {
  const Value* name = table.find("name");
  const auto* given = name ? std::get_if<std::string>(&name->data) : nullptr;
  return given ? *given : table.kind + std::to_string(index);
}

void add_once(std::vector<std::string>& words, const std::string& word) {
  for (const std::string& known : words)
    if (known == word) return;
  words.push_back(word);
}

/// The element that is meant; where there is none, a fault says which there are.
Table* find_element(Scene& scene, const Target& target, Faults& faults, const Location& set_at) {
  if (find_section(scene, target.section)) {
    faults.add(set_at, "a value of [" + target.section + "] has no parts to be set alone",
               "set all of it, as in " + target.section + "." + *target.name + "=...");
    return nullptr;
  }
  std::vector<std::string> kinds, names;
  for (Table* table : tables_of(scene)) {
    add_once(kinds, table->kind);
    if (table->kind != target.section) continue;
    const std::string index = std::to_string(names.size());
    names.push_back(name_of(*table, names.size()));
    if (names.back() == target.name || index == target.name) return table;
  }
  if (names.empty())
    faults.add(set_at, "the scene has no [[" + target.section + "]]",
               suggestion_or_list(target.section, kinds));
  else
    faults.add(set_at, "no [[" + target.section + "]] is named " + in_quotes(*target.name),
               suggestion_or_list(*target.name, names));
  return nullptr;
}

/// An element was meant, but not named, or none of its values; or a section that there is not.
void refuse_section(Scene& scene, const Target& target, Faults& faults, const Location& set_at) {
  std::vector<std::string> names;
  for (const Table* table : tables_of(scene))
    if (table->kind == target.section) names.push_back(name_of(*table, names.size()));
  if (names.empty())
    faults.add(set_at, "unknown section " + in_quotes(target.section),
               suggestion_or_list(target.section, sections_known()));
  else if (std::find(names.begin(), names.end(), target.key) != names.end())
    faults.add(set_at, in_quotes(target.section + "." + target.key) + " does not say which value",
               "write its key, as in " + target.section + "." + target.key + ".KEY=...");
  else
    faults.add(
        set_at, in_quotes(target.section + "." + target.key) + " does not say which one",
        "write its name, as in " + target.section + "." + names[0] + "." + target.key + "=...");
}

/// Whether the text was meant as a number, and is none of TOML's: 007, 5., 1e999.
bool is_odd_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789.+-eE_") == std::string::npos &&
         text.find_first_of("0123456789") != std::string::npos;
}

void place(Value& value, const Location& where) {
  value.where = where;
  if (auto* list = std::get_if<Value::List>(&value.data))
    for (Value& one : *list) place(one, where);
  if (auto* dictionary = std::get_if<Value::Dictionary>(&value.data))
    for (Entry& entry : *dictionary) place(entry.value, where);
}

}  // namespace

void override_value(Scene& scene, const std::string& assignment, Faults& faults,
                    const Location& set_at) {
  const std::size_t equals = assignment.find('=');
  const auto target =
      equals == std::string::npos ? std::nullopt : target_in(assignment.substr(0, equals));
  if (!target) {
    faults.add(set_at, in_quotes(assignment) + " sets nothing",
               "write SECTION.KEY=VALUE, as in physics.tolerance=1e-5, or KIND.NAME.KEY=VALUE, as "
               "in sphere.ball.radius=2");
    return;
  }
  Table* table = target->name ? find_element(scene, *target, faults, set_at)
                              : find_section(scene, target->section);
  if (!table) {
    if (!target->name) refuse_section(scene, *target, faults, set_at);
    return;
  }
  const std::string text = assignment.substr(equals + 1);
  auto value = read_toml_value(with_leading_zeros(text));
  if (value && std::holds_alternative<std::string>(value->data) && is_odd_number(text)) {
    faults.add(set_at, in_quotes(text) + " is no number of TOML",
               "write it without zeros before it, with a digit after its point, below 1e308");
    return;
  }
  if (!value) {
    faults.add(set_at, in_quotes(assignment.substr(equals + 1)) + " is no value",
               "give a number, true or false, a word, a \"string\" or a [list]");
    return;
  }
  place(*value, set_at);
  table->set(target->key, std::move(*value));
  if (!target->name && target->section == "camera") scene.has_camera = true;
}

}  // namespace portalens
