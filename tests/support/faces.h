/// \file
/// Faces of all kinds that portals may have, about the origin and elsewhere.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "portal/portal.h"

namespace portalens::test {

inline FaceInput ellipse_input(const Frame& frame, double across, double along) {
  FaceInput input;
  input.frame = frame;
  input.radii = {across, along};
  return input;
}

/// Corners on an ellipse, so many.
inline std::vector<Vec3d> corners_on_ellipse(double across, double along, int count) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    corners.push_back({across * std::cos(angle), along * std::sin(angle), 0.0});
  }
  return corners;
}

/// The same with a first edge that is level: then the frame of such a polygon is the ellipse's.
inline FaceInput many_edges(double across, double along, int count) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < count; ++i) {
    const double angle = std::numbers::pi * ((2.0 * i - 1.0) / count - 0.5);
    corners.push_back({across * std::cos(angle), along * std::sin(angle), 0.0});
  }
  return polygon_input(std::move(corners));
}

/// Five points, the inner corners at a share of the outer ones' radius.
inline std::vector<Vec3d> star(double radius, double inner) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < 10; ++i) {
    const double angle = std::numbers::pi * (0.2 * i + 0.03), r = radius * (i % 2 ? inner : 1.0);
    corners.push_back({r * std::cos(angle), r * std::sin(angle), 0.0});
  }
  return corners;
}

/// An L and, two by two, the edges of its notch.
inline std::vector<Vec3d> letter_l() {
  return {{-1, -1, 0}, {1.5, -1, 0}, {1.5, -0.2, 0}, {0.1, -0.2, 0}, {0.1, 1.4, 0}, {-1, 1.4, 0}};
}

inline std::vector<Vec3d> comb() {
  return {{-2, -1, 0},     {2, -1, 0},      {2, 1, 0},      {1.2, 1, 0},
          {1, -0.5, 0},    {0.4, -0.4, 0},  {0.2, 1.2, 0},  {-0.5, 1.1, 0},
          {-0.6, -0.3, 0}, {-1.1, -0.4, 0}, {-1.3, 0.9, 0}, {-2, 0.8, 0}};
}

/// Each in its own frame, so that `frame` says where.
inline std::vector<FaceInput> faces_of_all_kinds() {
  const Frame flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<FaceInput> faces;
  for (std::vector<Vec3d> corners :
       {std::vector<Vec3d>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
        std::vector<Vec3d>{{-1, -1, 0}, {1.2, -1, 0}, {1.6, 0.4, 0}, {0, 1.5, 0}, {-1.3, 0.8, 0}},
        corners_on_ellipse(1.3, 0.4, 3), corners_on_ellipse(0.9, 1.1, 64), star(1.5, 0.4),
        letter_l(), comb()})
    faces.push_back(polygon_input(std::move(corners)));
  faces.push_back(ellipse_input(flat, 1.2, 1.2));
  faces.push_back(ellipse_input(flat, 1.2, 0.8));
  faces.push_back(ellipse_input(flat, 0.5, 1.5));
  faces.push_back(ellipse_input(flat, 2.0, 0.05));
  return faces;
}

/// What the pair's face must be, in `frame`.
inline FaceInput partner_in(const FaceInput& face, const Frame& frame) {
  if (face.vertices.empty()) return ellipse_input(frame, face.radii[0], face.radii[1]);
  const std::vector<Vec3d> corners = face.local_vertices();
  std::vector<Vec3d> partner;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3d& corner = corners[(corners.size() + 1 - i) % corners.size()];
    partner.push_back(frame.to_world({-corner.x, corner.y, 0.0}));
  }
  return polygon_input(std::move(partner));
}

/// The same face in another frame.
inline FaceInput face_in(const FaceInput& face, const Frame& frame) {
  if (face.vertices.empty()) return ellipse_input(frame, face.radii[0], face.radii[1]);
  std::vector<Vec3d> vertices;
  for (const Vec3d& corner : face.local_vertices())
    vertices.push_back(frame.to_world({corner.x, corner.y, 0.0}));
  return polygon_input(std::move(vertices));
}

/// A pair with that face, in those frames.
inline std::vector<Portal> pair_with(const FaceInput& face, const Frame& a, const Frame& b) {
  std::vector<Portal> portals(2);
  give_face(portals[0], face_in(face, a));
  give_face(portals[1], partner_in(face, b));
  for (std::uint32_t i = 0; i < 2; ++i) {
    portals[i].name = i == 0 ? "a" : "b";
    portals[i].pair = 1 - i;
    portals[i].passage = RigidPassage(motion_through(portals[i].frame, portals[1 - i].frame));
  }
  return portals;
}

}  // namespace portalens::test
