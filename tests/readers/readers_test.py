"""What `portalens trace -o` writes is opened without complaint by readers that are not ours: the
Khronos glTF validator and a PLY parser, of the npm registry, in the versions of package-lock.json.

    readers_test.py PORTALENS FOLDER       # the readers are installed into FOLDER

Ends with 77, "skipped", and says so, where they can't be had.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SOURCES = HERE.parents[1]
SKIPPED = 77
PORTALENS = FOLDER = None

SCENE = """camera = { position = [0, 0, 9], look_at = [0, 0, 0] }
physics = { portal_gravity = "none" }
mass = [{ name = 'the <hole> "\\u00e4"', center = [0, 0, 0], mass = 500 }]
quad = [{ name = "wall", vertices = [[-9, -9, -9], [9, -9, -9], [9, 9, -9], [-9, 9, -9]] }]
portal = [
  { name = "in", pair = "out", vertices = [[2, -1, -2], [4, -1, -2], [4, 1, -2], [2, 1, -2]] },
  { name = "out", pair = "in", vertices = [[-4, 3, 0], [-2, 3, 0], [-2, 5, 0], [-4, 5, 0]] }]
"""
# Into the hole, onto the wall, through the portal, away.
RAYS = "0 0 9 0 0 -1\n-3 -2 9 0 0 -1\n3 0 9 0.02 0.01 -1\n0 0 9 0 1 1\n"


class Unavailable(Exception):
    """The readers can't be had here."""


def install():
    """Installs the readers into FOLDER, unless the same are there already."""
    lock = (HERE / "package-lock.json").read_bytes()
    mark = FOLDER / "installed-lock.json"
    FOLDER.mkdir(parents=True, exist_ok=True)
    shutil.copy(HERE / "open.js", FOLDER)
    if mark.exists() and mark.read_bytes() == lock:
        return
    if not shutil.which("npm") or not shutil.which("node"):
        raise Unavailable("node and npm are missing; scripts/install-deps installs them")
    for name in ("package.json", "package-lock.json"):
        shutil.copy(HERE / name, FOLDER)
    words = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1",
             "--fetch-retry-mintimeout=3000", "--fetch-timeout=30000"]
    try:
        done = subprocess.run(words, cwd=FOLDER, capture_output=True, text=True, check=False,
                              timeout=300)
    except subprocess.TimeoutExpired as late:
        raise Unavailable("npm ci took longer than 300 s") from late
    if done.returncode != 0:
        raise Unavailable("is the npm registry in reach? npm ci said:\n" + done.stderr[-2000:])
    mark.write_bytes(lock)


def opened(file):
    """What a reader finds in the file."""
    done = subprocess.run(["node", FOLDER / "open.js", file], capture_output=True, text=True,
                          check=True)
    return json.loads(done.stdout)


def export(file, scene, words, rays=""):
    """Ways of photons into a file; returns the answers, with their paths."""
    done = subprocess.run(
        [PORTALENS, "trace", scene, *words, "--json", "--path", "-o", file.name], cwd=file.parent,
        input=rays, capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def lines_of(answers):
    """The stretches that the answers tell of, each without repeated points; and whether it goes on
    for a while after its last."""
    lines = []
    for answer in answers:
        for stretch in answer["path"]:
            points = [p for i, p in enumerate(stretch) if i == 0 or p != stretch[i - 1]]
            last = stretch is answer["path"][-1]
            lines.append((points, last and answer["fate"] == "escaped"))
    return lines


def vertices_of(answers):
    """How many vertices that makes."""
    return sum(len(points) + goes_on for points, goes_on in lines_of(answers))


class Readers(unittest.TestCase):
    """Files of a scene with every fate, read again."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "scene.toml").write_text(SCENE, encoding="utf-8")

    def test_the_gltf_validator_finds_nothing_wrong(self):
        for color in ("fate", "turning"):
            words = ["--rays", "-", "--color", color]
            answers = export(self.folder / "a.gltf", "scene.toml", words, RAYS)
            report = opened(self.folder / "a.gltf")
            self.assertEqual(report["mimeType"], "model/gltf+json")
            self.assertEqual(report["issues"]["messages"], [])
            self.assertEqual(report["info"]["version"], "2.0")
            self.assertEqual(report["info"]["drawCallCount"], 4)
            two_portals = 2 * 4
            self.assertGreater(report["info"]["totalVertexCount"],
                               vertices_of(answers) + two_portals)

    def test_the_gltf_validator_finds_nothing_wrong_with_scenes_of_the_gallery(self):
        for scene in ("demo", "figure-06", "figure-11", "figure-18"):
            file = SOURCES / "scenes" / (scene + ".toml")
            words = ["--set", "film.width=64", "--set", "film.height=36", "--bounces", "4"]
            for pixel in ("10 20", "32 18", "50 9"):
                words += ["--pixel", *pixel.split()]
            export(self.folder / "a.gltf", file, words)
            report = opened(self.folder / "a.gltf")
            self.assertEqual(report["issues"]["messages"], [], scene)

    def test_the_gltf_validator_sees_a_fault(self):
        file = self.folder / "a.gltf"
        export(file, "scene.toml", ["--rays", "-"], RAYS)
        model = json.loads(file.read_text(encoding="utf-8"))
        model["accessors"][0]["max"][0] += 1
        file.write_text(json.dumps(model), encoding="utf-8")
        self.assertGreater(opened(file)["issues"]["numErrors"], 0)

    def test_a_ply_parser_reads_every_point_its_color_and_the_edges_between(self):
        answers = export(self.folder / "a.ply", "scene.toml", ["--rays", "-"], RAYS)
        read = opened(self.folder / "a.ply")
        self.assertEqual(set(read), {"vertex", "edge"})
        vertex, edge = read["vertex"], read["edge"]
        places = [list(place) for place in zip(vertex["x"], vertex["y"], vertex["z"])]
        self.assertEqual(len(places), vertices_of(answers))
        edges = []
        first = 0
        for points, goes_on in lines_of(answers):
            self.assertEqual(places[first:first + len(points)], points)
            count = len(points) + goes_on
            edges += [(i, i + 1) for i in range(first, first + count - 1)]
            first += count
        self.assertEqual(list(zip(edge["vertex1"], edge["vertex2"])), edges)
        colors = list(zip(vertex["red"], vertex["green"], vertex["blue"]))
        self.assertEqual(len(colors), len(places))
        self.assertEqual(len(set(colors)), 3, "absorbed, hit and escaped differ")


if __name__ == "__main__":
    PORTALENS, FOLDER = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    try:
        install()
    except Unavailable as why:
        print(f"readers_test: the readers can't be installed: {why}", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
