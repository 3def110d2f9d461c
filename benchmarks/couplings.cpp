// What does gravity through portals cost, how far is each fast path from what it stands for, and
// how much work does each way do on a closed lap? Costs are ratios to one pull of one mass, timed
// in the same run; each coupling is checked before it is timed.
//
//     bench_couplings [--json | --markdown]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "gravity/attraction.h"
#include "gravity/coupling.h"
#include "math/random.h"
#include "support/clock.h"
#include "support/command.h"

namespace portalens::benchmarks {
namespace {

struct Stage {
  std::vector<Portal> portals;
  std::vector<Mass> masses;
  double min_force = 0.01;

  [[nodiscard]] CouplingInput input(int depth) const {
    return {portals, masses, min_force, depth, 32};
  }
};

/// A rectangle of half-sides w and h, in its own frame.
Portal rectangle(const Frame& frame, double w, double h) {
  Portal portal;
  give_face(portal, polygon_input({frame.to_world({-w, -h, 0}), frame.to_world({w, -h, 0}),
                                   frame.to_world({w, h, 0}), frame.to_world({-w, h, 0})}));
  return portal;
}

void add_pair(Stage& stage, Portal a, Portal b) {
  const auto first = static_cast<std::uint32_t>(stage.portals.size());
  a.pair = first + 1;
  b.pair = first;
  a.passage = RigidPassage(motion_through(a.frame, b.frame));
  b.passage = RigidPassage(motion_through(b.frame, a.frame));
  stage.portals.push_back(std::move(a));
  stage.portals.push_back(std::move(b));
}

void add_mass(Stage& stage, Vec3d center, double gm) {
  Mass mass;
  mass.center = center;
  mass.gm = gm;
  mass.influence = influence_radius(gm, stage.min_force);
  stage.masses.push_back(mass);
}

/// As in the paper's figure 7: a pair of upright portals and one heavy mass, in front of one.
Stage figure_7() {
  Stage stage;
  stage.min_force = 1.0;
  add_pair(stage, rectangle({{-3, 1.5, 0}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, 1.0, 1.5),
           rectangle({{4, 1.5, -3}, {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, 1.0, 1.5));
  add_mass(stage, {4.3, 1.8, -4.2}, 60.0);
  return stage;
}

/// A floor that leads to the ceiling above it, and a mass below.
constexpr double corridor_height = 3.0;
Stage corridor() {
  Stage stage;
  add_pair(stage, rectangle({{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 1.0, 1.0),
           rectangle({{0, corridor_height, 0}, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, 1.0, 1.0));
  add_mass(stage, {0, -1, 0}, 1.0);
  return stage;
}

Vec3d direct(const Stage& stage, Vec3d x) {
  Vec3d sum;
  for (const Mass& mass : stage.masses) {
    const Vec3d to = mass.center - x;
    if (dot(to, to) < mass.influence * mass.influence) sum += attraction(to, mass.gm, 0.0);
  }
  return sum;
}

std::vector<Vec3d> places(int count) {
  std::vector<Vec3d> result;
  for (int i = 0; i < count; ++i) {
    const auto key = static_cast<std::uint64_t>(i);
    result.push_back({-6.0 + 11.0 * random_number(key, 0), 4.0 * random_number(key, 1),
                      -5.0 + 10.0 * random_number(key, 2)});
  }
  return result;
}

/// Root mean square of the difference of two couplings over that of the second.
template <class A, class B>
double difference(const A& a, const B& b, const std::vector<Vec3d>& at) {
  double apart = 0.0, size = 0.0;
  for (const Vec3d& x : at) {
    const Vec3d exact = b.pull(x, x).acceleration;
    const Vec3d d = a.pull(x, x).acceleration - exact;
    apart += dot(d, d);
    size += dot(exact, exact);
  }
  return std::sqrt(apart / size);
}

/// The definition of closest-point at depth 1, for rectangles.
struct PlainClosestPoint {
  const Stage& stage;

  [[nodiscard]] Pull pull(Vec3d x, Vec3d) const {
    Pull sum;
    for (const Portal& portal : stage.portals) {
      const Vec3d corner = portal.frame.to_local(portal.vertices[2]);
      const Vec3d local = portal.frame.to_local(x);
      Vec3d q{std::clamp(local.x, -corner.x, corner.x), std::clamp(local.y, -corner.y, corner.y),
              0.0};
      const double to_x = corner.x - std::fabs(q.x), to_y = corner.y - std::fabs(q.y);
      if (local.z < 0.0 && to_x > 0.0 && to_y > 0.0) {
        if (to_x < to_y)
          q.x = std::copysign(corner.x, q.x);
        else
          q.y = std::copysign(corner.y, q.y);
      }
      double reach = 0.0;
      for (const Mass& mass : stage.masses) {
        const Portal& pair = stage.portals[portal.pair];
        const Vec3d m = pair.frame.to_local(mass.center);
        const double dx = std::max(0.0, std::fabs(m.x) - corner.x);
        const double dy = std::max(0.0, std::fabs(m.y) - corner.y);
        reach = std::max(reach, mass.influence - std::sqrt(dx * dx + dy * dy + m.z * m.z));
      }
      if (!(length(local - q) < reach)) continue;
      const Vec3d beyond = portal.motion()->move(portal.frame.to_world(q));
      sum.acceleration += portal.motion()->rotate_back(direct(stage, beyond));
    }
    return sum;
  }
};

/// G M / D differentiated by central differences.
struct DifferencedPotential {
  const ShortestPathCoupling& coupling;

  [[nodiscard]] double potential(Vec3d x) const {
    double sum = 0.0;
    for (const auto& image : coupling.images()) sum += image.gm / coupling.way(image, x).length;
    return sum;
  }
  [[nodiscard]] Pull pull(Vec3d x, Vec3d) const {
    constexpr double h = 1e-4;
    const auto along = [&](Vec3d step) {
      return (potential(x + step) - potential(x - step)) / (2.0 * h);
    };
    return {{along({h, 0, 0}), along({0, h, 0}), along({0, 0, h})}, 0.0, 0.0};
  }
};

/// What a coupling was checked against, and how far it was from it.
struct Verdict {
  std::string against = "nothing";
  double error = 0.0;
  double allowed = 0.0;
};

Verdict check(const NoCoupling&, const Stage&, int, const std::vector<Vec3d>&) { return {}; }

Verdict check(const ClosestPointCoupling& coupling, const Stage& stage, int depth,
              const std::vector<Vec3d>& at) {
  if (depth == 1)
    return {"its definition", difference(coupling, PlainClosestPoint{stage}, at), 1e-12};
  // At more depth, by one step of the recursion out of what one portal passes on.
  const ClosestPointCoupling shallow(stage.input(depth - 1));
  double worst = 0.0;
  for (std::uint32_t a = 0; a < stage.portals.size(); ++a) {
    const Vec3d q = stage.portals[a].frame.to_world({0.3, -0.2, 0.0});
    const Vec3d beyond = stage.portals[a].motion()->move(q);
    Vec3d expected = direct(stage, beyond);
    for (std::uint32_t c = 0; c < stage.portals.size(); ++c) {
      if (c == stage.portals[a].pair) continue;
      const PortalFace& face = shallow.face(c);
      const Vec3d local = face.frame().to_local(beyond);
      const Vec3d place = face.place(face.nearest(local), local);
      if (!(length(local - place) < shallow.reach(c))) continue;
      const Vec3d next = face.frame().to_world(place);
      expected += shallow.passed_on(c, next, next).acceleration;
    }
    const Vec3d found = stage.portals[a].motion()->rotate(coupling.passed_on(a, q, q).acceleration);
    worst = std::max(worst, length(found - expected) / length(expected));
  }
  return {"its definition", worst, 1e-12};
}

Verdict check(const ShortestPathCoupling& coupling, const Stage&, int,
              const std::vector<Vec3d>& at) {
  std::vector<Vec3d> smooth;
  for (const Vec3d& x : at) {
    const std::uint64_t here = coupling.signature(x);
    const double h = 1e-3;
    bool even = here != 0 && coupling.pull(x, x).nearness < 1e3;
    for (const Vec3d& step : {Vec3d{h, 0, 0}, Vec3d{0, h, 0}, Vec3d{0, 0, h}})
      even = even && coupling.signature(x + step) == here && coupling.signature(x - step) == here;
    if (even) smooth.push_back(x);
  }
  return {"differences of GM/D", difference(coupling, DifferencedPotential{coupling}, smooth),
          1e-6};
}

Verdict check(const GravitonMapCoupling& coupling, const Stage&, int,
              const std::vector<Vec3d>& at) {
  return {"closest-point", difference(coupling, coupling.exact(), at), 0.05};
}

Verdict check(const PortalMassCoupling& coupling, const Stage& stage, int depth,
              const std::vector<Vec3d>& at) {
  return {"closest-point", difference(coupling, ClosestPointCoupling(stage.input(depth)), at), 2.0};
}

/// Nanoseconds of one call, the least of several rounds.
template <class F>
double nanoseconds_of(F call, const std::vector<Vec3d>& at) {
  double sum = 0.0;
  const double seconds = least_time_of(12, [&] {
    for (const Vec3d& x : at) sum += call(x);
  });
  // The sum is used, so that the calls are made.
  return std::isnan(sum) ? 0.0 : 1e9 * seconds / static_cast<double>(at.size());
}

/// Work of direct attraction and coupling, falling on the axis from the ceiling to the floor.
template <class C>
double work_of_lap(const Stage& stage, const C& coupling) {
  constexpr int cells = 20000;
  double sum = 0.0;
  for (int i = 0; i < cells; ++i) {
    const Vec3d x{0.0, corridor_height * (i + 0.5) / cells, 0.0};
    sum -= direct(stage, x).y + coupling.pull(x, x).acceleration.y;
  }
  return sum * corridor_height / cells;
}

template <class C>
void measure(const C& coupling, const Stage& stage, int depth, double one_mass, Table& table) {
  const std::vector<Vec3d> at = places(4000);
  const Verdict verdict = check(coupling, stage, depth, at);
  if (!(verdict.error <= verdict.allowed))
    throw WorkError(
        fmt::format("{} at depth {} is {:.3g} from {}, more than {:.3g}, and was not timed",
                    C::name, depth, verdict.error, verdict.against, verdict.allowed));
  const double pull =
      nanoseconds_of([&](Vec3d x) { return coupling.pull(x, x).acceleration.x; }, at);
  const double signature =
      nanoseconds_of([&](Vec3d x) { return static_cast<double>(coupling.signature(x)); }, at);
  const Stage lap_stage = corridor();
  table.add(fmt::format("couplings/{} {}", C::name, depth),
            {std::string(C::name), static_cast<double>(depth), 1e-9 * pull, pull / one_mass,
             signature / one_mass, verdict.against, verdict.error,
             work_of_lap(lap_stage, C(lap_stage.input(depth)))});
}

int run(const Request& request) {
  const Stage stage = figure_7();
  Stage isolated = stage;
  isolated.masses[0].influence = 1e300;
  const double one_mass =
      nanoseconds_of([&](Vec3d x) { return direct(isolated, x).x; }, places(4000));
  Table table(fmt::format("one pull through portals, beside one of a mass ({:.2f} ns)", one_mass),
              {{"", "coupling"},
               {"depth", "depth", "{:.0f}"},
               {"ns", "seconds", "{:.1f}", 1e9},
               {"masses", "ratio", "{:.1f}"},
               {"signature", "signature_ratio", "{:.1f}"},
               {"checked against", "checked_against"},
               {"error", "error", "{:.2g}"},
               {"work of a lap", "work_of_a_lap", "{:.4f}"}});
  for (const std::string_view name : coupling_names())
    for (int depth = 1; depth <= 4; ++depth) {
      std::visit([&](const auto& made) { measure(made, stage, depth, one_mass, table); },
                 make_coupling(name, stage.input(depth)));
      if (name == NoCoupling::name || name == PortalMassCoupling::name) break;
    }
  table.print(request.style);
  return 0;
}

}  // namespace
}  // namespace portalens::benchmarks

int main(int count, char** words) {
  return portalens::benchmarks::Command(
             "What does gravity through portals cost, how far is each fast way from what it stands "
             "for, and how much work does each do on a closed lap?")
      .run(count, words, portalens::benchmarks::run);
}
