"""The installed package is whole: the examples are built against it, and run, where nothing else is.

    package_test.py BUILD EXAMPLES CMAKE CXX GENERATOR

BUILD is the build folder, in which the library and the program lie ready; EXAMPLES the folder of
examples, which are copied to where no source of ours is near.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

BUILD, EXAMPLES, CMAKE, CXX, GENERATOR = sys.argv[1:6]
ROOM = pathlib.Path(BUILD) / "tests" / "package"
PREFIX = ROOM / "prefix"
SCENE = """
film = { width = 64, height = 48 }
environment = { color = [0.2, 0.3, 0.5] }
mass = [{ name = "hole", center = [0, 0, 0], mass = 150 }]
camera = { position = [0, 0, 6], look_at = [0, 0, 0] }
"""


def run(*words, cwd=ROOM, **more):
    return subprocess.run([str(word) for word in words], cwd=cwd, capture_output=True, text=True,
                          check=False, **more)


def succeed(*words, **more):
    done = run(*words, **more)
    if done.returncode != 0:
        raise AssertionError(f"{words}: {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def size_of_png(path):
    head = path.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n", head
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(ROOM, ignore_errors=True)
        ROOM.mkdir(parents=True)
        succeed(CMAKE, "--install", BUILD, "--prefix", PREFIX)
        shutil.copytree(EXAMPLES, ROOM / "examples")
        environment = {**os.environ, "CXX": CXX}
        succeed(CMAKE, "-S", "examples", "-B", "build", "-G", GENERATOR,
                f"-DCMAKE_PREFIX_PATH={PREFIX}", env=environment)
        succeed(CMAKE, "--build", "build", "--parallel", "2")

    def test_the_manual_the_completions_and_the_scenes_are_there(self):
        page = (PREFIX / "share" / "man" / "man1" / "portalens.1").read_text()
        for command in ("RENDER", "TRACE", "IMAGE"):
            self.assertIn(f".SH PORTALENS {command}", page)
        self.assertIn("\\-\\-layers", page)
        self.assertTrue((PREFIX / "share" / "portalens" / "scenes" / "demo.toml").is_file())
        self.assertTrue((PREFIX / "share" / "zsh" / "site-functions" / "_portalens").is_file())
        script = PREFIX / "share" / "bash-completion" / "completions" / "portalens"
        program = PREFIX / "bin" / "portalens"
        words = succeed("bash", "-c", f"source '{script}'; COMP_WORDS=('{program}' render --sam); "
                        "COMP_CWORD=2; _portalens; echo ${COMPREPLY[*]}").split()
        self.assertEqual(words, ["--samples", "--samples-from", "--samples-to"])

    def test_the_program_of_the_page_builds_and_runs_as_it_stands(self):
        room = ROOM / "page"
        room.mkdir()
        page = (pathlib.Path(EXAMPLES).parent / "docs" / "library.md").read_text(encoding="utf-8")
        for kind, name in (("cmake", "CMakeLists.txt"), ("cpp", "mine.cpp")):
            text = re.search(rf"```{kind}\n(.*?)```", page, flags=re.S)[1]
            (room / name).write_text(text, encoding="utf-8")
        succeed(CMAKE, "-S", room, "-B", room / "build", "-G", GENERATOR,
                f"-DCMAKE_PREFIX_PATH={PREFIX}", env={**os.environ, "CXX": CXX})
        succeed(CMAKE, "--build", room / "build")
        (room / "first.toml").write_text(SCENE, encoding="utf-8")
        succeed(room / "build" / "mine", cwd=room)
        self.assertEqual(size_of_png(room / "first.png"), (480, 270))
        (room / "first.toml").unlink()
        self.assertEqual(run(room / "build" / "mine", cwd=room).returncode, 1)

    def test_a_scene_built_in_code_becomes_a_picture(self):
        told = succeed(ROOM / "build" / "render_in_code", "hole.png")
        self.assertEqual(size_of_png(ROOM / "hole.png"), (96, 54))
        self.assertRegex(told, r"hole swallows light within 0\.0395\n")
        self.assertGreater(int(re.search(r"(\d+) photons swallowed", told)[1]), 0)

    def test_a_fan_of_rays_is_bent_as_far_from_a_mass_it_must_be(self):
        rows = [line.split() for line in succeed(ROOM / "build" / "fan_of_rays").splitlines()]
        self.assertEqual(len(rows), 11)
        self.assertEqual(rows[5][1], "absorbed")
        for row in (rows[1], rows[9]):
            self.assertEqual(row[1], "escaped")
            self.assertAlmostEqual(float(row[2]), float(row[3]), delta=2e-2 * float(row[3]))
        self.assertEqual(rows[10][-1], "star")

    def test_a_setting_that_is_none_is_told_and_nothing_is_traced(self):
        done = run(ROOM / "build" / "fan_of_rays", "physics.tolerence=1")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("did you mean tolerance?", done.stderr)

    def test_a_progress_bar_of_ones_own_fills_and_can_stop(self):
        (ROOM / "scene.toml").write_text(SCENE, encoding="utf-8")
        told = succeed(ROOM / "build" / "own_progress_bar", "scene.toml")
        self.assertIn("[" + "#" * 40 + "] 100 %\ndone after", told)
        self.assertEqual(size_of_png(ROOM / "own_progress_bar.png"), (64, 48))
        self.assertIn("stopped after", succeed(ROOM / "build" / "own_progress_bar", "scene.toml",
                                               "0"))
        (ROOM / "scene.toml").write_text("[film]\nwidht = 3\n", encoding="utf-8")
        done = run(ROOM / "build" / "own_progress_bar", "scene.toml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("scene.toml:2: ", done.stderr)

    def test_each_header_stands_alone_and_needs_no_library(self):
        headers = sorted((PREFIX / "include" / "portalens").iterdir())
        self.assertGreater(len(headers), 5)
        for header in headers:
            succeed(CXX, "-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I",
                    PREFIX / "include", "-x", "c++", "-",
                    input=f"#include <portalens/{header.name}>\n")

    def test_the_package_asks_users_for_no_headers_but_its_own(self):
        targets = next(PREFIX.rglob("portalensTargets.cmake")).read_text(encoding="utf-8")
        linked = re.search(r'INTERFACE_LINK_LIBRARIES "(.*)"', targets)[1]
        for library in linked.split(";"):
            self.assertRegex(library.replace("\\", ""), r"^\$<LINK_ONLY:[A-Za-z:+-]*>$")
        self.assertNotRegex(linked, "CLI11|nlohmann")
        self.assertNotIn(str(pathlib.Path(EXAMPLES).parent), targets)

    def test_another_minor_version_is_refused(self):
        room = ROOM / "later"
        room.mkdir()
        (room / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(later LANGUAGES NONE)\n"
            "find_package(portalens 0.3 REQUIRED)\n", encoding="utf-8")
        done = run(CMAKE, "-S", room, "-B", room / "build", f"-DCMAKE_PREFIX_PATH={PREFIX}")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn('compatible with requested version "0.3"', done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
