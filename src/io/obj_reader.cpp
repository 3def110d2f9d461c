#include "io/obj_reader.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/words.h"
#include "io/vocabulary.h"

namespace portalens {
namespace {

constexpr std::size_t max_faults = 1000;

bool looks_like_index(const Token& token) {
  return !token.at_end() && (token.text[0] == '-' || token.text[0] == '+' ||
                             (token.text[0] >= '0' && token.text[0] <= '9'));
}

/// Words inside of longer statements.
bool goes_on(std::string_view word) {
  constexpr std::array<std::string_view, 11> words{
      "diffuse", "texture_file",    "reflective",        "roughness", "emitted", "angle",
      "size",    "camera_position", "point_of_interest", "up",        "}"};
  return std::find(words.begin(), words.end(), word) != words.end();
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

ObjReader::ObjReader(std::string_view source, std::shared_ptr<const std::string> file, Scene& scene)
    : tokens_(source), file_(std::move(file)), scene_(&scene), faults_(&scene.faults) {}

void ObjReader::read() {
  for (Token token = tokens_.next(); !token.at_end(); token = tokens_.next()) {
    if (too_many_faults()) return;
    const Statement* statement = find(token.text);
    if (!statement) {
      unknown(token);
      skip_to_statement(token.line);
      continue;
    }
    current_ = statement;
    statement_ = token;
    if (!(this->*statement->read)()) skip_to_statement(tokens_.peek().line);
    if (scene_->objects.size() > max_objects) {
      faults_->add(here(), "more than " + std::to_string(max_objects) + " objects",
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

void ObjReader::skip_to_statement(int line) {
  Token token = tokens_.peek();
  while (!token.at_end() && !find(token.text)) {
    // A word that begins a line was meant as a statement, unless it goes on with a longer one.
    if (token.line > line && !looks_like_index(token) && !goes_on(token.text)) return;
    line = token.line;
    tokens_.next();
    token = tokens_.peek();
  }
}

bool ObjReader::too_many_faults() {
  if (faults_->size() < max_faults) return false;
  faults_->add(here(), "more than " + std::to_string(max_faults) + " faults",
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

bool ObjReader::numbers(std::span<double> values) {
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

Value ObjReader::list(std::span<const double> values) const {
  Value::List elements;
  for (const double value : values) elements.push_back(number(value));
  return {std::move(elements), here()};
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
  std::set<std::size_t> unpaired;
  for (const auto& [pair, members] : portals_) {
    if (members.size() != 2) {
      const std::string count = std::to_string(members.size());
      faults_->add(scene_->objects[members.back()].where,
                   "pair " + std::to_string(pair) + " has " + count +
                       (members.size() == 1 ? " portal" : " portals"),
                   "two portals with the same number are a pair");
      unpaired.insert(members.begin(), members.end());
      continue;
    }
    const std::string stem = "portal" + std::to_string(pair);
    for (const std::size_t i : {0, 1}) {
      Table& portal = scene_->objects[members[i]];
      portal.set("name", {stem + (i == 0 ? "a" : "b"), portal.where});
      portal.set("pair", {stem + (i == 0 ? "b" : "a"), portal.where});
    }
  }
  std::vector<Table> kept;
  for (std::size_t i = 0; i < scene_->objects.size(); ++i) {
    if (unpaired.count(i) == 0) kept.push_back(std::move(scene_->objects[i]));
  }
  scene_->objects = std::move(kept);
}
}  // namespace portalens
