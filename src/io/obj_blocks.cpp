// The statements of the OBJ dialect that have words of their own inside: materials and cameras.
#include <algorithm>
#include <utility>

#include "core/words.h"
#include "io/mtl.h"
#include "io/obj_reader.h"

namespace portalens {
namespace {}  // namespace

bool ObjReader::perspective_camera() { return camera("perspective", "angle", "fov"); }
bool ObjReader::orthographic_camera() { return camera("orthographic", "size", "size"); }

bool ObjReader::camera_mark(std::string_view mark) {
  const Token token = tokens_.peek_part();
  if (token.text != mark)
    return refuse(token, in_quotes(token.text) + " where '" + std::string(mark) + "' should stand");
  tokens_.next_part();
  return true;
}

bool ObjReader::camera_entry(std::string_view size_word, const std::string& size_key) {
  const Token word = tokens_.peek_part();
  const std::string key = word.text == "camera_position"     ? "position"
                          : word.text == "point_of_interest" ? "look_at"
                          : word.text == "up"                ? "up"
                          : word.text == size_word           ? size_key
                                                             : "";
  if (key.empty()) return refuse(word, in_quotes(word.text) + " is not a camera's");
  if (scene_->camera.find(key)) return refuse(word, in_quotes(word.text) + " is given twice");
  tokens_.next_part();
  const bool is_point = key != size_key;
  std::array<double, 3> point{};
  if (is_point && !camera_mark("<")) return false;
  for (std::size_t i = 0; i < (is_point ? 3 : 1); ++i) {
    if (i > 0 && !camera_mark(",")) return false;
    const Token token = tokens_.peek_part();
    const auto parsed = parse_number(token.text);
    if (!parsed) return refuse(token, in_quotes(token.text) + " is not a finite number");
    point[i] = *parsed;
    tokens_.next_part();
  }
  if (is_point && !camera_mark(">")) return false;
  Value value = is_point ? list(point) : number(point[0]);
  scene_->camera.set(key, std::move(value));
  return true;
}

bool ObjReader::camera(const std::string& type, std::string_view size_word,
                       const std::string& size_key) {
  if (has_camera_) {
    faults_->add(here(), "a second camera", "give one");
    return false;
  }
  has_camera_ = true;
  scene_->camera.where = here();
  if (!camera_entries(size_word, size_key)) {
    scene_->camera.entries.clear();  // told once is enough: compile must not miss the rest of it
    return false;
  }
  scene_->camera.set("type", text(type));
  if (type == "perspective") scene_->camera.set("fov_axis", text("smaller"));
  scene_->has_camera = true;
  return true;
}

bool ObjReader::camera_entries(std::string_view size_word, const std::string& size_key) {
  if (!camera_mark("{")) return false;
  while (tokens_.peek_part().text != "}") {
    if (!camera_entry(size_word, size_key)) return false;
  }
  tokens_.next_part();
  bool whole_camera = true;
  for (const std::string& key :
       {std::string("position"), std::string("look_at"), std::string("up"), size_key}) {
    if (!scene_->camera.find(key)) {
      faults_->add(here(), "the camera lacks its " + key, "write " + std::string(current_->form));
      whole_camera = false;
    }
  }
  return whole_camera;
}

bool ObjReader::material_entry(Table& table, std::string_view word) {
  const std::string key(word == "texture_file" ? "diffuse" : word);
  if (table.find(key)) return refuse(tokens_.peek(), "the material has two of " + in_quotes(word));
  tokens_.next();
  if (word == "texture_file") {
    const Token name = tokens_.peek();
    if (name.at_end()) return refuse(name, "");
    tokens_.next();
    table.set(key, {std::string(name.text), {file_, name.line}});
    return true;
  }
  if (word == "roughness") {
    std::array<double, 1> value{};
    if (!numbers(value)) return false;
    table.set(key, number(value[0]));
    return true;
  }
  std::array<double, 3> color{};
  if (!numbers(color)) return false;
  if (word == "emitted") emits_ |= color != std::array<double, 3>{};
  table.set(key, list(color));
  return true;
}

bool ObjReader::material() {
  constexpr std::array<std::string_view, 5> words{"diffuse", "texture_file", "reflective",
                                                  "roughness", "emitted"};
  Table table{"material", here(), {}};
  table.set("name", text("material" + std::to_string(scene_->materials.size())));
  bool good = true;
  while (good) {
    const Token word = tokens_.peek();
    if (std::find(words.begin(), words.end(), word.text) == words.end()) break;
    good = material_entry(table, word.text);
  }
  if (good) good = finish_material(table);
  if (scene_->materials.size() == max_materials) {
    faults_->add(here(), "more than 10000 materials", "use fewer");
    return false;
  }
  scene_->materials.push_back(std::move(table));  // also after a fault: the others keep their count
  return good;
}

bool ObjReader::finish_material(Table& table) {
  for (const std::string key : {"diffuse", "reflective", "emitted"}) {
    if (table.find(key)) continue;
    const std::string missing = key == "diffuse" ? "diffuse or texture_file" : key;
    const Token next = tokens_.peek();
    if (next.at_end() || begins_statement(next)) {
      faults_->add(here(), "the material lacks " + missing, "write " + std::string(current_->form));
      return false;
    }
    return refuse(next, in_quotes(next.text) + " where " + missing + " should stand");
  }
  return true;
}
}  // namespace portalens
