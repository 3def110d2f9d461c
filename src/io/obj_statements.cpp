// The statements of the OBJ dialect that are one word and its values.
#include <algorithm>
#include <utility>

#include "io/obj_reader.h"
#include "math/srgb.h"

namespace portalens {

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
  if (word.at_end() || begins_statement(word)) {
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
}  // namespace portalens
