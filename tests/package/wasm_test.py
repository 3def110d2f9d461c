"""The library in WebAssembly: the examples are compiled against it, and run by Node.

    wasm_test.py BUILD EXAMPLES HEADERS

BUILD holds libportalens.a of the preset `wasm`.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BUILD, EXAMPLES, HEADERS = (pathlib.Path(word).resolve() for word in sys.argv[1:4])


class WebAssembly(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def output_of(self, example, *words):
        script = self.folder / f"{example}.js"
        subprocess.run(["em++", "-std=c++20", "-O1", "-fexceptions", "-I", HEADERS,
                        EXAMPLES / f"{example}.cpp", BUILD / "libportalens.a", "-s", "NODERAWFS=1",
                        "-s", "ALLOW_MEMORY_GROWTH=1", "-o", script], check=True, env=os.environ)
        # Debian's emscripten takes a Node that can fetch for a browser.
        return subprocess.run(["node", "--no-experimental-fetch", script, *words],
                              cwd=self.folder, check=True, capture_output=True, text=True).stdout

    def test_a_fan_of_rays_is_bent_as_far_from_a_mass_it_must_be(self):
        rows = [line.split() for line in self.output_of("fan_of_rays").splitlines()]
        self.assertEqual(len(rows), 11)
        self.assertEqual(rows[5][1], "absorbed")
        for row in (rows[1], rows[9]):
            self.assertAlmostEqual(float(row[2]), float(row[3]), delta=2e-2 * float(row[3]))

    def test_a_scene_built_in_code_becomes_a_picture(self):
        told = self.output_of("render_in_code", "hole.png")
        self.assertGreater(int(re.search(r"(\d+) photons swallowed", told)[1]), 0)
        png = (self.folder / "hole.png").read_bytes()
        self.assertEqual((png[:4], png[-8:-4]), (b"\x89PNG", b"IEND"))

    def test_faults_are_caught_and_told(self):
        with self.assertRaises(subprocess.CalledProcessError) as failed:
            self.output_of("fan_of_rays", "physics.tolerence=1")
        self.assertEqual(failed.exception.returncode, 1)
        self.assertIn("did you mean tolerance?", failed.exception.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
