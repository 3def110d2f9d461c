#include "app/field_report.h"

#include <fmt/format.h>

#include <variant>

#include "gravity/attraction.h"

namespace portalens {
namespace {

std::string place(Vec3d v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }

bool acts(const Mass& mass, Vec3d x) {
  const Vec3d to = mass.center - x;
  const double square = dot(to, to);
  // Exactly at a point mass no direction is better than another.
  return mass.gm > 0.0 && square < mass.influence * mass.influence &&
         square + mass.core * mass.core > 0.0;
}

Vec3d pull_of(const Mass& mass, Vec3d x) {
  return attraction(mass.center - x, mass.gm, mass.core * mass.core);
}

/// "blue, orange": the portals of a path.
std::string names_of(const Space& space, const std::vector<std::uint32_t>& portals) {
  std::string names;
  for (const std::uint32_t portal : portals)
    names += (names.empty() ? "" : ", ") + space.mouths[portal].name;
  return names;
}

std::string line(const std::string& title, Vec3d acceleration, const std::string& rest) {
  return fmt::format("  {:<36} {:.6g}  {}{}\n", title, length(acceleration), place(acceleration),
                     rest);
}

}  // namespace

Vec3d field_at(const Space& space, Vec3d x) {
  Vec3d total = std::visit([&](const auto& coupling) { return coupling.pull(x, x).acceleration; },
                           space.coupling);
  for (const Mass& mass : space.masses)
    if (acts(mass, x)) total += pull_of(mass, x);
  return total;
}

FieldReport report_field(const Space& space, Vec3d x) {
  FieldReport report;
  report.position = x;
  report.total = field_at(space, x);
  for (std::uint32_t i = 0; i < space.masses.size(); ++i) {
    const Mass& mass = space.masses[i];
    if (acts(mass, x)) report.direct.push_back({i, pull_of(mass, x), length(mass.center - x)});
  }
  report.through =
      std::visit([&](const auto& coupling) { return coupling.parts(x); }, space.coupling);
  return report;
}

Json field_json(const Space& space, const FieldReport& report) {
  Json direct = Json::array(), through = Json::array();
  for (const DirectPart& part : report.direct)
    direct.push_back({{"mass", space.masses[part.mass].name},
                      {"acceleration", to_json(part.acceleration)},
                      {"distance", part.distance}});
  for (const PullPart& part : report.through) {
    Json portals = Json::array(), places = Json::array();
    for (const std::uint32_t portal : part.portals) portals.push_back(space.mouths[portal].name);
    for (const Vec3d& at : part.places) places.push_back(to_json(at));
    through.push_back({{"portals", portals},
                       {"mass", part.mass ? Json(space.masses[*part.mass].name) : Json()},
                       {"acceleration", to_json(part.acceleration)},
                       {"distance", part.distance},
                       {"places", places},
                       {"beyond", to_json(part.beyond)}});
  }
  return {{"position", to_json(report.position)},
          {"acceleration", to_json(report.total)},
          {"portal_gravity", space.physics.portal_gravity},
          {"portal_gravity_depth", space.physics.portal_gravity_depth},
          {"direct", direct},
          {"through_portals", through}};
}

std::string field_text(const Space& space, const FieldReport& report) {
  std::string text = fmt::format("field at {}: {:.9g}, {}\n", place(report.position),
                                 length(report.total), place(report.total));
  text += "directly:\n";
  for (const DirectPart& part : report.direct)
    text += line(space.masses[part.mass].name, part.acceleration,
                 fmt::format("; {:.6g} away", part.distance));
  if (report.direct.empty()) text += "  nothing\n";
  text += fmt::format("through portals ({}, depth {}):\n", space.physics.portal_gravity,
                      space.physics.portal_gravity_depth);
  for (const PullPart& part : report.through) {
    std::string rest = fmt::format("; way {:.6g}", part.distance);
    for (const Vec3d& at : part.places) rest += ", by " + place(at);
    text += line(names_of(space, part.portals) +
                     (part.mass ? " to " + space.masses[*part.mass].name : std::string()),
                 part.acceleration, rest + ", to " + place(part.beyond));
  }
  if (report.through.empty()) text += "  nothing\n";
  return text;
}

}  // namespace portalens
