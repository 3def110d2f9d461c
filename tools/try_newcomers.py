#!/usr/bin/env python3
"""Holds what CONTRIBUTING.md says of lists of types: a newcomer is one header and one word.

    tools/try_newcomers.py [--tests] [FOLDER]

Copies the sources to FOLDER (by default a new one, which is removed afterwards; give one to build
quicker the next time), adds to each list of LISTS a type that is as small as its contract allows,
builds the program without optimisation and renders a scene that uses all of them. With --tests
it builds the typed tests of those rooms, too, which must try the newcomers without being told.

Where that fails it prints the files that would have needed more, and exits 1. To have another list
tried, add an entry to LISTS.
"""

import argparse
import dataclasses
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


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
  bool sends() const { return false; }
  struct Here {
    Rgb color;
    Rgb albedo(Vec3d, Vec3d) const { return color; }
    Rgb value(Vec3d, Vec3d, Vec3d) const { return color; }
    std::optional<BsdfSample> sample(Vec3d, Vec3d, double, double) const { return {}; }
    Rgb sampled_value(Vec3d, Vec3d, Vec3d) const { return {}; }
    double density(Vec3d, Vec3d, Vec3d) const { return 0.0; }
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
  LightSample sample(Vec3d, double, double) const { return {position, {}, intensity}; }
  double area() const { return 0.0; }
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
#include <limits>
#include <string_view>
#include "gravity/coupling_input.h"
namespace portalens {
struct NewcomerCoupling {
  static constexpr std::string_view name = "newcomer_coupling";
  static constexpr bool asks_motion = false;
  explicit NewcomerCoupling(const CouplingInput&) {}
  static CouplingCost cost(const CouplingInput&) { return {}; }
  Pull pull(Vec3d, Vec3d) const { return {}; }
  std::uint64_t signature(Vec3d) const { return 0; }
  std::vector<PullPart> parts(Vec3d) const { return {}; }
  double distance_to_support(Vec3d) const { return std::numeric_limits<double>::infinity(); }
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

SCENE = """
[camera]
position = [0, 1, 8]
look_at = [0, 0, 0]
[film]
width = 32
height = 24
[physics]
{physics}
[[material]]
name = "new"
{material}
[[mass]]
name = "hole"
center = [2, 0, 0]
mass = 30
[[portal]]
name = "a"
pair = "b"
vertices = [[-3, -1, -2], [-1, -1, -2], [-1, 1, -2], [-3, 1, -2]]
[[portal]]
name = "b"
pair = "a"
vertices = [[1, -1, -4], [3, -1, -4], [3, 1, -4], [1, 1, -4]]
{tables}
"""


def add_newcomers(sources):
    """Writes each newcomer's header, and its word into the list."""
    for one in LISTS:
        (sources / one.include).write_text("#pragma once\n" + one.body)
        header = sources / one.header
        text = header.read_text()
        word = re.compile(r"(using " + one.variant + r" =\s*std::variant<[^;]*)>;")
        if not word.search(text):
            sys.exit(f"src/{one.header}: the list {one.variant} is not there; mend LISTS in this tool")
        if one.first:
            text = text.replace("std::variant<", f"std::variant<{one.newcomer}, ", 1)
        else:
            text = word.sub(rf"\1, {one.newcomer}>;", text)
        header.write_text(text.replace('#include "', f'#include "{one.include}"\n#include "', 1))


def refresh(folder):
    """Copies the sources; files that are the same keep their time, so that they build no more."""
    with tempfile.TemporaryDirectory() as fresh:
        fresh = pathlib.Path(fresh)
        for name in ("src", "include", "cmake", "examples", "tests", "fuzz"):
            shutil.copytree(ROOT / name, fresh / name)
        shutil.copy(ROOT / "CMakeLists.txt", fresh)
        add_newcomers(fresh / "src")
        wanted = {file.relative_to(fresh) for file in fresh.rglob("*") if file.is_file()}
        for name in wanted:
            to = folder / name
            if not to.is_file() or to.read_bytes() != (fresh / name).read_bytes():
                to.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(fresh / name, to)
        for name in ("src", "include", "cmake", "examples", "tests", "fuzz"):
            for file in list((folder / name).rglob("*")):
                if file.is_file() and file.relative_to(folder) not in wanted:
                    file.unlink()


def build(folder, targets, tests):
    """Builds without optimisation, also of files that ask for it. Returns what the build said."""
    launcher = folder / "unoptimised.sh"
    cache = shutil.which("ccache") or ""
    launcher.write_text(f'#!/bin/sh\nexec {cache} "$@" -O0 -g0\n')
    launcher.chmod(0o755)
    configure = ["cmake", "-S", folder, "-B", folder / "build", "-G", "Ninja"]
    configure += [f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}", "-DPORTALENS_BENCHMARKS=OFF"]
    configure += [f"-DPORTALENS_TESTS={'ON' if tests else 'OFF'}"]
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    made = subprocess.run(
        ["ninja", "-C", folder / "build", "-k", "0", *targets],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env={**os.environ, "LC_ALL": "C"},
    )
    return made.returncode, made.stdout


def needing_more(output, folder):
    """The files at which the compiler stopped, with the first error of each: path -> message."""
    newcomers = {one.include for one in LISTS}
    found = {}
    for block in re.split(r"^FAILED: ", output, flags=re.M)[1:]:
        error = re.search(r"^(\S+?):(\d+):.*?error: (.*)$", block, flags=re.M)
        places = re.findall(r"(?:^|from )(\S+?\.(?:h|cpp)):\d+", block, flags=re.M)
        ours = [os.path.relpath(place, folder) for place in places if str(folder) in place]
        ours = [place for place in ours if place.removeprefix("src/") not in newcomers]
        named = [one.newcomer for one in LISTS if one.newcomer in block]
        text = error.group(3) if error else block.splitlines()[-1]
        place = ours[0] if ours else block.split(" ", 1)[0]
        found.setdefault(place, f"{text} ({', '.join(named) or 'no newcomer is named'})")
    return found


def run(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        print(" ".join(str(word) for word in command) + f" ended with {done.returncode}:")
        print(done.stdout)
    return done


def untold(one, answer):
    """Whether `check --json` leaves out what the newcomer should make it say."""
    for key in one.told[:-1]:
        answer = [item[key] for item in answer] if isinstance(answer, list) else answer[key]
    return bool(one.told) and one.told[-1] != answer and one.told[-1] not in answer


def try_scene(folder):
    scene = folder / "newcomers.toml"
    parts = {key: "".join(getattr(one, key) for one in LISTS)
             for key in ("physics", "material", "tables")}
    scene.write_text(SCENE.format(**parts))
    program = folder / "build" / "portalens"
    told = run([program, "check", scene, "--json"])
    if told.returncode != 0:
        return 1
    answer = json.loads(told.stdout)
    failed = [one for one in LISTS if untold(one, answer)]
    for one in failed:
        print(f"{one.newcomer}: `check` does not tell {' '.join(one.told)}")
    for one in LISTS:
        if not one.refused:
            continue
        setting, word = one.refused
        done = subprocess.run([program, "check", scene, "--set", setting], capture_output=True, text=True)
        if done.returncode != 2 or word not in done.stderr:
            print(f"{one.newcomer}: {setting} is not refused with a message of {word}:\n{done.stderr}")
            failed.append(one)
    draws = run([program, "draw", scene, "-o", folder / "newcomers.svg"])
    renders = run([program, "render", scene, "-o", folder / "newcomers.png"])
    return 1 if failed or draws.returncode or renders.returncode else 0


def try_tests(folder, rooms):
    """Runs the typed tests of the newcomers; each must have some."""
    tried, failed = set(), 0
    for room in rooms:
        program = folder / "build" / "tests" / f"test_{room}"
        listed = run([program, "--gtest_list_tests"]).stdout
        suites = re.findall(r"^(\S+)\.  # TypeParam = portalens::(Newcomer\w+)", listed, flags=re.M)
        tried |= {newcomer for _, newcomer in suites}
        if suites:
            only = ":".join(f"{suite}.*" for suite, _ in suites)
            failed |= run([program, f"--gtest_filter={only}", "--gtest_brief=1"]).returncode
    for one in LISTS:
        if one.newcomer not in tried:
            print(f"{one.newcomer}: no typed test tries it")
            failed = 1
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tests", action="store_true", help="build and run the typed tests, too")
    parser.add_argument("folder", nargs="?", help="where to build; kept")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(arguments.folder or temporary).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        refresh(folder)
        rooms = sorted({one.header.split("/")[0] for one in LISTS}) if arguments.tests else []
        targets = ["portalens"] + [f"test_{room}" for room in rooms]
        code, output = build(folder, targets, arguments.tests)
        if code != 0:
            more = needing_more(output, folder)
            print("a newcomer needs more than its header and its word:")
            for place, message in sorted(more.items()):
                print(f"  {place}: {message}")
            if not more:
                print(output)
            return 1
        if try_scene(folder) or (rooms and try_tests(folder, rooms)):
            return 1
        print("one header and one word did for " + ", ".join(one.variant for one in LISTS))
        return 0


if __name__ == "__main__":
    sys.exit(main())
