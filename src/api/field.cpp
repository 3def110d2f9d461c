#include "portalens/field.h"

#include "api/access.h"
#include "photon/field_parts.h"

namespace portalens::api {
namespace {

void check_places(std::span<const Vec3> places) {
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!is_finite(inward(places[i])))
      faults.push_back({"", 0, "place " + std::to_string(i) + " has a number that is not finite",
                        "three finite numbers are needed"});
  if (!faults.empty()) throw Error(Cause::asked, std::move(faults));
}

}  // namespace

std::vector<Vec3> field(const World& world, std::span<const Vec3> places) {
  return guarded([&] {
    check_places(places);
    std::vector<Vec3> accelerations;
    for (const Vec3& place : places)
      accelerations.push_back(outward(field_at(inside(world).space, inward(place))));
    return accelerations;
  });
}

Field field_parts(const World& world, Vec3 place) {
  return guarded([&] {
    check_places({&place, 1});
    const Space& space = inside(world).space;
    const FieldReport report = report_field(space, inward(place));
    Field field{place, outward(report.total), {}};
    for (const DirectPart& part : report.direct)
      field.parts.push_back(
          {space.masses[part.mass].name, {}, outward(part.acceleration), part.distance});
    for (const PullPart& part : report.through) {
      FieldPart& out = field.parts.emplace_back();
      if (part.mass) out.mass = space.masses[*part.mass].name;
      for (const std::uint32_t portal : part.portals)
        out.portals.push_back(space.mouths[portal].name);
      out.acceleration = outward(part.acceleration);
      out.distance = part.distance;
    }
    return field;
  });
}

}  // namespace portalens::api
