#include "app/field_report.h"

#include <fmt/format.h>

namespace portalens {
namespace {

std::string place(Vec3d v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }

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
          {"law", space.physics.law},
          {"w", report.potential},
          {"h", report.weight},
          {"pull", to_json(report.pull)},
          {"portal_gravity", space.physics.portal_gravity},
          {"portal_gravity_depth", space.physics.portal_gravity_depth},
          {"direct", direct},
          {"through_portals", through}};
}

std::string field_text(const Space& space, const FieldReport& report) {
  std::string text = fmt::format("field at {}: {:.9g}, {}\n", place(report.position),
                                 length(report.total), place(report.total));
  text += fmt::format("law {}: w = {:.9g}, h = {:.9g}; light feels {:.9g}, {}\n", space.physics.law,
                      report.potential, report.weight, length(report.pull), place(report.pull));
  text += "directly:\n";
  for (const DirectPart& part : report.direct)
    text += line(space.masses[part.mass].name, part.acceleration,
                 fmt::format("; {:.6g} away", part.distance));
  if (report.direct.empty()) text += "  nothing\n";
  for (const Mass& mass : space.masses)
    if (mass.core == 0.0 && mass.center == report.position)
      text += fmt::format(
          "  (this is the centre of {}: its pull has no bound here, and none is told)\n",
          mass.name);
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
