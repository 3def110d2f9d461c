#include "portal/portal_set.h"

#include <cmath>
#include <limits>
#include <utility>

namespace portalens {
namespace {

/// Whether a place of its plane lies within a portal; within rounding of its rim, too.
bool holds(const Portal& portal, Vec3d place) {
  const Vec3d local = portal.frame.to_local(place);
  return within(portal.aperture, local.x, local.y, 1e-12 * portal.longest_edge);
}

double box_distance(const Box& box, const Segment& segment) {
  const auto gap = [](double low, double high, double a, double b) {
    return std::max({low - std::max(a, b), 0.0, std::min(a, b) - high});
  };
  return length(Vec3d{gap(box.low.x, box.high.x, segment.a.x, segment.b.x),
                      gap(box.low.y, box.high.y, segment.a.y, segment.b.y),
                      gap(box.low.z, box.high.z, segment.a.z, segment.b.z)});
}

double segment_distance(const Portal& portal, const Box& box, const Segment& segment) {
  const double a = portal.frame.to_local(segment.a).z, b = portal.frame.to_local(segment.b).z;
  const double from_plane = a * b > 0.0 ? std::min(std::fabs(a), std::fabs(b)) : 0.0;
  return std::max(from_plane, box_distance(box, segment));
}

}  // namespace

PortalSet::PortalSet(std::vector<Portal> portals) : portals_(std::move(portals)) {
  for (std::uint32_t i = 0; i < portals_.size(); ++i) {
    Box box;
    for (const Vec3d& vertex : portals_[i].vertices) box.add(vertex);
    boxes_.push_back(box);
    planes_.push_back({i, 1.0});
  }
}

PortalSet::PortalSet(std::vector<Portal> portals, const FlushFaces& flush,
                     std::uint32_t shape_count)
    : PortalSet(std::move(portals)) {
  for (std::uint32_t i = 0; i < portals_.size(); ++i) {
    const auto* place = flush.find(shape_count + i, 0);
    planes_[i] = {place->plane, place->side};
    for (const FaceId& over : flush.over(*place)) {
      overlapping_.resize(portals_.size());
      overlapping_[i].push_back(over.object - shape_count);
    }
  }
}

std::optional<PortalSide> PortalSet::met_at(std::uint32_t index, const Ray& ray,
                                            Vec3d place) const {
  const Portal& portal = portals_[index];
  const double slope = dot(ray.direction, portal.frame.normal);
  if (slope == 0.0 || (slope > 0.0 && !portal.has_back())) return std::nullopt;
  if (!holds(portal, place)) return std::nullopt;
  return slope < 0.0 ? PortalSide::front : PortalSide::back;
}

PortalContact PortalSet::uppermost(const PortalContact& contact, const Ray& ray) const {
  const auto leads_on = [this](const PortalContact& c) {
    return c.side == PortalSide::front || portals_[c.portal].two_sided;
  };
  PortalContact best = contact;
  if (overlapping_.empty()) return best;
  for (const std::uint32_t i : overlapping_[contact.portal]) {
    const auto side = met_at(i, ray, ray.at(contact.distance));
    if (!side) continue;
    const PortalContact other{i, *side, contact.distance};
    if (leads_on(other) != leads_on(best) ? leads_on(other) : i < best.portal) best = other;
  }
  return best;
}

std::optional<double> PortalSet::contact_near(std::uint32_t index, const Ray& ray,
                                              double reach) const {
  const Portal& portal = portals_[index];
  const double height = dot(ray.origin - portal.frame.origin, portal.frame.normal);
  const double slope = dot(ray.direction, portal.frame.normal);
  if (slope == 0.0) return std::nullopt;
  const double distance = -height / slope;
  if (!(std::fabs(distance) <= reach)) return std::nullopt;
  if (!holds(portal, ray.at(distance))) return std::nullopt;
  return distance;
}

std::optional<PortalContact> PortalSet::nearest(const Ray& ray, double low, double high,
                                                const LeftPlane& left) const {
  std::optional<PortalContact> best;
  for (std::uint32_t i = 0; i < portals_.size(); ++i) {
    const Portal& portal = portals_[i];
    const double slope = dot(ray.direction, portal.frame.normal);
    if (slope == 0.0 || (slope > 0.0 && !portal.has_back())) continue;
    double distance = -dot(ray.origin - portal.frame.origin, portal.frame.normal) / slope;
    // Paths come in pieces: what rounding put behind the plane at a joint is met there.
    const double rounding =
        1e-15 * (length(ray.origin) + length(portal.frame.origin) + portal.longest_edge);
    if (distance < low && (low - distance) * std::fabs(slope) <= rounding) distance = low;
    if (planes_[i].plane == left.plane && slope * planes_[i].side * left.side > 0.0 &&
        distance <= left.reach)
      continue;
    if (!(distance >= low && distance <= high) || (best && distance >= best->distance)) continue;
    if (!holds(portal, ray.at(distance))) continue;
    best = PortalContact{i, slope < 0.0 ? PortalSide::front : PortalSide::back, distance};
  }
  return best ? std::optional(uppermost(*best, ray)) : std::nullopt;
}

double PortalSet::clearance(Vec3d x, double limit) const {
  double least = limit;
  for (std::size_t i = 0; i < portals_.size(); ++i)
    least = std::min(least, segment_distance(portals_[i], boxes_[i], {x, x}));
  return least;
}

bool PortalSet::near(const Segment& segment, double radius) const {
  for (std::size_t i = 0; i < portals_.size(); ++i)
    if (segment_distance(portals_[i], boxes_[i], segment) <= radius) return true;
  return false;
}

}  // namespace portalens
