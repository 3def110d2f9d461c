#include "laws.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "target.h"

namespace portalens::fuzz {
namespace {

bool printable(std::string_view text) {
  return std::none_of(text.begin(), text.end(), [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return code < 0x20 || code == 0x7f;
  });
}

bool finite(Vec3d v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_corner(const Triangles& triangles, const Triangles::Corner& corner) {
  require(corner.position < triangles.positions.size(), "a corner's vertex is there");
  require(triangles.uvs.empty() || corner.uv < triangles.uvs.size(), "a corner's uv is there");
  require(triangles.normals.empty() || corner.normal < triangles.normals.size(),
          "a corner's normal is there");
}

}  // namespace

void check_faults(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    require(!fault.problem.empty(), "a fault tells the problem");
    require(!fault.remedy.empty(), "a fault tells a remedy");
    require(printable(to_string(fault)), "a fault is told without control characters");
    require(fault.where.line >= 0, "a line is counted from 1");
  }
}

void check_scene(const Scene& scene) {
  for (const Table& table : scene.objects) require(!table.kind.empty(), "an object has a kind");
  try {
    scene.faults.raise();
  } catch (const SceneError& error) {
    check_faults(error.faults());
  }
}

void check_mesh(const MeshFile& mesh) {
  const Triangles& triangles = mesh.triangles;
  for (const auto& triangle : triangles.corners)
    for (const auto& corner : triangle) check_corner(triangles, corner);
  for (const Vec3d& position : triangles.positions) require(finite(position), "a vertex is finite");
  for (const Vec3d& normal : triangles.normals) require(finite(normal), "a normal is finite");
  const auto& materials = triangles.material_of;
  require(materials.empty() || materials.size() == triangles.corners.size(),
          "all triangles have a material, or none");
  for (const std::uint32_t material : materials)
    require(material < mesh.materials.size(), "a triangle's material is there");
}

void check_image(const Image& image) {
  require(image.width >= 1 && image.height >= 1 && image.channels == 3, "an image has pixels");
  require(image.pixels.size() == std::size_t{3} * static_cast<std::size_t>(image.width) *
                                     static_cast<std::size_t>(image.height),
          "an image has as many pixels as it says");
  require(std::all_of(image.pixels.begin(), image.pixels.end(),
                      [](float value) { return std::isfinite(value); }),
          "an image is finite");
}

}  // namespace portalens::fuzz
