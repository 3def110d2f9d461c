#include "io/obj_reader.h"

#include <algorithm>
#include <utility>

#include "core/words.h"
#include "io/srgb.h"
#include "io/vocabulary.h"

namespace portalens {
namespace {

constexpr std::size_t most_faults = 1000;

bool looks_like_index(const Token& token) {
  return !token.at_end() && (token.text[0] == '-' || token.text[0] == '+' ||
                             (token.text[0] >= '0' && token.text[0] <= '9'));
}

bool ordinary_only(std::string_view word) {
  constexpr std::array<std::string_view, 8> words{"mtllib", "usemtl", "o", "g",
                                                  "vn",     "vp",     "l", "usemap"};
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

const std::array<ObjReader::Statement, 13>& ObjReader::statements() {
  static const std::array<Statement, 13> list{{
      {"v", "v x y z", &ObjReader::vertex},
      {"vt", "vt s t", &ObjReader::texture_point},
      {"f", "f a b c d", &ObjReader::face},
      {"s", "s x y z radius", &ObjReader::sphere},
      {"r", "r x y z height inner_radius outer_radius", &ObjReader::ring},
      {"p", "p a b c d pair", &ObjReader::portal},
      {"material",
       "material diffuse r g b (or texture_file FILE) reflective r g b [roughness x] "
       "emitted r g b",
       &ObjReader::material},
      {"m", "m index", &ObjReader::use_material},
      {"background_color", "background_color r g b", &ObjReader::background},
      {"PerspectiveCamera",
       "PerspectiveCamera { camera_position < x, y, z > point_of_interest < x, y, z > "
       "up < x, y, z > angle degrees }",
       &ObjReader::perspective_camera},
      {"OrthographicCamera",
       "OrthographicCamera { camera_position < x, y, z > point_of_interest < x, y, z > "
       "up < x, y, z > size s }",
       &ObjReader::orthographic_camera},
      {"mass", "mass M or mass M x y z", &ObjReader::mass},
      {"physics", "physics KEY VALUE", &ObjReader::physics},
  }};
  return list;
}

const ObjReader::Statement* ObjReader::find(std::string_view name) {
  for (const Statement& statement : statements()) {
    if (statement.name == name) return &statement;
  }
  return nullptr;
}

std::vector<std::string> ObjReader::names() {
  std::vector<std::string> result;
  for (const Statement& statement : statements()) result.emplace_back(statement.name);
  return result;
}

ObjReader::ObjReader(std::string_view source, std::shared_ptr<const std::string> file, Scene& scene,
                     Faults& faults)
    : tokens_(source), file_(std::move(file)), scene_(&scene), faults_(&faults) {}

void ObjReader::read() {
  for (Token token = tokens_.next(); !token.at_end(); token = tokens_.next()) {
    if (too_many_faults()) return;
    const Statement* statement = find(token.text);
    if (!statement) {
      unknown(token);
      skip_to_statement();
      continue;
    }
    current_ = statement;
    statement_ = token;
    if (!(this->*statement->read)()) skip_to_statement();
    if (scene_->objects.size() > most_objects) {
      faults_->add(here(), "more than " + std::to_string(most_objects) + " objects",
                   "put them in a mesh");
      return;
    }
  }
  finish();
}

void ObjReader::unknown(const Token& token) {
  const Location where{file_, token.line};
  if (current_ && looks_like_index(token)) {
    faults_->add(where, "too many values after " + in_quotes(current_->name),
                 "write " + std::string(current_->form));
  } else if (ordinary_only(token.text)) {
    faults_->add(where, in_quotes(token.text) + " is ordinary OBJ, and this file is a scene",
                 "leave it out, or put the mesh into a file of its own");
  } else {
    faults_->add(where, "unknown statement " + in_quotes(token.text),
                 suggestion_or_list(token.text, names()));
  }
}

void ObjReader::skip_to_statement() {
  while (!tokens_.peek().at_end() && !find(tokens_.peek().text)) tokens_.next();
}

bool ObjReader::too_many_faults() {
  if (faults_->size() < most_faults) return false;
  faults_->add(here(), "more than " + std::to_string(most_faults) + " faults",
               "mend these first; what follows has not been read");
  return true;
}

bool ObjReader::begins_statement(const Token& token) const { return find(token.text) != nullptr; }

bool ObjReader::refuse(const Token& token, const std::string& problem) {
  const std::string name = in_quotes(current_->name);
  const std::string remedy = "write " + std::string(current_->form);
  if (token.at_end()) {
    faults_->add(here(), "the file ends in the middle of " + name, remedy);
  } else if (begins_statement(token)) {
    faults_->add(here(), "too few values after " + name, remedy);
  } else {
    faults_->add({file_, token.line}, problem, remedy);
  }
  return false;
}

template <std::size_t count>
bool ObjReader::numbers(std::array<double, count>& values) {
  for (double& value : values) {
    const Token token = tokens_.peek();
    const auto parsed = parse_number(token.text);
    if (!parsed) return refuse(token, in_quotes(token.text) + " is not a finite number");
    value = *parsed;
    tokens_.next();
  }
  return true;
}

std::optional<std::int64_t> ObjReader::whole(std::int64_t low) {
  const Token token = tokens_.peek();
  const auto parsed = parse_integer(token.text);
  if (!parsed || *parsed < low) {
    refuse(token,
           in_quotes(token.text) + " is not a whole number of at least " + std::to_string(low));
    return std::nullopt;
  }
  tokens_.next();
  return parsed;
}

Value ObjReader::number(double value) const { return {value, here()}; }
Value ObjReader::text(std::string value) const { return {std::move(value), here()}; }

template <std::size_t count>
Value ObjReader::list(const std::array<double, count>& values) const {
  Value::List elements;
  for (const double value : values) elements.push_back(number(value));
  return {std::move(elements), here()};
}

bool ObjReader::vertex() {
  std::array<double, 3> point{};
  const bool good = numbers(point);
  vertices_.push_back(point);  // also after a fault, so that the count of the others stays right
  uv_of_.emplace_back();
  return good;
}

bool ObjReader::texture_point() {
  std::array<double, 2> point{};
  const bool good = numbers(point);
  uvs_.push_back(point);
  if (!vertices_.empty()) {
    uv_of_.back() = point;
  } else if (good) {
    faults_->add(here(), "'vt' comes before any 'v'", "it belongs to the last 'v' above it");
  }
  return good;
}

std::optional<ObjReader::Corner> ObjReader::corner() {
  const Token token = tokens_.peek();
  std::array<std::string_view, 3> parts;
  std::size_t count = 0, begin = 0;
  while (count < 3 && begin <= token.text.size()) {
    const std::size_t end = std::min(token.text.find('/', begin), token.text.size());
    parts[count++] = token.text.substr(begin, end - begin);
    begin = end + 1;
  }
  const auto index = parse_integer(parts[0]);
  const auto uv = parse_integer(parts[1]);
  const auto normal = parse_integer(parts[2]);
  const bool whole_token = begin > token.text.size();
  const bool form = whole_token && index && (uv || parts[1].empty()) &&
                    (normal || parts[2].empty()) && (count < 2 || uv || normal);
  if (!form) {
    refuse(token, in_quotes(token.text) + " is not a vertex");
    return std::nullopt;
  }
  const auto last = static_cast<std::int64_t>(vertices_.size());
  if (*index < 1 || *index > last) {
    refuse(token, "there is no vertex " + std::string(parts[0]) + ": " + std::to_string(last) +
                      " stand above, counted from 1");
    return std::nullopt;
  }
  if ((uv && (*uv < 1 || *uv > static_cast<std::int64_t>(uvs_.size()))) ||
      (normal && *normal < 1)) {
    refuse(token, "there is no such texture coordinate or normal as in " + in_quotes(token.text));
    return std::nullopt;
  }
  tokens_.next();
  Corner result;
  result.vertex = static_cast<std::size_t>(*index) - 1;
  result.uv = uv ? std::optional(uvs_[static_cast<std::size_t>(*uv) - 1]) : uv_of_[result.vertex];
  return result;
}

bool ObjReader::corners(std::vector<Corner>& found, std::size_t low, std::size_t high) {
  while (found.size() < high && (found.size() < low || looks_like_index(tokens_.peek()))) {
    const auto next = corner();
    if (!next) return false;
    found.push_back(*next);
  }
  return true;
}

Value ObjReader::polygon(const std::vector<Corner>& found) const {
  Value::List points;
  for (const Corner& one : found) points.push_back(list(vertices_[one.vertex]));
  return {std::move(points), here()};
}

void ObjReader::add_object(Table table) {
  if (pending_mass_) {
    table.set("mass", std::move(pending_mass_->mass));
    if (pending_mass_->center) table.set("center_of_mass", std::move(*pending_mass_->center));
    pending_mass_.reset();
  }
  scene_->objects.push_back(std::move(table));
  material_of_.push_back(material_);
}

bool ObjReader::face() {
  std::vector<Corner> found;
  if (!corners(found, 3, 4)) return false;
  Table table{"quad", here(), {}};
  table.set("vertices", polygon(found));
  if (std::all_of(found.begin(), found.end(), [](const Corner& c) { return c.uv.has_value(); })) {
    Value::List points;
    for (const Corner& one : found) points.push_back(list(*one.uv));
    table.set("texture_coordinates", {std::move(points), here()});
  }
  add_object(std::move(table));
  return true;
}

bool ObjReader::sphere() {
  std::array<double, 4> values{};
  if (!numbers(values)) return false;
  Table table{"sphere", here(), {}};
  table.set("center", list(std::array<double, 3>{values[0], values[1], values[2]}));
  table.set("radius", number(values[3]));
  add_object(std::move(table));
  return true;
}

bool ObjReader::ring() {
  std::array<double, 6> values{};
  if (!numbers(values)) return false;
  const double height = values[3];
  Table table{"ring", here(), {}};
  table.set("base", list(std::array<double, 3>{values[0], values[1] - 0.5 * height, values[2]}));
  table.set("height", number(height));
  table.set("inner_radius", number(values[4]));
  table.set("outer_radius", number(values[5]));
  add_object(std::move(table));
  return true;
}

bool ObjReader::portal() {
  std::vector<Corner> found;
  if (!corners(found, 4, 4)) return false;
  const auto pair = whole(0);
  if (!pair) return false;
  Table table{"portal", here(), {}};
  table.set("vertices", polygon(found));
  portals_[*pair].push_back(scene_->objects.size());
  add_object(std::move(table));
  return true;
}

bool ObjReader::use_material() {
  const auto index = whole(0);
  if (!index) return false;
  material_ = MaterialUse{*index, here()};
  return true;
}

bool ObjReader::background() {
  std::array<double, 3> color{};
  if (!numbers(color)) return false;
  if (has_background_) {
    faults_->add(here(), "a second background_color", "give it once");
  }
  has_background_ = true;
  for (double& channel : color) {
    if (channel < 0.0 || channel > 1.0) {
      faults_->add(here(), "background_color is sRGB, and outside 0 to 1",
                   "give three numbers from 0 to 1");
      return true;
    }
    channel = linear_from_srgb(channel);
  }
  scene_->environment.where = here();
  scene_->environment.set("color", list(color));
  return true;
}

bool ObjReader::mass() {
  std::array<double, 1> value{};
  if (!numbers(value)) return false;
  Mass mass{number(value[0]), std::nullopt, here()};
  if (parse_number(tokens_.peek().text)) {
    std::array<double, 3> center{};
    if (!numbers(center)) return false;
    mass.center = list(center);
  }
  if (pending_mass_) {
    faults_->add(pending_mass_->where, "a mass that no primitive follows",
                 "write 'mass' just before the f, s, r or p that has it");
  }
  pending_mass_ = std::move(mass);
  return true;
}

bool ObjReader::physics() {
  const Token key = tokens_.peek();
  if (key.at_end()) return refuse(key, "");
  tokens_.next();
  const Token word = tokens_.peek();
  if (word.at_end() || begins_statement(word) || word.line != statement_.line) {
    faults_->add(here(), "too few values after 'physics'", "write physics KEY VALUE");
    return false;
  }
  tokens_.next();
  Value value = text(std::string(word.text));
  if (const auto integer = parse_integer(word.text)) {
    value.data = *integer;
  } else if (const auto real = parse_number(word.text)) {
    value.data = *real;
  } else if (word.text == "true" || word.text == "false") {
    value.data = word.text == "true";
  }
  if (scene_->physics.find(key.text)) {
    faults_->add(here(), "physics " + in_quotes(key.text) + " is given twice", "give it once");
  }
  scene_->physics.set(key.text, std::move(value));
  return true;
}

void ObjReader::finish() {
  if (pending_mass_) {
    faults_->add(pending_mass_->where, "a mass that no primitive follows",
                 "write 'mass' just before the f, s, r or p that has it");
  }
  if (!has_background_) {
    const Location whole_file{file_, 0};
    const Value one{1.0, whole_file};
    scene_->environment.set("color", {Value::List{one, one, one}, whole_file});
  }
  finish_materials();
  finish_portals();
  if (emits_) {
    scene_->notes.emplace_back(
        "emitted is a radiance here; the teaching ray tracer has units of its own (emitted x area "
        "/ (pi d^2), no cosine at the light, a light seen directly is white), so brightness "
        "differs");
  }
}

void ObjReader::finish_materials() {
  const auto count = static_cast<std::int64_t>(scene_->materials.size());
  int refused = 0;  // the line of the `m` told last
  for (std::size_t i = 0; i < scene_->objects.size(); ++i) {
    Table& object = scene_->objects[i];
    if (object.kind == "portal") continue;
    const auto& use = material_of_[i];
    if (use && use->index >= count) {
      if (use->where.line != refused) {
        faults_->add(use->where, "there is no material " + std::to_string(use->index),
                     "the file has " + std::to_string(count) + ", counted from 0");
      }
      refused = use->where.line;
    } else if (count > 0) {
      object.set("material", {"material" + std::to_string(use ? use->index : 0),
                              use ? use->where : object.where});
    }
  }
}

void ObjReader::finish_portals() {
  for (const auto& [pair, members] : portals_) {
    if (members.size() != 2) {
      const std::string count = std::to_string(members.size());
      faults_->add(scene_->objects[members.back()].where,
                   "pair " + std::to_string(pair) + " has " + count +
                       (members.size() == 1 ? " portal" : " portals"),
                   "two portals with the same number are a pair");
      continue;
    }
    const std::string stem = "portal" + std::to_string(pair);
    for (const std::size_t i : {0, 1}) {
      Table& portal = scene_->objects[members[i]];
      portal.set("name", {stem + (i == 0 ? "a" : "b"), portal.where});
      portal.set("pair", {stem + (i == 0 ? "b" : "a"), portal.where});
    }
  }
}

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
  if (scene_->has_camera) {
    faults_->add(here(), "a second camera", "give one");
    return false;
  }
  scene_->has_camera = true;
  scene_->camera.where = here();
  if (!camera_mark("{")) return false;
  while (tokens_.peek_part().text != "}") {
    if (!camera_entry(size_word, size_key)) return false;
  }
  tokens_.next_part();
  for (const std::string& key :
       {std::string("position"), std::string("look_at"), std::string("up"), size_key}) {
    if (!scene_->camera.find(key)) {
      faults_->add(here(), "the camera lacks its " + key, "write " + std::string(current_->form));
    }
  }
  scene_->camera.set("type", text(type));
  if (type == "perspective") scene_->camera.set("fov_axis", text("smaller"));
  return true;
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
