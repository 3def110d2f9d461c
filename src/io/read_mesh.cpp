#include "io/read_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/words.h"
#include "io/files.h"
#include "io/lines.h"
#include "io/mesh_gaps.h"
#include "io/mesh_materials.h"
#include "io/mesh_warnings.h"
#include "io/tokens.h"
#include "math/triangulate.h"

namespace portalens {
namespace {

constexpr std::uint64_t max_bytes = std::uint64_t{1} << 30;
constexpr std::size_t max_corners = 1000;  // of one polygon
constexpr std::size_t max_faults = 100;
constexpr double max_far = 1e15;  // single precision squares it

/// Statements that say nothing about surfaces, and are passed over: of the format, and two that
/// others have added to it.
constexpr std::string_view harmless[] = {
    "o",        "g",          "s",         "l",      "p",      "lod", "bevel", "mg", "c_interp",
    "d_interp", "shadow_obj", "trace_obj", "usemap", "maplib", "vp",  "t",     "vw"};
/// Those of curves and curved surfaces, which are not taken: that is told.
constexpr std::string_view free_form[] = {
    "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim",  "hole", "scrv",
    "sp",     "end", "con",  "bsp",  "bzp",  "cdc",   "cdp",  "res",  "ctech", "stech"};

template <std::size_t count>
bool is_one_of(const std::string_view (&words)[count], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

class MeshReader {
 public:
  MeshReader(std::string_view text, const std::filesystem::path& path, FileMaterials wanted,
             Faults& faults, Digests* digests)
      : lines_(text),
        file_(std::make_shared<const std::string>(path.string())),
        wanted_(wanted),
        faults_(&faults),
        before_(faults.size()),
        materials_(path, faults, warnings_, digests) {}

  MeshFile read() {
    while (!is_other_ && faults_->size() - before_ < max_faults && lines_.next()) statement();
    check_indices_ahead();
    if (faults_->size() == before_ && mesh_.corners.empty()) {
      faults_->add({file_, 0}, "the mesh has no faces", "check that the file is whole");
    }
    if (faults_->size() > before_) return {};
    std::vector<Table> materials = std::move(materials_).take();
    fill_gaps(mesh_, materials, {file_, 0});
    return {std::move(mesh_), std::move(materials), std::move(warnings_).take({file_, 0})};
  }

 private:
  using Corner = Triangles::Corner;

  /// A corner may name what stands further down: that it does is checked at the end.
  struct Ahead {
    Corner corner;
    int line;
  };

  [[nodiscard]] Location here() const { return {file_, lines_.line()}; }

  void refuse(const std::string& problem, const std::string& remedy) {
    faults_->add(here(), problem, remedy);
  }

  void statement() {
    const std::string word = in_small_letters(lines_.words()[0]);
    if (word == "v") {
      // Also after a fault, so that the count of the others stays right.
      mesh_.positions.push_back(numbers(3, 8, "v x y z").value_or(Vec3d{}));
      if (lines_.words().size() > 6) tell_of_colors();
    } else if (word == "vn") {
      mesh_.normals.push_back(unit_normal(numbers(3, 3, "vn x y z").value_or(Vec3d{})));
    } else if (word == "vt") {
      const Vec3d point = numbers(1, 3, "vt u v").value_or(Vec3d{});
      mesh_.uvs.push_back({point.x, point.y});
    } else if (word == "f") {
      face();
    } else if (word == "usemtl") {
      if (wanted_ == FileMaterials::read) materials_.use(lines_.rest(), here());
    } else if (word == "mtllib") {
      if (wanted_ == FileMaterials::read) materials_.read(lines_.words(), lines_.rest(), here());
    } else if (is_one_of(free_form, word)) {
      pass_over_free_form();
    } else if (!is_one_of(harmless, word)) {
      if (knows_ == 0 && faults_->size() > before_) return refuse_as_other();
      return refuse(
          "unknown statement " + in_quotes(word),
          suggestion_or_list(word, {"v", "vt", "vn", "f", "o", "g", "s", "usemtl", "mtllib"}));
    }
    ++knows_;
  }

  /// Its first two statements are none of OBJ: so will the others be.
  void refuse_as_other() {
    is_other_ = true;
    faults_->replace(before_, {file_, 0},
                     "this is no OBJ mesh: it begins with statements that OBJ lacks",
                     "name a Wavefront .obj file");
  }

  /// The first three of `low` to `high` numbers, each of which must be one.
  std::optional<Vec3d> numbers(std::size_t low, std::size_t high, const std::string& form) {
    const auto& words = lines_.words();
    const std::size_t count = words.size() - 1;
    if (count < low || count > high) {
      refuse(in_quotes(words[0]) + " has " + std::to_string(count) + " numbers", "write " + form);
      return std::nullopt;
    }
    Vec3d result;
    for (std::size_t i = 0; i < count; ++i) {
      const auto value = parse_number(words[i + 1]);
      if (!value || std::fabs(*value) > max_far) {
        refuse(in_quotes(words[i + 1]) + " is not a number of at most 1e15", "write " + form);
        return std::nullopt;
      }
      if (i < 3) (i == 0 ? result.x : i == 1 ? result.y : result.z) = *value;
    }
    return result;
  }

  /// One index of `a/b/c`: from 1 up, or back from the last one. `left_out` if it is so.
  bool index(std::string_view word, std::size_t count, std::uint32_t& result) {
    result = left_out;
    if (word.empty()) return true;
    const auto given = parse_integer(word);
    const auto limit = static_cast<std::int64_t>(left_out);
    if (!given || *given == 0 || *given >= limit || *given < -static_cast<std::int64_t>(count)) {
      return false;
    }
    result = static_cast<std::uint32_t>(*given > 0 ? *given - 1
                                                   : static_cast<std::int64_t>(count) + *given);
    return true;
  }

  std::optional<Corner> corner(std::string_view word) {
    std::string_view parts[3];
    std::size_t count = 0, begin = 0;
    for (; count < 3 && begin <= word.size(); ++count) {
      const std::size_t end = std::min(word.find('/', begin), word.size());
      parts[count] = word.substr(begin, end - begin);
      begin = end + 1;
    }
    Corner result;
    if (begin <= word.size() || !index(parts[0], mesh_.positions.size(), result.position) ||
        !index(parts[1], mesh_.uvs.size(), result.uv) ||
        !index(parts[2], mesh_.normals.size(), result.normal) || result.position == left_out) {
      refuse(in_quotes(word) + " is not a corner of this mesh",
             std::to_string(mesh_.positions.size()) +
                 " vertices stand above; write v, v/vt, v//vn or v/vt/vn, counted from 1");
      return std::nullopt;
    }
    if (missing(result.position, mesh_.positions.size()) || missing(result.uv, mesh_.uvs.size()) ||
        missing(result.normal, mesh_.normals.size())) {
      ahead_.push_back({result, lines_.line()});
    }
    return result;
  }

  static bool missing(std::uint32_t index, std::size_t count) {
    return index != left_out && index >= count;
  }

  void face() {
    const auto& words = lines_.words();
    const std::size_t count = words.size() - 1;
    if (count < 3 || count > max_corners) {
      refuse("a face of " + std::to_string(count) + " corners", "give it 3 to 1000");
      return;
    }
    polygon_.clear();
    for (std::size_t i = 1; i <= count; ++i) {
      const auto next = corner(words[i]);
      if (!next) return;
      polygon_.push_back(*next);
    }
    add_polygon();
    if (mesh_.corners.size() > max_triangles) {
      refuse("more than 10 million triangles", "use a coarser mesh");
      while (lines_.next()) {
      }
    }
  }

  void add_polygon() {
    if (polygon_.size() == 3) {
      add_triangle({0, 1, 2});
      return;
    }
    points_.clear();
    for (const Corner& one : polygon_) {
      if (one.position >= mesh_.positions.size()) {
        refuse("a face of more than 3 corners stands above its vertices",
               "write the vertices first");
        return;
      }
      points_.push_back(mesh_.positions[one.position]);
    }
    for (const auto& triangle : triangulate(points_)) add_triangle(triangle);
  }

  void add_triangle(const std::array<std::size_t, 3>& from) {
    mesh_.corners.push_back({polygon_[from[0]], polygon_[from[1]], polygon_[from[2]]});
    mesh_.material_of.push_back(materials_.current());
  }

  void pass_over_free_form() {
    if (std::exchange(free_form_told_, true)) return;
    warnings_.add(
        here(),
        "curves and curved surfaces are passed over, from " + in_quotes(lines_.words()[0]) + " on",
        "export the mesh as polygons");
  }

  /// `v x y z r g b`, with or without a weight before the colour.
  void tell_of_colors() {
    if (wanted_ != FileMaterials::read || std::exchange(colors_told_, true)) return;
    warnings_.add(here(), "the colours of its vertices are passed over",
                  "bake them into a texture (map_Kd, with vt), or give the mesh a material");
  }

  void check_indices_ahead() {
    for (const Ahead& one : ahead_) {
      if (faults_->size() - before_ >= max_faults) return;
      if (missing(one.corner.position, mesh_.positions.size()) ||
          missing(one.corner.uv, mesh_.uvs.size()) ||
          missing(one.corner.normal, mesh_.normals.size())) {
        faults_->add({file_, one.line}, "a face names what the file does not have",
                     "it has " + std::to_string(mesh_.positions.size()) + " v, " +
                         std::to_string(mesh_.uvs.size()) + " vt and " +
                         std::to_string(mesh_.normals.size()) + " vn");
      }
    }
  }

  LineReader lines_;
  std::shared_ptr<const std::string> file_;
  FileMaterials wanted_;
  Faults* faults_;
  std::size_t before_;
  std::size_t knows_ = 0;  ///< statements that were understood
  bool is_other_ = false;  ///< the file is of another kind
  Triangles mesh_;
  MeshWarnings warnings_;
  MeshMaterials materials_;
  bool free_form_told_ = false, colors_told_ = false;
  std::vector<Ahead> ahead_;
  std::vector<Corner> polygon_;
  std::vector<Vec3d> points_;
};

}  // namespace

MeshFile read_mesh(const std::filesystem::path& file, const Location& asked_at,
                   FileMaterials wanted, Faults& faults, Digests* digests) {
  const auto text = read_file(file, max_bytes, asked_at, faults, digests);
  if (!text) return {};
  if (is_utf16(*text)) {
    faults.add({std::make_shared<const std::string>(file.string()), 0}, "the file is in UTF-16",
               "save it as UTF-8");
    return {};
  }
  try {
    const std::size_t before = faults.size();
    MeshFile mesh = MeshReader(*text, file, wanted, faults, digests).read();
    std::error_code error;
    const bool of_a_scene =
        asked_at.file && !std::filesystem::equivalent(*asked_at.file, file, error);
    if (faults.size() > before && of_a_scene)
      faults.add(asked_at, "the mesh " + in_quotes(file.filename().string()) + " has faults",
                 "mend them there");
    return mesh;
  } catch (const std::bad_alloc&) {
    faults.add(asked_at, "no memory for the mesh " + file.filename().string(),
               "use a coarser mesh");
    return {};
  }
}

}  // namespace portalens
