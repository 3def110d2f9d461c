#include "io/mesh_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace portalens {
namespace {

using Corner = Triangles::Corner;

Vec3d flat_normal(const Triangles& mesh, const std::array<Corner, 3>& triangle) {
  const Vec3d a = mesh.positions[triangle[0].position];
  const Vec3d n = unit_normal(
      cross(mesh.positions[triangle[1].position] - a, mesh.positions[triangle[2].position] - a));
  return n == Vec3d{} ? Vec3d{0, 1, 0} : n;  // no area: nothing ever meets it
}

/// Faces without normals, among others that have them, are flat.
void fill_normals(Triangles& mesh) {
  bool any = false;
  for (auto& triangle : mesh.corners) {
    for (Corner& one : triangle) {
      if (one.normal != left_out && mesh.normals[one.normal] == Vec3d{}) one.normal = left_out;
      any |= one.normal != left_out;
    }
  }
  if (!any) mesh.normals.clear();
  for (auto& triangle : mesh.corners) {
    std::optional<std::uint32_t> flat;
    for (Corner& one : triangle) {
      if (one.normal != left_out) continue;
      if (any && !flat) {
        flat = static_cast<std::uint32_t>(mesh.normals.size());
        mesh.normals.push_back(flat_normal(mesh, triangle));
      }
      one.normal = flat.value_or(0);
    }
  }
}

void fill_uvs(Triangles& mesh) {
  bool any = false, gap = false;
  for (const auto& triangle : mesh.corners) {
    for (const Corner& one : triangle) (one.uv != left_out ? any : gap) = true;
  }
  const auto origin = static_cast<std::uint32_t>(any ? mesh.uvs.size() : 0);
  if (!any) mesh.uvs.clear();
  if (any && gap) mesh.uvs.push_back({0.0, 0.0});
  for (auto& triangle : mesh.corners) {
    for (Corner& one : triangle) {
      if (one.uv == left_out) one.uv = origin;
    }
  }
}

/// Faces before the first usemtl, among others that have a material, get a plain one.
void fill_materials(Triangles& mesh, std::vector<Table>& materials, const Location& where) {
  if (materials.empty() || std::all_of(mesh.material_of.begin(), mesh.material_of.end(),
                                       [](std::uint32_t m) { return m == left_out; })) {
    mesh.material_of.clear();
    materials.clear();
    return;
  }
  const auto plain = static_cast<std::uint32_t>(materials.size());
  bool used = false;
  for (std::uint32_t& material : mesh.material_of) {
    if (material != left_out) continue;
    material = plain;
    used = true;
  }
  if (used) materials.push_back({"material", where, {}});
}

}  // namespace

Vec3d unit_normal(Vec3d n) {
  const double largest = std::max({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)});
  return largest > 0.0 ? normalize(n / largest) : Vec3d{};
}

void fill_gaps(Triangles& mesh, std::vector<Table>& materials, const Location& where) {
  fill_normals(mesh);
  fill_uvs(mesh);
  fill_materials(mesh, materials, where);
}

}  // namespace portalens
