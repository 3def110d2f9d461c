#include "world/object_reader.h"

#include <optional>
#include <utility>

#include "core/choice.h"
#include "geometry/extent.h"

namespace portalens {
namespace {

class ObjectReader {
 public:
  ObjectReader(const ObjectContext& context, Faults& faults)
      : context_(context), faults_(faults), portals_(faults) {}

  void read(const Table& table) {
    Parameters parameters(table, faults_);
    const std::string name = context_.names.claim(parameters);
    if (table.kind == "portal") {
      portals_.read(parameters, name, context_.materials, context_.physics, objects_.masses);
    } else if (table.kind == "mass") {
      const Vec3d center = to_vec3(parameters.triple("center", coordinate));
      (void)read_mass(parameters, name, MassKey::required, center, context_.physics,
                      objects_.masses);
    } else if (!read_shape(parameters, name)) {
      return;
    }
    parameters.finish();
  }

  [[nodiscard]] Objects take() && {
    objects_.portals = portals_.join();
    return std::move(objects_);
  }

 private:
  /// @return false if there is no such kind of shape, which `refuse_unknown_tables` tells
  bool read_shape(Parameters& parameters, const std::string& name) {
    const std::size_t before = faults_.size();
    auto shape = Choice<Shape>::make(parameters.kind(), parameters);
    if (!shape) return false;
    Body body;
    body.name = name;
    body.kind = parameters.kind();
    if (auto* mesh = std::get_if<Mesh>(&*shape)) load(*mesh, body, parameters);
    const bool sound = faults_.size() == before;
    if (body.face_materials.empty())
      body.material = context_.materials.named_by(parameters, "material");
    const Vec3d center =
        sound ? std::visit([](const auto& s) { return s.center_of_mass(); }, *shape) : Vec3d{};
    body.mass =
        read_mass(parameters, name, MassKey::optional, center, context_.physics, objects_.masses);
    if (!sound) return true;
    objects_.shapes.push_back(std::move(*shape));
    objects_.bodies.push_back(std::move(body));
    return true;
  }

  /// A mesh's file has materials of its own, unless the scene gives it one.
  void load(Mesh& mesh, Body& body, Parameters& parameters) {
    MeshWanted wanted;
    if (parameters.has("material")) wanted.materials = FileMaterials::passed_over;
    if (parameters.has("smooth")) wanted.crease = parameters.number("smooth", {0.0, 180.0});
    auto loaded = context_.meshes.load(mesh, wanted, parameters.where("file"));
    if (!loaded) return;
    mesh = std::move(loaded->mesh);
    if (!loaded->first_material) return;
    for (std::uint32_t face = 0; face < mesh.triangle_count(); ++face)
      body.face_materials.push_back(*loaded->first_material + mesh.material_of(face).value_or(0));
    body.material = body.face_materials.front();
  }

  const ObjectContext& context_;
  Faults& faults_;
  PortalReader portals_;
  Objects objects_;
};

}  // namespace

Objects read_objects(const Scene& scene, const ObjectContext& context, Faults& faults) {
  ObjectReader reader(context, faults);
  for (const Table& table : scene.objects) reader.read(table);
  return std::move(reader).take();
}

}  // namespace portalens
