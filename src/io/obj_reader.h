/// \file
/// The statements of the OBJ dialect, one member function each.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/tokens.h"
#include "scene/scene.h"

namespace portalens {

/// Reads one file of the dialect. After a fault it goes on at the next word that begins a
/// statement, so that all the faults are found.
class ObjReader {
 public:
  ObjReader(std::string_view source, std::shared_ptr<const std::string> file, Scene& scene);

  void read();

 private:
  struct Statement {
    std::string_view name;
    std::string_view form;  ///< how it is written, for messages
    bool (ObjReader::*read)();
  };
  struct Corner {
    std::size_t vertex = 0;
    std::optional<std::array<double, 2>> uv;
  };
  struct MaterialUse {
    std::int64_t index = 0;
    Location where;
  };
  struct Mass {
    Value mass;
    std::optional<Value> center;
    Location where;
  };

  [[nodiscard]] static const std::array<Statement, 13>& statements();
  [[nodiscard]] static const Statement* find(std::string_view name);
  [[nodiscard]] static std::vector<std::string> names();

  // One for each statement; false after a fault, to go on at the next statement.
  bool vertex();
  bool texture_point();
  bool face();
  bool sphere();
  bool ring();
  bool portal();
  bool material();
  bool use_material();
  bool background();
  bool perspective_camera();
  bool orthographic_camera();
  bool mass();
  bool physics();

  bool camera(const std::string& type, std::string_view size_word, const std::string& size_key);
  bool camera_entries(std::string_view size_word, const std::string& size_key);
  bool camera_entry(std::string_view size_word, const std::string& size_key);
  bool camera_mark(std::string_view mark);
  bool material_entry(Table& table, std::string_view word);
  bool finish_material(Table& table);

  // Tokens. Each adds the fault itself.
  [[nodiscard]] bool begins_statement(const Token& token) const;
  bool refuse(const Token& token, const std::string& problem);
  bool numbers(std::span<double> values);
  std::optional<std::int64_t> whole(std::int64_t low);
  std::optional<Corner> corner();
  bool corners(std::vector<Corner>& found, std::size_t low, std::size_t high);

  // Values and objects.
  [[nodiscard]] Location here() const { return {file_, statement_.line}; }
  [[nodiscard]] Value number(double value) const;
  [[nodiscard]] Value text(std::string value) const;
  [[nodiscard]] Value list(std::span<const double> values) const;
  [[nodiscard]] Value polygon(const std::vector<Corner>& found) const;
  void add_object(Table table);

  void unknown(const Token& token);
  /// @param line  of the fault: the rest of it is passed over
  void skip_to_statement(int line);
  void finish();
  void finish_materials();
  void finish_portals();
  bool too_many_faults();

  TokenStream tokens_;
  std::shared_ptr<const std::string> file_;
  Scene* scene_;
  Faults* faults_;
  const Statement* current_ = nullptr;
  Token statement_;
  std::vector<std::array<double, 3>> vertices_;
  std::vector<std::optional<std::array<double, 2>>> uv_of_;  ///< one a vertex
  std::vector<std::array<double, 2>> uvs_;
  std::optional<MaterialUse> material_;
  std::vector<std::optional<MaterialUse>> material_of_;  ///< one an object
  std::optional<Mass> pending_mass_;
  std::map<std::int64_t, std::vector<std::size_t>> portals_;  ///< by pair: indices into objects
  bool emits_ = false;
  bool has_background_ = false;
  bool has_camera_ = false;
};

}  // namespace portalens
