#include "photon/obstacles.h"

#include <cmath>

namespace portalens {

std::optional<Encounter> Obstacles::first(const Ray& ray, double high,
                                          const PathStart& start) const {
  std::optional<Encounter> found;
  if (const auto portal = portals_.nearest(ray, 0.0, high, start.entered, start.entered_reach)) {
    found = Encounter{portal->distance,
                      portal->side == PortalSide::front ? Encounter::Kind::portal_front
                                                        : Encounter::Kind::portal_back,
                      portal->portal, 0};
    // At a tie the portal comes first, though rounding may put the surface it hangs on before it.
    const double tie = portals_.portals()[portal->portal].height_tolerance();
    high = portal->distance -
           tie / std::fmax(1e-6, std::fabs(dot(ray.direction,
                                               portals_.portals()[portal->portal].frame.normal)));
  }
  if (const auto hit = surfaces_.nearest(ray, start.skip_surfaces, high, start.departure))
    found = Encounter{hit->distance, Encounter::Kind::surface, hit->shape, hit->face};
  return found;
}

std::optional<Encounter> Obstacles::first(const Curve& curve, double free, double flatness,
                                          const PathStart& start) const {
  // A little less than that far: something may lie there.
  const double from = 0.99 * free, end = curve.length();
  return in_piece(curve, {from, end, curve.position(from), curve.position(end)}, flatness, start);
}

std::optional<Encounter> Obstacles::in_piece(const Curve& curve, const Piece& piece,
                                             double flatness, const PathStart& start) const {
  const double sagitta = curve.sagitta(piece.s1 - piece.s0);
  const Segment chord{piece.x0, piece.x1};
  const Vec3d along = piece.x1 - piece.x0;
  const double chord_length = length(along);
  if (!(chord_length > 0.0)) return std::nullopt;
  // Halving ends where rounding makes it pointless, whatever was asked; and what the chord crosses
  // may seem to be as far off.
  const double finest = 1e-13 * (length(piece.x0) + chord_length);
  const double close = std::fmax(sagitta, finest);
  const bool flat = sagitta <= std::fmax(flatness, finest);
  // To ask what is met is as cheap as whether anything is near.
  if (!flat && !surfaces_.near(chord, close) && !portals_.near(chord, close)) return std::nullopt;

  if (flat) {
    const auto found =
        first(Ray{piece.x0, along / chord_length}, chord_length, start.after(piece.s0));
    if (!found || sagitta <= finest) {
      if (!found) return std::nullopt;
      Encounter at = *found;
      at.distance = piece.s0 + found->distance / chord_length * (piece.s1 - piece.s0);
      return at;
    }
    if (const auto refined = refine(curve, piece, *found)) return refined;
  }

  const double middle = 0.5 * (piece.s0 + piece.s1);
  const Vec3d x = curve.position(middle);
  if (const auto found = in_piece(curve, {piece.s0, middle, piece.x0, x}, flatness, start))
    return found;
  return in_piece(curve, {middle, piece.s1, x, piece.x1}, flatness, start);
}

/// Newton's method: the tangent of the curve, met with the surface, gives the next guess.
std::optional<Encounter> Obstacles::refine(const Curve& curve, const Piece& piece,
                                           Encounter found) const {
  const double span = piece.s1 - piece.s0;
  const double chord = length(piece.x1 - piece.x0);
  double s = piece.s0 + found.distance / chord * span;
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
    if (s < piece.s0 - 0.1 * span || s > piece.s1 + 0.1 * span) return std::nullopt;
    if (std::fabs(*ahead) <= 1e-14 * (1.0 + s + length(tangent.origin))) {
      found.distance = std::fmin(std::fmax(s, 0.0), curve.length());
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace portalens
