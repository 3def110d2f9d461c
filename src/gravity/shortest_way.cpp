#include "gravity/shortest_way.h"

#include <limits>

#include "gravity/rim_ways.h"
#include "gravity/way_search.h"

namespace portalens {

namespace {

/// One face: straight, or the best of its edges.
bool shortest_by_one(Vec3d from, Vec3d to, const PortalFace& face, double limit, Turn& out) {
  const Vec3d a = face.frame().to_local(from), b = face.frame().to_local(to);
  if (straight_through(face, a, b) >= 0.0) {
    out = straight_on;
    const Vec3d apart = b - a;
    return dot(apart, apart) < limit * limit;
  }
  double best = limit;
  bool found = false;
  for (std::uint32_t i = 0; i < rim_pieces(face); ++i) {
    const RimWay<double> way = over_piece(face, i, a, b);
    const Turn turn = rim_turn(face, i, way.place);
    const bool between_insides =
        found && turn.kind == Turn::Kind::edge && out.kind == Turn::Kind::edge;
    if (!(way.length < best * (between_insides ? 1.0 - length_tie : 1.0))) continue;
    best = way.length;
    out = turn;
    found = true;
  }
  return found;
}

}  // namespace

bool shortest_passages(Vec3d from, Vec3d to, FaceRow faces, double limit, Turns& out) {
  if (faces.size() == 1) return shortest_by_one(from, to, *faces[0], limit, out[0]);
  return search_passages(from, to, faces, limit, out);
}

Polyline bends(Vec3d from, Vec3d to, FaceRow faces, const Turns& turns) {
  Polyline way;
  way.from = from;
  way.to = to;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (turns[i].kind == Turn::Kind::straight) continue;
    if (const Ellipse* ellipse = faces[i]->ellipse()) {
      way.slides[way.count] = slide_on(*ellipse, faces[i]->frame());
      way.places[way.count++] = turns[i].angle;
      continue;
    }
    const FaceEdge& edge = faces[i]->edges()[turns[i].index];
    const bool fixed = turns[i].kind == Turn::Kind::vertex;
    way.slides[way.count] = {edge.start, edge.direction, fixed ? 0.0 : -infinity,
                             fixed ? 0.0 : infinity};
    way.places[way.count] = fixed ? 0.0 : 0.5 * edge.length;
    ++way.count;
  }
  shorten(way, infinity);
  return way;
}

Way follow(Vec3d from, Vec3d to, FaceRow faces, const Turns& turns) {
  const Polyline way = bends(from, to, faces, turns);
  return {way.total(), way.count > 0 ? way.point(0) : to, way.count == 0};
}

}  // namespace portalens
