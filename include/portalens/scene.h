/// \file
/// A scene: what there is, not yet interpreted. It is read from a file or from text, or built in
/// code of the same tables and keys, which docs/scene-format.md lists.
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "portalens/types.h"

namespace portalens::api {

struct Entry;

/// A letter is none.
template <class Number>
concept IsNumber = (std::integral<Number> ||
                    std::floating_point<Number>)&&!std::same_as<Number, char>;

/// What a key of a table is set to. Braces make a list: `{0, 1.4, 0}`, `{{-1, 0, 2}, {1, 0, 2}}`.
class Value {
 public:
  using List = std::vector<Value>;
  using Table = std::vector<Entry>;
  using Data = std::variant<bool, std::int64_t, double, std::string, List, Table>;

  Value(std::string text);
  Value(std::string_view text);
  Value(const char* text);
  Value(std::initializer_list<Value> list);
  Value(List list);
  Value(Vec3 v);                         ///< a list of three
  Value(const std::vector<Vec3>& list);  ///< a list of lists of three
  /// A table in a table, as in `diffuse = { checker = [...], size = 1 }`.
  Value(Table table);
  /// A number, or true or false. A whole number stays one; one too large for `std::int64_t` becomes
  /// a `double`.
  template <class Number>
  requires IsNumber<Number> Value(Number number);

  [[nodiscard]] const Data& data() const { return data_; }

 private:
  Data data_;
};

/// A key and its value.
struct Entry {
  std::string key;
  Value value;
};

/// The keys of one table.
using Entries = std::vector<Entry>;

/// A place in a source file of the caller's, by which faults of a scene that is built in code name
/// the call that set what is wrong. Nobody needs to give it.
struct Place {
  const char* file = "";
  int line = 0;
  [[nodiscard]] static Place here(const char* file = __builtin_FILE(),
                                  int line = __builtin_LINE()) {
    return {file, line};
  }
};

/// A value: copies are independent. One that was moved from can only be assigned to, or destroyed.
class Scene {
 public:
  /// Nothing: a camera of its own choice looks at what is added. Pictures and meshes are sought
  /// relative to the current folder.
  Scene();
  /// A scene file, `.toml` or `.obj`.
  /// @throws Error (asked) if it can't be read, or has a syntax error, which stands alone; all
  /// other faults wait for `compile` or `check`
  [[nodiscard]] static Scene from_file(const std::filesystem::path& file);
  /// The text of a TOML scene.
  /// @param file  how faults call it; pictures and meshes are sought relative to its folder. It
  /// need
  ///              not exist
  /// @throws Error (asked), as `from_file`
  [[nodiscard]] static Scene from_text(std::string_view text,
                                       const std::filesystem::path& file = "scene.toml");
  Scene(const Scene& other);
  Scene(Scene&& other) noexcept;
  Scene& operator=(const Scene& other);
  Scene& operator=(Scene&& other) noexcept;
  ~Scene();

  /// Sets keys of a section: camera, film, sampler, physics, shading, environment. Keys that are
  /// not named keep what they had. What is wrong with it, `compile` and `check` tell.
  Scene& set(std::string_view section, const Entries& entries, Place place = Place::here());
  /// Adds one of a list: material, light, sphere, quad, cube, cone, cylinder, ring, mesh, mass,
  /// portal. What is wrong with it, `compile` and `check` tell.
  Scene& add(std::string_view kind, const Entries& entries, Place place = Place::here());
  /// Sets one key, written as on the command line: `"physics.tolerance=1e-5"`. What is wrong with
  /// it, `compile` and `check` tell.
  Scene& assign(std::string_view assignment);

 private:
  friend struct Access;
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

template <class Number>
requires IsNumber<Number> Value::Value(Number number) {
  if constexpr (std::same_as<Number, bool>)
    data_ = number;
  else if constexpr (std::floating_point<Number>)
    data_ = static_cast<double>(number);
  else if (std::in_range<std::int64_t>(number))
    data_ = static_cast<std::int64_t>(number);
  else
    data_ = static_cast<double>(number);
}

}  // namespace portalens::api
