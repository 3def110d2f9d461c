#include "portalens/scene.h"

#include <map>
#include <memory>
#include <type_traits>

#include "api/access.h"
#include "core/words.h"
#include "io/override.h"
#include "io/read_scene.h"
#include "io/vocabulary.h"

namespace portalens::api {
namespace {

/// The value as readers give it; all of it stands at one place.
portalens::Value inward(const Value& value, const Location& where) {
  portalens::Value result{false, where};
  std::visit(
      [&](const auto& data) {
        using Data = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Data, Value::List>) {
          portalens::Value::List list;
          for (const Value& one : data) list.push_back(inward(one, where));
          result.data = std::move(list);
        } else if constexpr (std::is_same_v<Data, Value::Table>) {
          portalens::Value::Dictionary table;
          for (const Entry& entry : data) table.push_back({entry.key, inward(entry.value, where)});
          result.data = std::move(table);
        } else {
          result.data = data;
        }
      },
      value.data());
  return result;
}

Location location_of(const Place& place) {
  return {std::make_shared<const std::string>(place.file), place.line};
}

/// The list that takes tables of that kind.
std::vector<Table>& list_of(portalens::Scene& scene, std::string_view kind) {
  if (kind == "material") return scene.materials;
  return kind == "light" ? scene.lights : scene.objects;
}

}  // namespace

Value::Value(std::string text) : data_(std::move(text)) {}
Value::Value(std::string_view text) : data_(std::string(text)) {}
Value::Value(const char* text) : data_(std::string(text)) {}
Value::Value(std::initializer_list<Value> list) : data_(List(list)) {}
Value::Value(List list) : data_(std::move(list)) {}
Value::Value(Vec3 v) : data_(List{v.x, v.y, v.z}) {}
Value::Value(const std::vector<Vec3>& list) : data_(List(list.begin(), list.end())) {}
Value::Value(Table table) : data_(std::move(table)) {}

Scene::Scene() : inside_(std::make_unique<Inside>(Inside{empty_scene("")})) {}
Scene::Scene(const Scene& other) : inside_(std::make_unique<Inside>(*other.inside_)) {}
Scene::Scene(Scene&& other) noexcept = default;
Scene& Scene::operator=(const Scene& other) {
  if (this != &other) inside_ = std::make_unique<Inside>(*other.inside_);
  return *this;
}
Scene& Scene::operator=(Scene&& other) noexcept = default;
Scene::~Scene() = default;

Scene Scene::from_file(const std::filesystem::path& file) {
  return guarded([&] { return Access::made(read_scene(file)); });
}

Scene Scene::from_text(std::string_view text, const std::filesystem::path& file) {
  return guarded([&] { return Access::made(read_scene_text(text, file)); });
}

Scene& Scene::set(std::string_view section, const Entries& entries, Place place) {
  portalens::Scene& scene = inside_->scene;
  const Location where = location_of(place);
  Table* table = find_section(scene, section);
  if (!table) {
    scene.faults.add(where, "unknown section " + in_quotes(section),
                     suggestion_or_list(section, sections_known()));
    return *this;
  }
  table->where = where;
  for (const Entry& entry : entries) table->set(entry.key, inward(entry.value, where));
  if (section == "camera") scene.has_camera = true;
  return *this;
}

Scene& Scene::add(std::string_view kind, const Entries& entries, Place place) {
  portalens::Scene& scene = inside_->scene;
  const Location where = location_of(place);
  std::vector<Table>& list = list_of(scene, kind);
  if (list.size() == max_objects)
    scene.faults.add(where, "more than " + std::to_string(max_objects) + " objects",
                     "put them in a mesh");
  if (list.size() >= max_objects) return *this;
  Table table{std::string(kind), where, {}};
  for (const Entry& entry : entries)
    table.entries.push_back({entry.key, inward(entry.value, where)});
  list.push_back(std::move(table));
  return *this;
}

Scene& Scene::assign(std::string_view assignment) {
  override_value(inside_->scene, std::string(assignment), inside_->scene.faults);
  return *this;
}

}  // namespace portalens::api
