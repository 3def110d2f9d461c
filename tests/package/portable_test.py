"""A build without Embree, oneTBB and the libraries of pictures takes the same pictures as one with them, to the bit.

    portable_test.py PORTABLE [OTHER]

Both are programs; without OTHER it is only tried that PORTABLE works.
"""

import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

PORTABLE = pathlib.Path(sys.argv[1]).resolve()  # they are run in other folders
OTHER = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
SCENE = """
film = { width = 48, height = 32 }
environment = { color = [0.2, 0.3, 0.5] }
camera = { position = [0, 1.4, 7], look_at = [0, 1.2, 0] }
light = [{ position = [-4, 8, 6], intensity = [250, 250, 230] }]
material = [{ name = "tiles", diffuse = { checker = [[0.8, 0.8, 0.7], [0.1, 0.1, 0.3]], size = 1 } },
            { name = "mirror", reflective = [0.9, 0.9, 0.9] }]
mass = [{ name = "hole", center = [0, 1.4, 0], mass = 40 }]
quad = [{ vertices = [[-12, 0, 8], [12, 0, 8], [12, 0, -12], [-12, 0, -12]], material = "tiles" }]
sphere = [{ center = [0.7, 0.6, -2], radius = 0.6, material = "mirror" }]
cube = [{ center = [-1, 0.5, -3], size = 1 }]
ring = [{ base = [0, 0.1, 2], height = 0.2, inner_radius = 0.5, outer_radius = 0.7 }]
mesh = [{ file = "hills.obj", translate = [0, 0, -6] }]
portal = [{ name = "in", pair = "out", vertices = [
              [-3, 0.1, -1], [-1.5, 0.1, -1], [-1.5, 2.4, -1], [-3, 2.4, -1]] },
          { name = "out", pair = "in", vertices = [
              [1.6, 0.1, -2], [2.8, 0.1, -1.1], [2.8, 2.4, -1.1], [1.6, 2.4, -2]] }]
"""


def hills(side=40):
    """A mesh of many triangles."""
    lines = [f"v {8 * i / side - 4} {((i * 7 + j * 13) % 11) / 9} {4 * j / side - 2}"
             for j in range(side + 1) for i in range(side + 1)]
    for j in range(side):
        for i in range(side):
            a = j * (side + 1) + i + 1
            lines += [f"f {a} {a + 1} {a + side + 2}", f"f {a} {a + side + 2} {a + side + 1}"]
    return "\n".join(lines) + "\n"


class Portable(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "scene.toml").write_text(SCENE, encoding="utf-8")
        (self.folder / "hills.obj").write_text(hills(), encoding="utf-8")

    def run_program(self, program, *words):
        return subprocess.run([program, *words], cwd=self.folder, capture_output=True, text=True,
                              check=False)

    def succeed(self, program, *words):
        done = self.run_program(program, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_it_writes_whole_pictures(self):
        self.succeed(PORTABLE, "render", "scene.toml", "-o", "a.png")
        self.succeed(PORTABLE, "render", "scene.toml", "-o", "a.exr", "--layers", "depth,object")
        png = (self.folder / "a.png").read_bytes()
        self.assertEqual(struct.unpack(">II", png[16:24]), (48, 32))
        self.assertEqual(png[-8:-4], b"IEND")
        self.assertGreater((self.folder / "a.exr").stat().st_size, 4 * 5 * 48 * 32)

    def test_its_pictures_and_its_ways_are_the_same_bits(self):
        if OTHER is None:
            self.skipTest("no other program to compare it with")
        for engine in ("automatic", "scalar"):
            for name, program in (("a.exr", PORTABLE), ("b.exr", OTHER)):
                self.succeed(program, "render", "scene.toml", "-o", name, "--engine", engine,
                             "--layers", "depth,normal,object,steps")
            told = self.succeed(OTHER, "image", "--compare", "a.exr", "b.exr", "--threshold", "0")
            self.assertIn("max 0 ", told)
        ways = ["trace", "scene.toml", "--ray", "0", "1", "5", "0", "0", "-1", "--json", "--path"]
        self.assertEqual(self.succeed(PORTABLE, *ways), self.succeed(OTHER, *ways))

    def test_parts_of_both_merge_to_the_picture_of_one(self):
        if OTHER is None:
            self.skipTest("no other program to merge with")
        for name, program, crop in (("a.part", PORTABLE, "0 0 48 16"), ("b.part", OTHER, "0 16 48 32")):
            self.succeed(program, "render", "scene.toml", "-o", name, "--crop", *crop.split())
        self.succeed(OTHER, "merge", "a.part", "b.part", "-o", "merged.exr")
        self.succeed(OTHER, "render", "scene.toml", "-o", "whole.exr")
        self.assertIn("max 0 ", self.succeed(OTHER, "image", "--compare", "merged.exr", "whole.exr",
                                             "--threshold", "0"))

    def test_a_picture_that_needs_a_library_is_a_fault_at_its_line(self):
        (self.folder / "sky.png").write_bytes(b"\x89PNG\r\n\x1a\n")
        (self.folder / "sky.toml").write_text('[environment]\nimage = "sky.png"\n',
                                              encoding="utf-8")
        done = self.run_program(PORTABLE, "check", "sky.toml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("sky.toml:2: the picture sky.png can't be read: this portalens was built "
                      "without libraries of pictures", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
