#include "photon/obstacles.h"

#include <cmath>

namespace portalens {

std::optional<Encounter> Obstacles::first(const Ray& ray, double high,
                                          const PathStart& start) const {
  std::optional<Encounter> found;
  const LeftPlane left = surfaces_.flush().left_by(start.guard);
  if (const auto portal = portals_.nearest(ray, 0.0, high, left)) {
    found = at_portal(portal->portal, portal->side, portal->distance);
    high = portal->distance;
  }
  const auto hit = surfaces_.nearest(ray, 0.0, high, start.guard);
  // At a tie the portal comes first.
  if (!hit || (found && found->distance <= hit->distance)) return found;
  return uppermost(*hit, ray);
}

Encounter Obstacles::at_portal(std::uint32_t portal, PortalSide side, double distance) const {
  if (side == PortalSide::front) return {distance, Encounter::Kind::portal_front, portal, 0};
  const bool leads_on = portals_.portals()[portal].two_sided;
  return {distance, leads_on ? Encounter::Kind::portal_through_back : Encounter::Kind::portal_back,
          portal, 0};
}

Encounter Obstacles::uppermost(const SurfaceHit& hit, const Ray& ray) const {
  const FlushFaces& flush = surfaces_.flush();
  const auto shape_count = static_cast<std::uint32_t>(surfaces_.shapes().size());
  Encounter seen{hit.distance, Encounter::Kind::surface, hit.shape, hit.face};
  const auto* place = flush.find(hit.shape, hit.face);
  if (!place) return seen;
  for (const FaceId& over : flush.over(*place)) {
    if (over.object < shape_count) break;  // portals come before surfaces
    const std::uint32_t portal = over.object - shape_count;
    const auto side = portals_.met_at(portal, ray, ray.at(hit.distance));
    if (!side) continue;
    const Encounter met = at_portal(portal, *side, hit.distance);
    if (met.kind != Encounter::Kind::portal_back) return met;
    if (seen.kind == Encounter::Kind::surface) seen = met;
  }
  return seen;
}

std::optional<Encounter> Obstacles::first(const Curve& curve, double free, double flatness,
                                          const PathStart& start) const {
  // A little less than that far: something may lie there.
  const double from = 0.99 * free, end = curve.length();
  return in_section(curve, {from, end, curve.position(from), curve.position(end)}, flatness, start);
}

std::optional<Encounter> Obstacles::in_section(const Curve& curve, const Section& section,
                                               double flatness, const PathStart& start) const {
  const double sagitta = curve.sagitta(section.s1 - section.s0);
  const Segment chord{section.x0, section.x1};
  const Vec3d along = section.x1 - section.x0;
  const double chord_length = length(along);
  if (!(chord_length > 0.0)) return std::nullopt;
  // Halving ends where rounding makes it pointless, whatever was asked; and what the chord crosses
  // may seem to be as far off.
  const double finest = 1e-13 * (length(section.x0) + chord_length);
  const double close = std::fmax(sagitta, finest);
  const bool flat = sagitta <= std::fmax(flatness, finest);
  // To ask what is met is as cheap as whether anything is near.
  if (!flat && !surfaces_.near(chord, close) && !portals_.near(chord, close)) return std::nullopt;

  if (flat) {
    const auto found =
        first(Ray{section.x0, along / chord_length}, chord_length, start.after(section.s0));
    if (!found) return std::nullopt;
    const auto refined = refine(curve, section, *found);
    if (refined && !left_behind(curve, *refined, start.guard)) {
      if (refined->kind != Encounter::Kind::surface) return refined;
      const double s = refined->distance;
      Encounter seen =
          uppermost({refined->object, refined->face, 0.0}, {curve.position(s), curve.direction(s)});
      seen.distance = s;
      return seen;
    }
    if (sagitta <= finest) {
      Encounter at = *found;
      at.distance = section.s0 + found->distance / chord_length * (section.s1 - section.s0);
      return at;
    }
  }

  const double middle = 0.5 * (section.s0 + section.s1);
  const Vec3d x = curve.position(middle);
  if (const auto found = in_section(curve, {section.s0, middle, section.x0, x}, flatness, start))
    return found;
  return in_section(curve, {middle, section.s1, x, section.x1}, flatness, start);
}

bool Obstacles::left_behind(const Curve& curve, const Encounter& met,
                            const SelfIntersectionGuard& guard) const {
  if (met.kind != Encounter::Kind::surface || met.object != guard.shape || met.face != guard.face ||
      met.distance > guard.reach)
    return false;
  const Vec3d normal =
      surfaces_.surface_at(met.object, met.face, curve.position(met.distance)).geometric_normal;
  return dot(curve.direction(met.distance), normal) * guard.side > 0.0;
}

/// Newton's method: the tangent of the curve, met with the surface, gives the next guess.
std::optional<Encounter> Obstacles::refine(const Curve& curve, const Section& section,
                                           Encounter found) const {
  const double span = section.s1 - section.s0;
  const double chord = length(section.x1 - section.x0);
  double s = section.s0 + found.distance / chord * span;
  for (int i = 0; i < 12; ++i) {
    const Ray tangent{curve.position(s), curve.direction(s)};
    std::optional<double> ahead;
    if (found.kind == Encounter::Kind::surface) {
      if (const auto contact = surfaces_.contact_near(found.object, found.face, tangent, span))
        ahead = contact->distance;
    } else {
      ahead = portals_.contact_near(found.object, tangent, span);
    }
    if (!ahead) return std::nullopt;
    s += *ahead;
    if (s < section.s0 - 0.1 * span || s > section.s1 + 0.1 * span) return std::nullopt;
    if (std::fabs(*ahead) <= 1e-14 * (1.0 + s + length(tangent.origin))) {
      found.distance = std::fmin(std::fmax(s, 0.0), curve.length());
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace portalens
