#include "world/stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <utility>

#include "geometry/extent.h"

namespace portalens {
namespace {

/// From a model to its camera: 30 degrees to the right of +z and 25 above it.
constexpr Vec3d three_quarter{0.453, 0.423, 0.785};

/// How much larger than the model the view is.
constexpr double spare = 1.08;

std::string text_of(const Table& table, std::string_view key, const std::string& fallback) {
  const Value* said = table.find(key);
  const auto* text = said ? std::get_if<std::string>(&said->data) : nullptr;
  return text ? *text : fallback;
}

const Mesh* mesh_of(const Objects& objects) {
  for (const Shape& shape : objects.shapes)
    if (const auto* mesh = std::get_if<Mesh>(&shape)) return mesh;
  return nullptr;
}

using Matrix = std::array<Vec3d, 3>;

/// Where the faces of a mesh turn to: means over its area.
struct Turns {
  Vec3d normal;  ///< 0 if it is closed
  Matrix both;   ///< of `n nᵀ`, the same for a face that is turned over
};

Matrix over(Matrix m, double divisor) {
  for (Vec3d& row : m) row = row / divisor;
  return m;
}

/// Triangles too small beside the mesh to have a normal are passed over.
Turns turns_of(const Mesh& mesh) {
  const double unit = mesh.bounds().diagonal();
  Turns sum;
  double area = 0.0;
  for (std::uint32_t face = 0; face < mesh.triangle_count(); ++face) {
    const auto t = mesh.triangle(face);
    const Vec3d across = cross((t[1] - t[0]) / unit, (t[2] - t[0]) / unit);
    const double share = length(across);
    if (!(share > 0.0)) continue;
    const Vec3d n = across / share;
    area += share;
    sum.normal += across;
    sum.both[0] += across * n.x, sum.both[1] += across * n.y, sum.both[2] += across * n.z;
  }
  return {sum.normal / area, over(sum.both, area)};
}

/// The axis that most of the area faces, to either side, and the share of it that does: 1 for a
/// plane, 1/3 for a sphere or a cube.
struct Facing {
  Vec3d axis;
  double share = 0.0;
};

/// The first axis of a matrix of trace 1, by squaring it again and again.
Facing facing_of(const Matrix& mean) {
  Matrix power = mean;
  for (int i = 0; i < 12; ++i) {
    const Matrix p = power;
    for (std::size_t row = 0; row < 3; ++row)
      power[row] = p[0] * p[row].x + p[1] * p[row].y + p[2] * p[row].z;
    power = over(power, power[0].x + power[1].y + power[2].z);
  }
  const Vec3d axis = normalize(*std::max_element(
      power.begin(), power.end(), [](Vec3d a, Vec3d b) { return length(a) < length(b); }));
  return {axis, dot(axis, {dot(mean[0], axis), dot(mean[1], axis), dot(mean[2], axis)})};
}

/// The side of a flat model that is worth seeing: the upper one if it lies; else the one to which
/// its faces turn, or if they turn to both, the one towards the usual camera.
Vec3d better_side(Vec3d axis, Vec3d mean_normal) {
  constexpr double lies = 0.5, turned = 0.1;
  if (std::fabs(axis.y) > lies) return axis.y > 0.0 ? axis : -axis;
  const double front = dot(mean_normal, axis);
  const double side = std::fabs(front) > turned ? front : dot(axis, three_quarter);
  return side < 0.0 ? -axis : axis;
}

/// From the model to the camera, unit. The flatter the model, the more it turns to its face.
Vec3d view_of(const Mesh& mesh) {
  constexpr double round = 0.5, flat = 0.85;  // shares of the area
  constexpr double most = 0.8;
  const Turns turns = turns_of(mesh);
  const Facing facing = facing_of(turns.both);
  if (!(facing.share > round)) return normalize(three_quarter);
  const Vec3d side = better_side(facing.axis, turns.normal);
  const double turn = most * std::min(1.0, (facing.share - round) / (flat - round));
  Vec3d view = three_quarter;
  if (dot(view, side) < 0.0) view = {-view.x, view.y, -view.z};
  return normalize(view + side * turn);
}

/// What the view spans: tangents of half its angles, in width and in height.
struct Span {
  double x = 0.0, y = 0.0;

