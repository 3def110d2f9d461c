#include "io/mtl.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/words.h"
#include "io/lines.h"
#include "io/mtl_options.h"
#include "io/tokens.h"

namespace portalens {
namespace {

constexpr std::size_t max_faults = 100;
constexpr std::int64_t first_mirroring = 3;  // illum 3: "reflection on and ray trace on"

class MtlReader {
 public:
  MtlReader(std::string_view text, std::shared_ptr<const std::string> file, Faults& faults,
            MeshWarnings& warnings)
      : lines_(text), file_(std::move(file)), faults_(&faults), warnings_(&warnings) {}

  std::vector<Table> read() {
    const std::size_t before = faults_->size();
    while (lines_.next() && faults_->size() - before < max_faults) statement();
    finish_material();
    return std::move(materials_);
  }

 private:
  [[nodiscard]] Location here() const { return {file_, lines_.line()}; }

  void statement() {
    const std::string word = in_small_letters(lines_.words()[0]);
    if (word == "newmtl") {
      begin_material();
    } else if (known(word) && materials_.empty()) {
      faults_->add(here(), in_quotes(lines_.words()[0]) + " before any newmtl",
                   "begin with newmtl NAME");
    } else if (word == "kd") {
      color("diffuse");
    } else if (word == "ke") {
      color("emitted");
    } else if (word == "ks") {
      specular_ = color_value();
    } else if (word == "pr") {
      roughness();
    } else if (word == "illum") {
      illumination();
    } else if (word == "map_kd") {
      picture();
    }
  }

  static bool known(std::string_view word) {
    constexpr std::array<std::string_view, 6> words{"kd", "ke", "ks", "pr", "illum", "map_kd"};
    return std::find(words.begin(), words.end(), word) != words.end();
  }

  void begin_material() {
    finish_material();
    std::string name = lines_.rest();
    if (materials_.size() == max_materials) {
      faults_->add(here(), "more than 10000 materials", "use fewer");
      return;
    }
    Table table{"material", here(), {}};
    table.set("name", {std::move(name), here()});
    materials_.push_back(std::move(table));
  }

  void finish_material() {
    if (materials_.empty()) return;
    if (specular_ && illumination_ >= first_mirroring) {
      materials_.back().set("reflective", std::move(*specular_));
    }
    if (picture_) materials_.back().set("diffuse", std::move(*picture_));
    specular_.reset();
    picture_.reset();
    illumination_ = 0;
  }

  std::optional<Value> color_value() {
    const auto& words = lines_.words();
    Value::List list;
    if (words.size() == 2 || words.size() == 4) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto value = parse_number(words[words.size() == 2 ? 1 : i + 1]);
        if (value) list.push_back({*value, here()});
      }
    }
    if (list.size() == 3) return Value{std::move(list), here()};
    faults_->add(here(), in_quotes(words[0]) + " is not followed by a colour",
                 "write " + std::string(words[0]) + " r g b");
    return std::nullopt;
  }

  void color(const std::string& key) {
    if (auto value = color_value()) materials_.back().set(key, std::move(*value));
  }

  void roughness() {
    const auto& words = lines_.words();
    const auto value = words.size() == 2 ? parse_number(words[1]) : std::nullopt;
    if (value) {
      materials_.back().set("roughness", {*value, here()});
    } else {
      faults_->add(here(), "'Pr' is not followed by a number", "write Pr roughness");
    }
  }

  void illumination() {
    const auto& words = lines_.words();
    const auto value = words.size() == 2 ? parse_integer(words[1]) : std::nullopt;
    if (value) {
      illumination_ = *value;
    } else {
      faults_->add(here(), "'illum' is not followed by a whole number", "write illum 0 to 10");
    }
  }

  void picture() {
    const auto& words = lines_.words();
    const MapOptions options = map_options(words);
    for (const std::string& option : options.not_done)
      warnings_->add(here(), in_quotes(option) + " of map_Kd is passed over",
                     "the picture is laid on and shown as it is; bake the option into it");
    std::string name = lines_.rest(options.name);
    if (name.empty()) faults_->add(here(), "map_Kd without a file", "write map_Kd FILE");
    std::replace(name.begin(), name.end(), '\\', '/');
    picture_ = Value{std::move(name), here()};
  }

  LineReader lines_;
  std::shared_ptr<const std::string> file_;
  Faults* faults_;
  MeshWarnings* warnings_;
  std::vector<Table> materials_;
  std::optional<Value> specular_, picture_;
  std::int64_t illumination_ = 0;
};

}  // namespace

std::vector<Table> read_mtl(std::string_view text, const std::shared_ptr<const std::string>& name,
                            Faults& faults, MeshWarnings& warnings) {
  if (is_utf16(text)) {
    faults.add({name, 0}, "the file is in UTF-16", "save it as UTF-8");
    return {};
  }
  return MtlReader(text, name, faults, warnings).read();
}

}  // namespace portalens
