"""tools/check_layers.py finds what goes the wrong way, and nothing else."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools" / "check_layers.py"


def run_on(files):
    """Runs the tool on a tree made of `files`, path -> text; gives its exit status and output."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            folder = "include" if path.startswith("portalens/") else "src"
            target = pathlib.Path(root) / folder / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, TOOL, root], capture_output=True, text=True,
                              check=False)
        return done.returncode, done.stdout


class CheckLayers(unittest.TestCase):
    def test_includes_to_the_left_are_silent(self):
        status, output = run_on({
            "portal/portal.h": '#include <vector>\n#include "math/rigid.h"\n',
            "world/compile.cpp": '#include "io/image.h"\n#include "shading/shade.h"\n',
            "app/main.cpp": '#include <CLI/CLI.hpp>\n#include "render/render.h"\n',
        })
        self.assertEqual((status, output), (0, "all includes go the right way\n"))

    def test_an_include_to_the_right_is_named_with_its_line(self):
        status, output = run_on({"math/vec3.h": '#pragma once\n\n#include "photon/photon.h"\n'})
        self.assertEqual(status, 1)
        self.assertIn('src/math/vec3.h:3: math may not include "photon/photon.h"', output)

    def test_reading_and_geometry_do_not_know_each_other(self):
        for path, other in (("io/read_mesh.cpp", "geometry/mesh.h"),
                            ("geometry/mesh.cpp", "io/read_mesh.h"),
                            ("geometry/quad.h", "scene/scene.h")):
            status, output = run_on({path: f'#include "{other}"\n'})
            self.assertEqual(status, 1)
            self.assertIn(f"src/{path}:1: ", output)

    def test_a_library_stays_where_it_is_kept(self):
        for line, place in (("<embree3/rtcore.h>", "geometry/box_tree.cpp"),
                            ("<tbb/parallel_for.h>", "render/parallel.h"),
                            ("<oneapi/tbb/task_arena.h>", "render/parallel.h"),
                            ("<ImfHeader.h>", "io/exr_file.cpp"),
                            ("<spng.h>", "io/png_file.cpp"),
                            ("<turbojpeg.h>", "io/jpeg_file.cpp")):
            self.assertEqual(run_on({place: f"#include {line}\n"})[0], 0)
            status, output = run_on({"render/film.h": f"#include {line}\n"})
            self.assertEqual(status, 1)
            self.assertIn("src/render/film.h:1: ", output)

    def test_an_include_without_its_room_and_an_unknown_room_are_faults(self):
        self.assertEqual(run_on({"math/rigid.h": '#include "vec3.h"\n'})[0], 1)
        self.assertEqual(run_on({"math/rigid.h": '#include "../core/error.h"\n'})[0], 1)
        self.assertEqual(run_on({"cellar/wine.h": "\n"})[0], 1)

    def test_public_headers_include_only_std_and_each_other(self):
        good = {"portalens/world.h": '#include <vector>\n#include "portalens/scene.h"\n'}
        self.assertEqual(run_on(good)[0], 0)
        for line in ('"math/vec3.h"', "<fmt/format.h>", "<zlib.h>", '"scene.h"'):
            status, output = run_on({"portalens/world.h": f"#include <vector>\n#include {line}\n"})
            self.assertEqual(status, 1)
            self.assertIn("include/portalens/world.h:2: ", output)

    def test_only_the_api_may_include_public_headers_but_all_the_version(self):
        line = '#include "portalens/world.h"\n'
        self.assertEqual(run_on({"api/world.cpp": line})[0], 0)
        self.assertEqual(run_on({"world/compile.cpp": line})[0], 1)
        self.assertEqual(run_on({"app/main.cpp": line})[0], 1)
        version = '#include "portalens/version.h"\n'
        self.assertEqual(run_on({"render/fingerprint.cpp": version})[0], 0)

    def test_neither_the_api_nor_the_command_line_knows_the_other(self):
        for path, other in (("api/world.cpp", "app/report.h"), ("app/main.cpp", "api/access.h"),
                            ("render/render.cpp", "api/access.h")):
            self.assertEqual(run_on({path: f'#include "{other}"\n'})[0], 1)


if __name__ == "__main__":
    unittest.main()
