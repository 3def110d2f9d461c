#include "differential/draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace portalens::differential {
namespace {

std::string written(Vec3d v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

std::string written(const std::vector<Vec3d>& corners) {
  std::string text = "[";
  for (const Vec3d& corner : corners) text += (text.size() > 1 ? ", " : "") + written(corner);
  return text + "]";
}

std::string written(const DraftWeight& weight) {
  if (weight.mass <= 0.0) return {};
  std::string text = fmt::format("mass = {}\n", weight.mass);
  if (weight.core > 0.0) {
    text += fmt::format("core_radius = {}\n", weight.core);
    if (weight.horizon) text += "horizon = true\n";
  }
  return text;
}

std::string written(const DraftBody& body, std::size_t index) {
  const char* material = body.mirror ? "mirror" : "grey";
  std::string text;
  switch (body.form) {
    case Form::sphere:
      text = fmt::format("[[sphere]]\nname = \"s{}\"\ncenter = {}\nradius = {}\n", index,
                         written(body.center), body.size);
      break;
    case Form::quad:
      text = fmt::format("[[quad]]\nname = \"q{}\"\nvertices = {}\n", index, written(body.corners));
      break;
    case Form::cube:
      text = fmt::format("[[cube]]\nname = \"c{}\"\ncenter = {}\nsize = {}\nrotation = {}\n", index,
                         written(body.center), body.size, written(body.turn));
      break;
    case Form::mesh:
      text = fmt::format(
          "[[mesh]]\nname = \"o{}\"\nfile = \"{}\"\ntranslate = {}\nscale = {}\nrotation = {}\n",
          index, mesh_name, written(body.center), body.size, written(body.turn));
      break;
  }
  return text + fmt::format("material = \"{}\"\n", material) + written(body.weight);
}

/// A tint of its own for each portal, so that the tint of a photon tells which it has crossed.
Vec3d tint_of(std::size_t portal) {
  const double k = static_cast<double>(portal);
  return {1.0 - 0.017 * (k + 1.0), 1.0 - 0.0031 * (k * k + 1.0), 1.0};
}

std::string face_of(const DraftPortal& portal) {
  const std::vector<Vec3d>& corners = portal.corners;
  if (!portal.round) return fmt::format("vertices = {}\n", written(corners));
  const Vec3d across = corners[1] - corners[0], along = corners[3] - corners[0];
  return fmt::format("center = {}\nfacing = {}\nup = {}\nradius = [{}, {}]\n",
                     written((corners[0] + corners[2]) * 0.5),
                     written(normalize(cross(across, along))), written(normalize(along)),
                     0.5 * length(across), 0.5 * length(along));
}

std::string written(const DraftPortal& portal, std::size_t index) {
  return fmt::format("[[portal]]\nname = \"p{}\"\npair = \"p{}\"\n{}tint = {}\n", index, index ^ 1u,
                     face_of(portal), written(tint_of(index))) +
         (portal.solid_back ? "back = \"grey\"\n" : "") + written(portal.weight);
}

/// Those that something has.
std::string materials_of(const Draft& draft) {
  const auto has = [&](bool mirror) {
    return std::any_of(draft.bodies.begin(), draft.bodies.end(),
                       [&](const DraftBody& body) { return body.mirror == mirror; });
  };
  const bool backs = std::any_of(draft.portals.begin(), draft.portals.end(),
                                 [](const DraftPortal& portal) { return portal.solid_back; });
  std::string text;
  if (backs || has(false)) text += "[[material]]\nname = \"grey\"\ndiffuse = [0.5, 0.5, 0.5]\n";
  if (has(true))
    text += "[[material]]\nname = \"mirror\"\ndiffuse = [0, 0, 0]\nreflective = [0.9, 0.9, 0.9]\n";
  return text;
}

}  // namespace

std::string mesh_text() {
  return "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
         "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
}

bool has_mesh(const Draft& draft) {
  return std::any_of(draft.bodies.begin(), draft.bodies.end(),
                     [](const DraftBody& body) { return body.form == Form::mesh; });
}

std::string to_toml(const Draft& draft, const std::string& comment) {
  std::string text = "# " + comment + "\n";
  auto to = std::back_inserter(text);
  const DraftCamera& camera = draft.camera;
  fmt::format_to(to, "[camera]\nposition = {}\nlook_at = {}\nup = {}\nfov = {}\n",
                 written(camera.position), written(camera.target), written(camera.up), camera.fov);
  fmt::format_to(to, "[film]\nwidth = {}\nheight = {}\n[sampler]\nsamples = 1\n", draft.width,
                 draft.height);
  fmt::format_to(to, "[physics]\nc = 45.0\nmin_force = {}\ntolerance = {}\nmax_length = {}\n",
                 draft.min_force, draft.tolerance, draft.max_length);
  fmt::format_to(to, "portal_gravity = \"{}\"\nportal_gravity_depth = {}\n", draft.coupling,
                 draft.depth);
  fmt::format_to(to, "graviton_resolution = {}\n", draft.resolution);
  text += "[environment]\ncolor = [0.2, 0.3, 0.5]\n" + materials_of(draft);
  for (std::size_t i = 0; i < draft.masses.size(); ++i)
    text +=
        fmt::format("[[mass]]\nname = \"m{}\"\ncenter = {}\n", i, written(draft.masses[i].center)) +
        written(draft.masses[i].weight);
  for (std::size_t i = 0; i < draft.bodies.size(); ++i) text += written(draft.bodies[i], i);
  for (std::size_t i = 0; i < draft.portals.size(); ++i) text += written(draft.portals[i], i);
  return text;
}

}  // namespace portalens::differential
