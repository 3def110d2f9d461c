#include "io/toml.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "core/words.h"
#include "io/toml_depth.h"
#include "io/toml_letters.h"
#include "io/vocabulary.h"

namespace portalens {
namespace {

constexpr int max_brackets = 32;
constexpr int max_dots = 16;

using File = std::shared_ptr<const std::string>;

int line_of(const toml::source_region& source) { return static_cast<int>(source.begin.line); }

/// A table's entries in the order of the file; the library gives them by the alphabet.
std::vector<std::pair<const toml::key*, const toml::node*>> by_place(const toml::table& table) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (auto it = table.cbegin(); it != table.cend(); ++it) {
    entries.emplace_back(&it->first, &it->second);
  }
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    const toml::source_position& left = a.first->source().begin;
    const toml::source_position& right = b.first->source().begin;
    return std::tie(left.line, left.column) < std::tie(right.line, right.column);
  });
  return entries;
}

/// Turns the library's nodes into values with their places.
class Converter {
 public:
  Converter(File file, Faults& faults) : file_(std::move(file)), faults_(&faults) {}

  [[nodiscard]] Location at(int line) const { return {file_, line}; }

  Value value(const toml::node& node, int line) const {
    Value result{false, at(line)};
    if (const auto* flag = node.as_boolean()) {
      result.data = flag->get();
    } else if (const auto* integer = node.as_integer()) {
      result.data = std::int64_t{integer->get()};
    } else if (const auto* number = node.as_floating_point()) {
      result.data = number->get();
    } else if (const auto* text = node.as_string()) {
      result.data = undisguised(text->get());
    } else if (const auto* list = node.as_array()) {
      Value::List elements;
      for (auto it = list->cbegin(); it != list->cend(); ++it) {
        elements.push_back(value(*it, line_of(it->source())));
      }
      result.data = std::move(elements);
    } else if (const auto* table = node.as_table()) {
      result.data = dictionary(*table);
    } else {
      faults_->add(at(line), "a date or time stands where none is used",
                   "give a number, a string, true or false, or a list");
    }
    return result;
  }

  Value::Dictionary dictionary(const toml::table& table) const {
    Value::Dictionary entries;
    for (const auto& [key, node] : by_place(table)) {
      entries.push_back({undisguised(key->str()), value(*node, line_of(key->source()))});
    }
    return entries;
  }

 private:
  File file_;
  Faults* faults_;
};

/// Sorts the tables of a file into a scene.
class Sorter {
 public:
  Sorter(Scene& scene, const File& file)
      : scene_(&scene), faults_(&scene.faults), convert_(file, scene.faults) {}

  void sort(const toml::table& root) {
    for (const auto& [key, node] : by_place(root)) {
      const std::string name = undisguised(key->str());
      const Location where = convert_.at(line_of(key->source()));
      if (Table* section = find_section(*scene_, name)) {
        fill_section(*section, name, *node, where);
      } else {
        fill_list(name, *node, where);
      }
    }
    put_objects_in_order();
  }

 private:
  struct Placed {
    Location where;
    std::size_t column;
    Table table;
  };

  void fill_section(Table& section, const std::string& name, const toml::node& node,
                    const Location& where) {
    const toml::table* table = node.as_table();
    if (!table) {
      faults_->add(where, name + " is not a table",
                   "write [" + name + "] once, and its keys below it");
      return;
    }
    section.where = where;
    section.entries = convert_.dictionary(*table);
    if (name == "camera") scene_->has_camera = true;
  }

  void fill_list(const std::string& kind, const toml::node& node, const Location& where) {
    const toml::array* list = node.as_array();
    if (!list) {
      const auto form = node.is_table() ? Misplaced::Form::table : Misplaced::Form::key;
      scene_->misplaced.push_back({form, kind, where});
      return;
    }
    for (auto it = list->cbegin(); it != list->cend(); ++it) {
      const Location place = convert_.at(line_of(it->source()));
      const toml::table* element = it->as_table();
      if (!element) {
        scene_->misplaced.push_back({Misplaced::Form::element, kind, place});
        continue;
      }
      Table table{kind, place, convert_.dictionary(*element)};
      if (kind == "material") {
        scene_->materials.push_back(std::move(table));
      } else if (kind == "light") {
        scene_->lights.push_back(std::move(table));
      } else {
        placed_.push_back({place, it->source().begin.column, std::move(table)});
      }
    }
  }

  void put_objects_in_order() {
    std::stable_sort(placed_.begin(), placed_.end(), [](const Placed& a, const Placed& b) {
      return std::tie(a.where.line, a.column) < std::tie(b.where.line, b.column);
    });
    if (placed_.size() > max_objects) {
      faults_->add(placed_[max_objects].where,
                   "more than " + std::to_string(max_objects) + " objects", "put them in a mesh");
      return;
    }
    for (Placed& placed : placed_) scene_->objects.push_back(std::move(placed.table));
  }

  Scene* scene_;
  Faults* faults_;
  Converter convert_;
  std::vector<Placed> placed_;
};

/// False, and faults, if the parser must not see the text.
bool fit_to_parse(std::string_view text, const File& file, Faults& faults) {
  const TomlDepth depth = toml_depth(text);
  if (depth.brackets > max_brackets) {
    faults.add({file, depth.brackets_line},
               "lists inside lists, " + std::to_string(depth.brackets) + " deep",
               "at most " + std::to_string(max_brackets) + " are read");
  }
  if (depth.dots > max_dots) {
    faults.add({file, depth.dots_line}, "a key of " + std::to_string(depth.dots) + " dots",
               "at most " + std::to_string(max_dots) + " are read");
  }
  const int broken_line = line_not_utf8(text);
  if (broken_line > 0) {
    faults.add({file, broken_line}, "this is not TOML: it has bytes that are not UTF-8",
               "save it as UTF-8");
  }
  return depth.brackets <= max_brackets && depth.dots <= max_dots && broken_line == 0;
}

}  // namespace

void read_toml(std::string_view text, const File& name, Scene& scene) {
  Faults faults;
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.substr(0, byte_order_mark.size()) == byte_order_mark)
    text.remove_prefix(byte_order_mark.size());
  fit_to_parse(text, name, faults);
  faults.raise();
  try {
    const toml::table root = toml::parse(disguised(text), std::string_view(*name));
    Sorter(scene, name).sort(root);
  } catch (const toml::parse_error& error) {
    const std::string problem = undisguised(error.description());
    const bool in_braces = problem.find("inline table") != std::string::npos;
    throw SceneError({{{name, line_of(error.source())},
                       "this is not TOML: " + problem,
                       in_braces ? "a table in braces stands on one line, without a comma at its "
                                   "end (TOML 1.0): write [name] on a line, and its keys below"
                                 : "mend this first; what follows it has not been read"}});
  }
}

std::optional<Value> read_toml_value(const std::string& text) {
  const bool bare = !text.empty() && std::all_of(text.begin(), text.end(), [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
           (letter >= '0' && letter <= '9') || letter == '_' || letter == '-' || letter == '.' ||
           letter == '/';
  });
  Faults faults;
  const bool one_line = text.find_first_of("\r\n") == std::string::npos;
  if (!one_line || !fit_to_parse(text, nullptr, faults)) return std::nullopt;
  try {
    const toml::table root = toml::parse("value = " + disguised(text));
    const Value value = Converter(nullptr, faults).value(*root.get("value"), 0);
    if (faults.empty()) return value;
  } catch (const toml::parse_error&) {
    if (bare) return Value{text, {}};
  }
  return std::nullopt;
}

}  // namespace portalens