  Span(const Table& camera, const Film& film) {
    const Value* said = camera.find("fov");
    const auto* whole = said ? std::get_if<std::int64_t>(&said->data) : nullptr;
    const auto* number = said ? std::get_if<double>(&said->data) : nullptr;
    double fov = whole ? static_cast<double>(*whole) : number ? *number : Camera().fov;
    if (!(fov > 0.0 && fov < 180.0)) fov = Camera().fov;  // a fault, told elsewhere
    const double aspect = static_cast<double>(film.width) / film.height;
    const double half = std::tan(fov * std::numbers::pi / 360.0);
    const std::string axis = text_of(camera, "fov_axis", "smaller");
    const bool along_x =
        axis == "x" || (axis == "smaller" && aspect < 1.0) || (axis == "larger" && aspect > 1.0);
    x = along_x ? half : half * aspect;
    y = along_x ? half / aspect : half;
  }
};

/// The camera's place, so that the model's outline just fits in the view.
struct Outlook {
  Vec3d position, look_at;
  double size = 0.0;  ///< of an orthographic view

  Outlook(const Mesh& mesh, Vec3d view, const Span& span) {
    const Vec3d right = normalize(cross(Vec3d{0, 1, 0}, view)), up = cross(view, right);
    const Vec3d middle = mesh.bounds().middle();
    const auto seen = [&](Vec3d x) {
      return Vec3d{dot(x - middle, right), dot(x - middle, up), dot(x - middle, view)};
    };
    Box box;  // as the camera sees it
    for_corners(mesh, [&](Vec3d x) { box.add(seen(x)); });
    const Vec3d center = box.middle();
    double distance = 0.0;
    for_corners(mesh, [&](Vec3d x) {
      const Vec3d off = seen(x) - center;
      const double aside = std::fmax(std::fabs(off.x) / span.x, std::fabs(off.y) / span.y);
      distance = std::fmax(distance, off.z + spare * aside);
      size = std::fmax(size, 2.0 * spare * aside * span.y);
    });
    look_at = middle + right * center.x + up * center.y + view * center.z;
    position = look_at + view * distance;
  }

  template <class Take>
  static void for_corners(const Mesh& mesh, const Take& take) {
    for (std::uint32_t face = 0; face < mesh.triangle_count(); ++face)
      for (const Vec3d& corner : mesh.triangle(face)) take(corner);
  }
};

}  // namespace

bool is_model_alone(const Scene& scene) {
  if (scene.objects.size() != 1 || scene.objects[0].kind != Mesh::name) return false;
  const std::string own = scene.file.filename().string();
  return !own.empty() && text_of(scene.objects[0], "file", "") == own;
}

Table staged_camera(const Table& camera, const Objects& objects, const Film& film) {
  Table table = camera;
  const Mesh* mesh = mesh_of(objects);
  if (!mesh || mesh->triangle_count() == 0) return table;
  const Outlook outlook(*mesh, view_of(*mesh), Span(camera, film));
  const auto add = [&](std::string_view key, Value::List list) {
    if (!camera.find(key)) table.set(key, {std::move(list), camera.where});
  };
  const auto listed = [&](Vec3d v) {
    return Value::List{{v.x, camera.where}, {v.y, camera.where}, {v.z, camera.where}};
  };
  const bool perspective = text_of(camera, "type", "perspective") != "orthographic";
  if (perspective && !camera.find("position") && !camera.find("fov_axis"))
    table.set("fov_axis", {std::string("smaller"), camera.where});
  if (!perspective && !camera.find("size")) table.set("size", {outlook.size, camera.where});
  add("position", listed(outlook.position));
  add("look_at", listed(outlook.look_at));
  return table;
}

std::vector<NamedLight> stage_lights(const Camera& camera, const Objects& objects) {
  constexpr double far = 60.0;  // half diagonals
  constexpr double key = 0.6, fill = 0.18;
  const Mesh* mesh = mesh_of(objects);
  if (!mesh || mesh->triangle_count() == 0) return {};
  const Box box = mesh->bounds();
  const Vec3d back = -camera.forward;
  const auto lamp = [&](std::string name, Vec3d direction, double brightness) {
    const double distance = far * 0.5 * box.diagonal();
    const double intensity = brightness * std::numbers::pi * distance * distance;
    return NamedLight{std::move(name), PointLight{box.middle() + normalize(direction) * distance,
                                                  {intensity, intensity, intensity}}};
  };
  return {lamp("key light", back - camera.right * 0.4 + camera.up * 0.8, key),
          lamp("fill light", back, fill)};
}

std::string stage_remark(const Camera& camera) {
  constexpr double degree = std::numbers::pi / 180.0;
  const Vec3d view = -camera.forward;
  return fmt::format(
      "a model without a scene: it is seen from {:.0f} degrees above, turned {:.0f} degrees from "
      "+z, with a key light above the camera to its left and a fill light behind it",
      std::asin(std::clamp(view.y, -1.0, 1.0)) / degree, std::atan2(view.x, view.z) / degree);
}

}  // namespace portalens
