#include "lanes/face_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/words.h"
#include "lanes/narrow.h"

namespace portalens {
namespace {

/// What an aperture says of itself (`lay_out`, portal/aperture.h), as an outline.
class OutlineLayout {
 public:
  explicit OutlineLayout(const Portal& portal) : portal_(portal) {}

  /// @param edges  counter-clockwise
  void polygon(std::span<const PlaneEdge> edges, bool convex) {
    found_ = true;
    if (edges.size() > max_lane_edges) {
      made_.refusal = fmt::format("portal {} has {} edges (lanes take {})", in_quotes(portal_.name),
                                  edges.size(), max_lane_edges);
      return;
    }
    LaneOutline& outline = made_.outline;
    outline.kind = convex ? LaneOutline::Kind::convex : LaneOutline::Kind::simple;
    outline.longest = static_cast<float>(longest_of(edges));
    for (std::size_t i = 0; i < edges.size(); ++i)
      add_edge(edges[(i + edges.size() - 1) % edges.size()], edges[i],
               edges[(i + 1) % edges.size()]);
  }

  /// About the frame's origin, with radii along `right` and `up`.
  void ellipse(double a, double b) {
    found_ = true;
    made_.outline.kind = LaneOutline::Kind::ellipse;
    made_.outline.radius_x = static_cast<float>(a);
    made_.outline.radius_y = static_cast<float>(b);
    made_.outline.per_x = static_cast<float>(1.0 / a);
    made_.outline.per_y = static_cast<float>(1.0 / b);
  }

  [[nodiscard]] FaceLayout made() {
    if (!found_)
      made_.refusal = fmt::format("portal {} is a {} (lanes take polygons and ellipses)",
                                  in_quotes(portal_.name), name_of(portal_.aperture));
    return std::move(made_);
  }

 private:
  void add_edge(const PlaneEdge& last, const PlaneEdge& edge, const PlaneEdge& next) {
    const double begin = edge.start_x * edge.direction_x + edge.start_y * edge.direction_y;
    const double turn = last.direction_x * edge.direction_y - last.direction_y * edge.direction_x;
    made_.outline.edges[made_.outline.count++] = {static_cast<float>(edge.direction_x),
                                                  static_cast<float>(edge.direction_y),
                                                  static_cast<float>(begin),
                                                  static_cast<float>(edge.length),
                                                  static_cast<float>(-edge.outside(0.0, 0.0)),
                                                  static_cast<float>(edge.start_y),
                                                  static_cast<float>(next.start_y),
                                                  turn < 0.0 ? 1.0f : 0.0f};
  }

  const Portal& portal_;
  FaceLayout made_{};
  bool found_ = false;
};

}  // namespace

Rectangle rectangle_of(const Portal& portal) {
  if (portal.vertices.size() != 4) return {};
  const Vec3d corner = portal.frame.to_local(portal.vertices[2]);
  const Vec3d expected[4] = {{-corner.x, -corner.y, 0},
                             {corner.x, -corner.y, 0},
                             {corner.x, corner.y, 0},
                             {-corner.x, corner.y, 0}};
  for (int i = 0; i < 4; ++i)
    if (length(portal.frame.to_local(portal.vertices[i]) - expected[i]) >
        1e-9 * portal.longest_edge)
      return {};
  return {corner.x, corner.y};
}

Rectangle extent_of(const Portal& portal) {
  Rectangle extent = rectangle_of(portal);
  if (extent.half_width > 0.0) return extent;
  const PlaneBox box = box_of(portal.aperture);
  extent.half_width = std::max(std::fabs(box.low_x), std::fabs(box.high_x));
  extent.half_height = std::max(std::fabs(box.low_y), std::fabs(box.high_y));
  return extent;
}

FaceLayout lay_out_face(const Portal& portal) {
  OutlineLayout layout(portal);
  const auto tell = [&](const auto& aperture) {
    if constexpr (requires { aperture.lay_out(layout); }) aperture.lay_out(layout);
  };
  std::visit(tell, portal.aperture);
  return layout.made();
}

double farthest(const Portal& portal, Vec3d from) {
  double distance = 0.0;
  for (const Vec3d& vertex : portal.vertices) distance = std::max(distance, length(vertex - from));
  return distance;
}

float ball_about(const Portal& portal, double reach, double extent) {
  return static_cast<float>(1.001 * (reach + farthest(portal, portal.frame.origin)) +
                            1e-5 * extent);
}

LaneFace face_of(const Portal& portal, Vec3d center, double reach, double extent) {
  const Rectangle rectangle = rectangle_of(portal);
  return {narrow(portal.frame.origin - center),
          narrow(portal.frame.right),
          narrow(portal.frame.up),
          narrow(portal.frame.normal),
          static_cast<float>(rectangle.half_width),
          static_cast<float>(rectangle.half_height),
          nullptr,
          static_cast<float>(portal.height_tolerance()),
          static_cast<float>(reach),
          static_cast<float>(reach * reach),
          ball_about(portal, reach, extent)};
}

}  // namespace portalens
