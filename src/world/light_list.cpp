#include "world/light_list.h"

#include <utility>

namespace portalens {
namespace {

std::vector<TriangleLight::Triangle> shining_faces(const Mesh& mesh, const Body& body,
                                                   const std::vector<Material>& materials) {
  std::vector<TriangleLight::Triangle> triangles;
  for (std::uint32_t face = 0; face < mesh.triangle_count(); ++face) {
    const Material& material = materials[body.material_of(face)];
    if (!material.emits()) continue;
    const auto corners = mesh.triangle(face);
    triangles.push_back({corners[0], corners[1], corners[2], material.emitted});
  }
  return triangles;
}

std::vector<TriangleLight::Triangle> fan(const Portal& portal, Rgb emitted) {
  std::vector<TriangleLight::Triangle> triangles;
  const std::vector<Vec3d>& v = portal.vertices;
  for (std::size_t i = 2; i < v.size(); ++i) triangles.push_back({v[0], v[i - 1], v[i], emitted});
  return triangles;
}

}  // namespace

std::vector<Light> read_lights(const std::vector<Table>& tables, Names& names, Faults& faults) {
  std::vector<Light> lights;
  for (const Table& table : tables) {
    Parameters parameters(table, faults);
    const std::string name = names.claim(parameters);
    PointLight light = PointLight::from(parameters);
    light.name = name;
    parameters.finish();
    lights.push_back(std::move(light));
  }
  return lights;
}

std::vector<Light> emitters(const Objects& objects, const std::vector<Material>& materials) {
  std::vector<Light> lights;
  for (std::size_t i = 0; i < objects.shapes.size(); ++i) {
    const Body& body = objects.bodies[i];
    if (const auto* mesh = std::get_if<Mesh>(&objects.shapes[i])) {
      auto triangles = shining_faces(*mesh, body, materials);
      if (!triangles.empty())
        lights.push_back(TriangleLight(body.name, std::move(triangles), Shining::both_sides));
    } else if (materials[body.material].emits()) {
      lights.push_back(ShapeLight(body.name, objects.shapes[i], materials[body.material].emitted));
    }
  }
  for (const Portal& portal : objects.portals) {
    if (!portal.back_material || !materials[*portal.back_material].emits()) continue;
    auto triangles = fan(portal, materials[*portal.back_material].emitted);
    lights.push_back(TriangleLight(portal.name, std::move(triangles), Shining::back_only));
  }
  return lights;
}

}  // namespace portalens
