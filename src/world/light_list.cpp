#include "world/light_list.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "core/choice.h"

namespace portalens {
namespace {

/// What a body gives, if it emits.
struct EmitterOf {
  const Body& body;
  const std::vector<Material>& materials;

  template <class Any>
  std::optional<Light> operator()(const Any& shape) const {
    const Material& material = materials[body.material];
    if (!material.emits()) return std::nullopt;
    return ShapeLight(shape, material.emitted(), material.shines());
  }

  /// Only a mesh has more than one material.
  std::optional<Light> operator()(const Mesh& mesh) const {
    std::vector<Texture> emitted;
    std::map<std::uint32_t, std::uint32_t> index_of;  // of materials that emit
    for (std::uint32_t face = 0; face < mesh.triangle_count(); ++face) {
      const std::uint32_t material = body.material_of(face);
      if (!materials[material].emits()) continue;
      if (index_of.emplace(material, emitted.size()).second)
        emitted.push_back(materials[material].emitted());
    }
    if (emitted.empty()) return std::nullopt;
    const auto emitted_by = [&](std::uint32_t face) -> std::optional<std::uint32_t> {
      const auto found = index_of.find(body.material_of(face));
      return found == index_of.end() ? std::nullopt : std::optional(found->second);
    };
    return MeshLight(mesh, std::move(emitted), emitted_by);
  }
};

double found_area_of(const Light& light) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.found_area(); })
          return one.found_area();
        else
          return 0.0;
      },
      light);
}

}  // namespace

std::vector<NamedLight> read_lights(const std::vector<Table>& tables, Names& names,
                                    Faults& faults) {
  std::vector<NamedLight> lights;
  const std::vector<std::string_view> types = Choice<Light>::names();
  for (const Table& table : tables) {
    Parameters parameters(table, faults);
    const std::string name = names.claim(parameters);
    std::string type = parameters.choice("type", types, std::string(PointLight::name));
    if (type == PointLight::name && parameters.has("radius")) type = SphereLight::name;
    auto light = Choice<Light>::make(type, parameters);
    if (!light) continue;
    parameters.finish();
    lights.push_back({name, std::move(*light)});
  }
  return lights;
}

std::vector<NamedLight> emitters(Objects& objects, const std::vector<Material>& materials) {
  std::vector<NamedLight> lights;
  for (std::size_t i = 0; i < objects.shapes.size(); ++i) {
    Body& body = objects.bodies[i];
    auto light = std::visit(EmitterOf{body, materials}, objects.shapes[i]);
    if (!light) continue;
    body.found_area = found_area_of(*light);
    lights.push_back({body.name, std::move(*light)});
  }
  for (const Portal& portal : objects.portals) {
    if (!portal.back_material || !materials[*portal.back_material].emits()) continue;
    lights.push_back(
        {portal.name, PortalBackLight(portal, materials[*portal.back_material].emitted())});
  }
  return lights;
}

std::optional<NamedLight> sky_light(const Environment& sky, const Objects& objects,
                                    const std::vector<Material>& materials) {
  const auto shows = [&](const Body& body) { return materials[body.material].answers_lamps(); };
  const auto shows_back = [&](const Portal& portal) {
    return portal.back_material && materials[*portal.back_material].answers_lamps();
  };
  if (!sky.lights || is_black(sky) ||
      !(std::any_of(objects.bodies.begin(), objects.bodies.end(), shows) ||
        std::any_of(objects.portals.begin(), objects.portals.end(), shows_back)))
    return std::nullopt;
  return NamedLight{"environment", SkyLight(sky)};
}

void add_lamp_bodies(const std::vector<NamedLight>& lights, Objects& objects,
                     std::vector<Material>& materials) {
  for (const NamedLight& lamp : lights)
    std::visit(
        [&](const auto& light) {
          if constexpr (requires { light.body(); })
            if (auto shape = light.body()) {
              Body body;
              body.name = lamp.name;
              body.kind = "lamp";
              body.found_area = found_area_of(lamp.light);
              body.material = static_cast<std::uint32_t>(materials.size());
              objects.shapes.push_back(std::move(*shape));
              objects.bodies.push_back(std::move(body));
              materials
                  .emplace_back(DiffuseMirror(Constant{{}}), Constant{light.radiance()},
                                Shines::in_front)
                  .name = lamp.name;
            }
        },
        lamp.light);
}

}  // namespace portalens
