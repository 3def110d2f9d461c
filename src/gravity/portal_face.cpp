#include "gravity/portal_face.h"

#include <utility>

namespace portalens {

PortalFace::PortalFace(const Portal& portal)
    : PortalFace(portal.aperture, portal.frame, portal.height_tolerance()) {}

PortalFace::PortalFace(Aperture aperture, const Frame& frame, double height_tolerance)
    : frame_(frame), aperture_(std::move(aperture)), tolerance_(height_tolerance) {
  const auto add = [&](const std::vector<PlaneEdge>& edges) {
    edges_.reserve(edges.size());
    for (const PlaneEdge& edge : edges)
      edges_.push_back({edge, frame_.to_world({edge.start_x, edge.start_y, 0.0}),
                        frame_.direction_to_world({edge.direction_x, edge.direction_y, 0.0})});
  };
  std::visit([&](const auto& a) { add(a.edges()); }, aperture_);
}

double PortalFace::distance(Vec3d x) const {
  Vec3d local = frame_.to_local(x);
  const double height = local.z;
  local.z = 0.0;
  const Vec3d nearest_place = place(nearest(local), local);
  local.z = height;
  return length(local - nearest_place);
}

}  // namespace portalens
