/// \file
/// A scene as the lanes see it: plain floats about the scene's centre, nothing that allocates.
///
/// Engine files of several instruction sets share these types, so they have no functions that a
/// compiler could emit in more than one of them.
#pragma once

#include <cstdint>

#include "gravity/crossing_formulas.h"

namespace portalens {

struct LaneVec {
  float x, y, z;
};

/// A mass, or a portal that acts as one.
struct LaneMass {
  LaneVec center;
  float gm;  ///< G M / c², times the weight of a uniform law; length
  float core2;
  float influence;
  float influence2;
  float horizon;  ///< r_s, or -1 without a horizon
  float horizon2;
  /// Nearer than the square root of that light winds ever closer round a mass that has no horizon,
  /// and soon closer than floats can follow.
  float bare2;
};

/// Paths of more steps are left to the scalar engine: light winds there closer than floats can
/// follow.
inline constexpr int max_lane_steps = 512;
/// How strictly the steps of a path are judged: they may err by so much less, and are shorter from
/// the start by the seventh root of that. A path that drifts is taken again more strictly. Of
/// shorter steps most drift is rounding, which has either sign and is counted ten times: it may be
/// more.
struct LaneStrictness {
  float judged, shorter, drifts;
};
inline constexpr LaneStrictness lane_strictness[] = {
    {1.0f, 1.0f, 1.0f}, {30.0f, 0.615f, 2.0f}, {900.0f, 0.378f, 6.0f}};
inline constexpr int max_lane_strictness = 2;
inline constexpr int lane_count = 32;  ///< as many as `LaneStep` has bits

inline constexpr int max_lane_masses = 8;
/// Those that are crossed by table, besides.
inline constexpr int max_lane_isolated_masses = 128;
inline constexpr int max_lane_gates = 32;
inline constexpr int max_lane_portals = 32;
/// Of a portal.
inline constexpr int max_lane_edges = 64;
inline constexpr int max_lane_polygons = 192;
inline constexpr int max_lane_spheres = 192;
inline constexpr int max_lane_boxes = 96;

inline constexpr int max_lane_many = 65536;
/// Of many masses, those that act on any lane of a pack.
inline constexpr int max_lane_near = 2048;
/// Where there are more masses, lanes on which more than that act are left to the scalar engine.
inline constexpr int max_lane_own = 63;

/// More masses than `max_lane_masses`, and where they act or absorb: a grid of cubes, each with
/// the balls that meet it.
struct LaneManyMasses {
  int count;  ///< of the masses; 0 where `LaneScene::masses` holds all
  const LaneMass* masses;
  int cells_x, cells_y, cells_z;
  LaneVec low;
  float size, per_size;         ///< of a cube, and 1 over that
  const std::uint32_t* begins;  ///< of each cube's balls, x fastest, then y; and one end more
  /// The balls, cube by cube: the middle, the square of the radius (of the influence, or of a
  /// larger horizon), and which mass it is. There are `lane_count` more that count for nothing.
  const float *x, *y, *z, *reach2;
  const std::uint32_t* which;
};

/// A mass that is alone in its influence.
struct LaneIsolated {
  LaneVec center;
  float influence, influence2;
  float horizon;  ///< r_s
  CrossingRange<float> range;
  const float* cells;  ///< of its `CrossingTable`
};

/// An edge of a polygon in coordinates of its plane; counter-clockwise, so that the outside
/// is to the right of its direction.
struct LaneEdge {
  float along_x, along_y;  ///< its direction, a unit vector
  float begin, length;     ///< where it starts along its direction, seen from the origin
  float out;               ///< how far its line lies from the origin, towards the outside
  float start_y, end_y;    ///< of its ends, to the bit as its neighbours have them
  float reentrant;         ///< 1 where the corner that it begins with is, else 0
};

/// The rim of a portal that need not be a rectangle: edges, or an ellipse about the origin.
struct LaneOutline {
  enum class Kind : std::int32_t { convex, simple, ellipse };
  Kind kind;
  int count;
  float longest;             ///< of the edges
  float radius_x, radius_y;  ///< of an ellipse,
  float per_x, per_y;        ///< and 1 over them
  LaneEdge edges[max_lane_edges];
};

/// One way through a portal in the recursion of `closest-point`: a polygon in its own plane, and
/// the masses as they are seen through it. Local coordinates are (right, up, normal) of the
/// rectangle, from its middle.
struct LaneGate {
  int parent;                         ///< -1: entered from the photon's own place
  LaneVec origin, right, up, normal;  ///< only of a gate without a parent
  // With a parent: local = offset + (q of the parent).x by_x + (q of the parent).y by_y.
  LaneVec offset, by_x, by_y;
  // With a parent: rotates an acceleration from this gate's local axes to its parent's (columns).
  LaneVec to_parent_x, to_parent_y, to_parent_z;
  float half_width, half_height;  ///< of a rectangle
  const LaneOutline* outline;     ///< null where all portals are rectangles
  float tolerance;                ///< heights down to minus this count as in front
  float reach, reach2;
  float ball;  ///< radius of a ball about the middle out of which it does not act
  LaneVec images[max_lane_masses];  ///< of the masses, in local coordinates
  /// Nearer to an image than the square root of that, light is left to the scalar engine: as
  /// `LaneMass::bare2`, for no horizon acts through portals.
  float bare2[max_lane_masses];
  /// Whether the influence of a mass ends somewhere on the polygon; and with a parent, whether
  /// places on that one's are further from it than the reach.
  bool fades[max_lane_masses], falls_short;
};

/// A portal's face, about its frame's origin; members as of a `LaneGate`.
struct LaneFace {
  LaneVec origin, right, up, normal;
  float half_width, half_height;
  const LaneOutline* outline;
  float tolerance;
  float reach, reach2;
  float ball;
};

/// One mass of `shortest-path` through one portal. Local coordinates are those of its face.
struct LaneWay {
  LaneVec image;  ///< where the mass seems to be
  float gm, core2, influence;
  float bare2;  ///< as of a `LaneGate`
  /// Of the image from the lines of the rim: below (y = -h), right (x = w), above, left.
  float off[4];
};
inline constexpr int max_lane_ways = 16;

/// The ways through one portal.
struct LaneEntrance {
  LaneFace face;
  int first, end;  ///< of its paths
};

/// One portal's grid of a `graviton-map`.
struct LaneMap {
  LaneFace face;
  float low_x, low_y, spacing_x, spacing_y;
  float per_x, per_y;    ///< 1 / spacing
  float last_i, last_j;  ///< of the cells
  int row;               ///< nodes in one
  /// Where cells are nearer to masses than that, light is left to the scalar engine: as `bare2` of
  /// a `LaneGate`.
  float max_nearness;
  /// Four for each node: the acceleration over c², and the stiffness over c².
  const float* nodes;
  /// Three for the cell to the upper right of each node: the nearness, how many cells further on
  /// steps must end (`to_sharp`), and the gradient over c².
  const float* cells;
};

/// A portal's front, for crossing it.
struct LanePortal {
  LaneVec origin, right, up, normal;
  float half_width, half_height;  ///< of what holds it, about its origin
  const LaneOutline* outline;     ///< null if it is a rectangle
  float tolerance;                ///< heights down to minus this count as in front
  float back;                     ///< 1 if light that comes from behind meets it, else 0
  float leaves;                   ///< what `departed` says of lanes that have left its plane,
  float facing;  ///< and 1 where its normal is that plane's, -1 where it is opposite
};

/// A convex polygon of 3 or 4 edges: a point of its plane lies inside where all edges say so.
struct LanePolygon {
  LaneVec normal;
  float distance;  ///< normal · x on the plane
  LaneVec middle;  ///< and radius of a ball that holds it
  float radius;
  LaneVec edge_normal[4];  ///< in the plane, inwards; a triangle repeats one
  float edge_distance[4];
  int shape;
  float leaves, facing;  ///< as of a portal
};

struct LaneSphere {
  LaneVec center;
  float radius;
  int shape;
};

/// Whether a path meets what is inside is looked at in double.
struct LaneBox {
  LaneVec low, high;
  bool narrow;  ///< floats can't even tell on which side of what is inside they are: the scalar
                ///< engine takes the steps in there
};

struct LaneScene {
  int law;            ///< index of the scene's law in `Law`
  bool fading;        ///< some gate has a mass that fades, or falls short
  bool bare_through;  ///< some gate or path has a `bare2`
  int mass_count, gate_count, map_count, entrance_count, way_count, portal_count, outline_count,
      polygon_count, sphere_count, box_count, isolated_count;
  float stiffness_weight, nearness_weight;  ///< of the step, see Radau
  float third_weight, feedback_weight;      ///< of the step's roughness, see Radau
  float tolerance;                          ///< of the scene's physics, radians
  float ahead;      ///< the place that decides what acts lies this far ahead
  float overshoot;  ///< a step ends this far past a boundary
  float farthest;   ///< no step in the field is longer
  float graze2;     ///< square of half a chord: who grazes an isolated mass by less is not turned
  float radius;     ///< all there is lies in a ball of that about the centre
  float flight_limit;  ///< floats are too coarse for a flight that begins further out
  float max_length, max_turning, max_steps;
  LaneMass masses[max_lane_masses];
  LaneManyMasses many;  ///< then `masses` are none
  LaneGate gates[max_lane_gates];
  LaneMap maps[max_lane_portals];
  LaneEntrance entrances[max_lane_portals];
  LaneWay ways[max_lane_ways];
  LanePortal portals[max_lane_portals];
  bool all_convex;  ///< all outlines are polygons, and convex
  bool any_round;   ///< some outline is an ellipse, and gates act through it
  /// One for each portal, then one for each back of a two-sided one; or none where all are
  /// rectangles.
  LaneOutline outlines[2 * max_lane_portals];
  LanePolygon polygons[max_lane_polygons];
  LaneSphere spheres[max_lane_spheres];
  LaneBox boxes[max_lane_boxes];
  LaneIsolated isolated[max_lane_isolated_masses];
};

inline constexpr int first_isolated_object = max_lane_masses;
inline constexpr int first_many_object = first_isolated_object + max_lane_isolated_masses;
/// In `Lanes::departed` planes in which a portal or several faces lie count downwards from this.
inline constexpr int first_departed_plane = -2;

/// What a lane's step ended in.
enum class LaneEvent : std::int32_t {
  none,     ///< goes on
  escape,   ///< nothing acts here and nothing lies ahead (the step was not taken)
  hit,      ///< a surface: `object` is the polygon's or sphere's shape
  portal,   ///< a portal's front or back: `object` is the portal
  horizon,  ///< `object` is the mass; from `first_isolated_object` an isolated one, from
            ///< `first_many_object` one of `many`
  cross,    ///< crossed the influence of an isolated mass and goes on: `object` as for `horizon`
  consult,  ///< something may be near that lanes can't judge (the step was not taken)
  resign,   ///< this way is not followed to the tolerance: it is taken again from its start
  limit,    ///< too many steps, too long, turned too far, or no number any more
};

/// The path of the last step, where it may meet what boxes hold: a polynomial in the share of the
/// step, x(u) = Σ c[k] uᵏ.
struct alignas(64) LaneSeen {
  float share[lane_count];  ///< up to that share; 0 where there is nothing to look at
  float cx[6][lane_count], cy[6][lane_count], cz[6][lane_count];
  float h[lane_count];      ///< its whole length,
  float bend[lane_count];   ///< and how sharply it bends at the most, 1/length
  float rough[lane_count];  ///< 1 where within the step it is not as exact as at its end
  float length[lane_count], turning[lane_count];  ///< of the path before the step
};

/// The state of all lanes, array by array. A lane that is not `live` holds something harmless.
struct alignas(64) Lanes {
  float x[lane_count], y[lane_count], z[lane_count];
  float tx[lane_count], ty[lane_count], tz[lane_count];
  float length[lane_count], turning[lane_count], steps[lane_count];
  float longest[lane_count];  ///< of the next step: what the error of the last allows
  float judged[lane_count];   ///< its `LaneStrictness`
  float shorter[lane_count];
  float astray[lane_count];         ///< its `Drift`: of its place,
  float askew[lane_count];          ///< and of its direction
  float live[lane_count];           ///< 1 or 0
  float departed[lane_count];       ///< shape that the photon leaves, or -1; or a plane
  float departed_side[lane_count];  ///< on which side it leaves it: 1 or -1
  float clear[lane_count];          ///< nothing that boxes hold is met within that much path
  float event[lane_count];          ///< a LaneEvent
  float object[lane_count];
  LaneSeen seen;
};

/// Takes one step of every live lane, or finds that it ends in an event. Where the event says that
/// the step was not taken, the lane stays where it was. Returns bit i for lane i where there is
/// one, or where its path is `seen`.
using LaneStep = std::uint32_t (*)(const LaneScene& scene, Lanes& lanes);

}  // namespace portalens
