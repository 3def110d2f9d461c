#include "world/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/words.h"
#include "world/portal_overlap.h"
#include "world/world.h"

namespace portalens {
namespace {

/// Collects warnings of one kind after another; of each, the first few are told.
class Warnings {
 public:
  template <class... Values>
  void add(fmt::format_string<Values...> text, Values&&... values) {
    if (++count_ < most_of_a_kind) {
      told_.push_back(fmt::format(text, std::forward<Values>(values)...));
    } else if (count_ == most_of_a_kind) {
      told_.push_back("... and more like the last");
    }
  }
  [[nodiscard]] bool full() const { return count_ >= most_of_a_kind; }
  void next_kind() { count_ = 0; }
  [[nodiscard]] std::vector<std::string> take() && { return std::move(told_); }

 private:
  static constexpr std::size_t most_of_a_kind = 10;

  std::vector<std::string> told_;
  std::size_t count_ = 0;
};

void about_camera(const World& world, Warnings& warnings) {
  for (const Mass& mass : world.space.masses) {
    const double distance = length(world.camera.position - mass.center);
    if (mass.horizon && distance <= mass.schwarzschild) {
      warnings.add("the camera lies within the horizon of {}: all is black",
                   portalens::quoted(mass.name));
    } else if (distance < mass.influence && std::isfinite(mass.influence)) {
      warnings.add("the camera lies within the influence of {} (distance {:.4g}, radius {:.4g})",
                   portalens::quoted(mass.name), distance, mass.influence);
    }
  }
}

void about_materials(const World& world, Warnings& warnings) {
  std::map<const Image*, Rgb> known;  // an image may serve many materials
  const auto brightest_of = [&](const Texture& texture) {
    const auto* picture = std::get_if<Picture>(&texture);
    if (!picture) return brightest(texture);
    const auto [place, is_new] = known.emplace(picture->image.get(), Rgb{});
    if (is_new) place->second = brightest(texture);
    return place->second;
  };
  for (const Material& material : world.appearance.materials) {
    const double most = max_component(brightest_of(material.diffuse) + material.reflective);
    if (most > 1.0)
      warnings.add(
          "material {} gives back more light than it gets: diffuse + reflective reaches {:.4g}",
          portalens::quoted(material.name), most);
  }
}

void about_pulls(const World& world, Warnings& warnings) {
  for (const Mass& mass : world.space.masses)
    if (!mass.horizon && mass.core == 0.0)
      warnings.add(
          "mass {} has neither a horizon nor a core: near its centre the pull has no bound",
          portalens::quoted(mass.name));
}

void about_horizons(const World& world, Warnings& warnings) {
  const std::vector<Mass>& masses = world.space.masses;
  for (std::size_t i = 0; i < masses.size(); ++i)
    for (std::size_t j = 0; j < i && !warnings.full(); ++j) {
      const Mass &a = masses[i], &b = masses[j];
      if (a.horizon && b.horizon && length(a.center - b.center) < a.schwarzschild + b.schwarzschild)
        warnings.add("the horizons of {} and {} overlap", portalens::quoted(b.name),
                     portalens::quoted(a.name));
    }
}

/// A surface that no photon can reach, since the horizon of its own mass lies around all of it.
void about_hidden_bodies(const World& world, Warnings& warnings) {
  for (std::size_t i = 0; i < world.appearance.bodies.size(); ++i) {
    const Body& body = world.appearance.bodies[i];
    if (!body.mass) continue;
    const Mass& mass = world.space.masses[*body.mass];
    const Box box =
        std::visit([](const auto& s) { return s.bounds(); }, world.space.surfaces.shapes()[i]);
    const auto reach = [](double low, double high, double center) {
      return std::max(std::fabs(low - center), std::fabs(high - center));
    };
    const Vec3d farthest{reach(box.low.x, box.high.x, mass.center.x),
                         reach(box.low.y, box.high.y, mass.center.y),
                         reach(box.low.z, box.high.z, mass.center.z)};
    if (mass.horizon && length(farthest) <= mass.schwarzschild)
      warnings.add(
          "the surface of {} lies within its own horizon (radius {:.4g}) and is never seen",
          portalens::quoted(body.name), mass.schwarzschild);
  }
}

void about_portals(const World& world, Warnings& warnings) {
  const auto portals = world.space.portals.portals();
  for (std::size_t i = 0; i < portals.size(); ++i)
    for (std::size_t j = 0; j < i && !warnings.full(); ++j)
      if (portals_overlap(portals[j], portals[i]))
        warnings.add(
            "portals {} and {} lie in one plane and overlap: where they do, the first one counts",
            portalens::quoted(portals[j].name), portalens::quoted(portals[i].name));
}

void about_light(const World& world, Warnings& warnings) {
  const Appearance& look = world.appearance;
  const bool dark_sky = !look.environment.image && look.environment.color == Rgb{};
  if (look.lights.empty() && dark_sky && look.limits.ambient == Rgb{})
    warnings.add("nothing gives light: the picture will be black");
}

}  // namespace

std::vector<std::string> warnings_about(const World& world) {
  Warnings warnings;
  for (const auto about : {about_camera, about_materials, about_pulls, about_horizons,
                           about_hidden_bodies, about_portals, about_light}) {
    about(world, warnings);
    warnings.next_kind();
  }
  return std::move(warnings).take();
}

}  // namespace portalens
