"""The lists of types that CONTRIBUTING.md names, and a newcomer to each, as small as the list's
contract allows. tools/try_newcomers.py builds a program with all of them."""

import dataclasses
import re


@dataclasses.dataclass
class List:
    """A list of types, and a newcomer to it."""

    header: str  # the list's own, in src/
    variant: str  # its name
    newcomer: str  # the type; its header is newcomer_<kind>.h beside the list's
    body: str  # the newcomer's header, from its includes on
    physics: str = ""  # lines of the scene, by table
    material: str = ""
    tables: str = ""  # whole tables of the scene
    told: tuple = ()  # what `check --json` then says: keys, the last one's value or an item of it
    refused: tuple = ()  # what --set makes `check` refuse the scene, and a word of the message
    first: bool = False  # whether its word is the list's first: where the first that fits is taken

    @property
    def include(self):
        name = re.sub(r"(?<!^)([A-Z])", r"_\1", self.newcomer).lower()
        return f"{self.header.rsplit('/', 1)[0]}/{name}.h"


LISTS = [
    List(
        header="geometry/shape.h",
        variant="Shape",
        newcomer="NewcomerShape",
        body="""
#include "geometry/sphere.h"
namespace portalens {
class NewcomerShape {
 public:
  static constexpr std::string_view name = "newcomer_shape";
  static NewcomerShape from(Parameters& p) { return NewcomerShape(Sphere::from(p)); }
  explicit NewcomerShape(Sphere sphere) : sphere_(sphere) {}
  Box bounds() const { return sphere_.bounds(); }
  std::optional<Contact> intersect(const Ray& ray, double low, double high) const {
    return sphere_.intersect(ray, low, high);
  }
  SurfacePoint surface_at(Vec3d x, std::uint32_t face) const { return sphere_.surface_at(x, face); }
  double clearance(const Segment& segment) const { return sphere_.clearance(segment); }
  Vec3d center_of_mass() const { return sphere_.center_of_mass(); }
  double area() const { return sphere_.area(); }
  SurfacePoint sample(double u1, double u2) const { return sphere_.sample(u1, u2); }
  std::vector<FlatFace> flat_faces() const { return {}; }
 private:
  Sphere sphere_;
};
}
""",
        tables='[[newcomer_shape]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = "new"\n',
        told=("objects", "kind", "newcomer_shape"),
    ),
    List(
        header="portal/aperture.h",
        variant="Aperture",
        newcomer="NewcomerAperture",
        first=True,  # else its polygons are taken for convex ones
        body="""
#include <optional>
#include <string_view>
#include <utility>
#include <vector>
#include "portal/convex_polygon.h"
namespace portalens {
class NewcomerAperture : public ConvexPolygon {
 public:
  static constexpr std::string_view name = "newcomer_aperture";
  NewcomerAperture() = default;
  explicit NewcomerAperture(ConvexPolygon polygon) : ConvexPolygon(std::move(polygon)) {}
  static std::optional<NewcomerAperture> from(const FaceInput& input) {
    const auto polygon = ConvexPolygon::from(input);
    if (!polygon || input.vertices.size() % 2 == 0) return std::nullopt;
    return NewcomerAperture(*polygon);
  }
  NewcomerAperture carried(std::vector<Vec3d> corners) const {
    return NewcomerAperture(ConvexPolygon(std::move(corners)));
  }
};
}
""",
        tables='[[portal]]\nname = "c"\npair = "d"\nvertices = [[-2, 2, -2], [0, 2, -2], [-1, 3, -2]]\n'
        '[[portal]]\nname = "d"\npair = "c"\nvertices = [[1, 2, -4], [3, 2, -4], [2, 3, -4]]\n',
        told=("portals", "face", "newcomer_aperture"),
    ),
    List(
        header="portal/passage.h",
        variant="Passage",
        newcomer="NewcomerPassage",
        first=True,  # the last takes every pair
        body="""
#include <optional>
#include <string_view>
#include "portal/rigid_passage.h"
namespace portalens {
class NewcomerPassage {
 public:
  static constexpr std::string_view name = "newcomer_passage";
  static std::optional<NewcomerPassage> between(const PassageInput& input) {
    if (input.from.vertices.size() != 3) return std::nullopt;
    NewcomerPassage made;
    made.rigid_ = *RigidPassage::between(input);
    return made;
  }
  Passed pass(Vec3d position, Vec3d direction) const { return rigid_.pass(position, direction); }
  const Rigid* motion() const { return nullptr; }
 private:
  RigidPassage rigid_;
};
}
""",
        refused=("physics.portal_gravity=closest-point", "newcomer_passage"),
    ),
    List(
        header="shading/bsdf.h",
        variant="Bsdf",
        newcomer="NewcomerBsdf",
        body="""
#include "core/parameters.h"
#include "shading/bsdf_sample.h"
#include "shading/texture.h"
namespace portalens {
class NewcomerBsdf {
 public:
  static constexpr std::string_view name = "newcomer_bsdf";
  static NewcomerBsdf from(Parameters& p, const ImageLoader& load) {
    NewcomerBsdf made;
    made.color_ = texture_from(p, "base_color", Constant{}, load);
    return made;
  }
  std::vector<const Texture*> textures() const { return {&color_}; }
  Rgb max_reflected() const { return brightest(color_); }
  Rgb color() const { return max_reflected(); }
  bool answers() const { return true; }
  bool sends() const { return false; }
  struct Here {
    Rgb color;
    Rgb albedo(Vec3d, Vec3d) const { return color; }
    Rgb value(Vec3d, Vec3d, Vec3d) const { return color; }
    std::optional<BsdfSample> sample(Vec3d, Vec3d, double, double) const { return {}; }
  };
  Here at(const SurfacePoint& point) const { return {color_at(color_, point)}; }
 private:
  Texture color_ = Constant{};
};
}
""",
        material='type = "newcomer_bsdf"\nbase_color = [0.2, 0.4, 0.6]\n',
    ),
    List(
        header="shading/light.h",
        variant="Light",
        newcomer="NewcomerLight",
        body="""
#include <numbers>
#include "core/parameters.h"
#include "shading/light_sample.h"
namespace portalens {
struct NewcomerLight {
  static constexpr std::string_view name = "newcomer_light";
  static constexpr bool is_delta = true;
  Vec3d position;
  Rgb intensity;
  static NewcomerLight from(Parameters& p) {
    return {to_vec3(p.triple("position")), to_vec3(p.triple("intensity"))};
  }
  LightSample sample(Vec3d x, double, double) const {
    return {position, intensity / dot(position - x, position - x)};
  }
  Rgb power() const { return intensity * (4.0 * std::numbers::pi); }
};
}
""",
        tables='[[light]]\nname = "lamp"\ntype = "newcomer_light"\nposition = [3, 5, 4]\n'
        "intensity = [50, 50, 50]\n",
        told=("lights", "lamp"),
    ),
    List(
        header="gravity/coupling.h",
        variant="Coupling",
        newcomer="NewcomerCoupling",
        body="""
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>
#include "gravity/coupling_input.h"
namespace portalens {
struct NewcomerCoupling {
  static constexpr std::string_view name = "newcomer_coupling";
  static constexpr bool asks_motion = false;
  std::vector<Vec3d> centers;
  double gm = 0.0, reach = 0.0;
  explicit NewcomerCoupling(const CouplingInput& input) {
    if (input.depth == 0) return;
    for (const Mass& mass : input.masses) gm += mass.gm;
    for (const Portal& portal : input.portals) centers.push_back(portal.frame.origin);
    reach = influence_radius(gm, input.min_force);
  }
  static CouplingCost cost(const CouplingInput& input) {
    return {static_cast<double>(input.portals.size()), 0.0};
  }
  bool acts(std::size_t i, Vec3d x) const { return length(centers[i] - x) < reach; }
  Pull pull(Vec3d x, Vec3d anchor) const {
    Pull total;
    for (std::size_t i = 0; i < centers.size(); ++i) {
      const double d = length(centers[i] - x);
      if (!acts(i, anchor) || d == 0.0) continue;
      total.acceleration += (centers[i] - x) * (gm / (d * d * d));
      total.stiffness += gm / std::pow(d, 5.0);
      total.nearness += 1.0 / std::pow(d, 4.0);
      total.gradient += 2.0 * gm / (d * d * d);
      total.potential += gm / d;
    }
    return total;
  }
  std::uint64_t signature(Vec3d x) const {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < centers.size(); ++i)
      if (acts(i, x)) bits |= std::uint64_t{1} << i % 64;
    return bits;
  }
  std::vector<PullPart> parts(Vec3d x) const {
    std::vector<PullPart> found;
    for (std::size_t i = 0; i < centers.size(); ++i) {
      const double d = length(centers[i] - x);
      if (!acts(i, x) || d == 0.0) continue;
      PullPart part;
      part.portals = {static_cast<std::uint32_t>(i)};
      part.acceleration = (centers[i] - x) * (gm / (d * d * d));
      part.entrance = part.beyond = centers[i];
      part.places = {centers[i]};
      part.distance = d;
      found.push_back(part);
    }
    return found;
  }
  double distance_to_support(Vec3d x) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3d& center : centers)
      least = std::min(least, std::max(0.0, length(center - x) - reach));
    return least;
  }
};
}
""",
        physics='portal_gravity = "newcomer_coupling"\n',
        told=("physics", "portal_gravity", "newcomer_coupling"),
    ),
    List(
        header="gravity/law.h",
        variant="Law",
        newcomer="NewcomerLaw",
        body="""
#include <cmath>
#include <string_view>
namespace portalens {
struct NewcomerLaw {
  static constexpr std::string_view name = "newcomer_law";
  static constexpr bool uniform = false;
  static constexpr bool bare_masses = true;
  template <class Real>
  static Real weight(Real w) { return Real(1.0) + w; }
  template <class Real>
  static Real weight_slope(Real) { return Real(1.0); }
  static double log_index(double w) { return w + 0.5 * w * w; }
  static double clock(double w) { return std::exp(-w); }
  static double horizon_radius(double m, double) { return 2.0 * m; }
};
}
""",
        physics='law = "newcomer_law"\n',
        told=("physics", "law", "newcomer_law"),
    ),
    List(
        header="photon/integrator.h",
        variant="Integrator",
        newcomer="NewcomerIntegrator",
        body="""
#include "photon/rk4.h"
namespace portalens {
struct NewcomerIntegrator {
  static constexpr std::string_view name = "newcomer_integrator";
  static constexpr bool fixed_step = true;
  static constexpr bool straight_pieces = false;
  double length;
  static NewcomerIntegrator from(const IntegratorSettings& settings) { return {settings.step}; }
  template <class Acceleration>
  static StepResult<double> step(const Acceleration& acceleration, State state, Vec3d start,
                                 double h) {
    return Rk4::step(acceleration, state, start, h);
  }
};
}
""",
        physics='integrator = "newcomer_integrator"\nstep = 0.1\n',
        told=("physics", "integrator", "newcomer_integrator"),
    ),
]
