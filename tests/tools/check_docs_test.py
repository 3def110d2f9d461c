"""tools/check_docs.py finds what pages say wrongly, and nothing else."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools" / "check_docs.py"
SOURCES = {
    "src/photon/drift.h": "inline constexpr double trusted_drift = 20.0;\n",
    "docs/other.md": "# Other\n\n## The way light goes\n",
}


def run_on(page):
    """Runs the tool on a repository whose README.md is `page`; gives its exit status and output."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in {**SOURCES, "README.md": page}.items():
            target = pathlib.Path(root) / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, TOOL, root], capture_output=True, text=True,
                              check=False)
        return done.returncode, done.stdout


class CheckDocs(unittest.TestCase):
    def test_what_agrees_is_let_be(self):
        status, output = run_on(
            "See [there](docs/other.md#the-way-light-goes), `src/photon/drift.h`, `photon/drift.h`,\n"
            "[elsewhere](https://example.org/x.md#y): 20<!-- trusted_drift in src/photon/drift.h -->\n"
            "```\n[not a link](nowhere.md)\n```\n")
        self.assertEqual((status, output), (0, "2 pages agree with the sources\n"))

    def test_what_is_wrong_is_told_with_its_line(self):
        for page, message in {
            "[x](docs/none.md)": "the link leads to no file: docs/none.md",
            "[x](docs/other.md#none)": "the link leads to no heading: docs/other.md#none",
            "`photon/none.h`": "there is no file photon/none.h",
            "30<!-- trusted_drift in src/photon/drift.h -->": "trusted_drift is 20 in src/photon/drift.h, not 30",
            "30<!-- none in src/photon/drift.h -->": "src/photon/drift.h gives no none",
            "all 675 tests pass": "a count of tests is wrong by tomorrow: leave it out",
        }.items():
            with self.subTest(page=page):
                self.assertEqual(run_on("first\n" + page + "\n"), (1, f"README.md:2: {message}\n"))


if __name__ == "__main__":
    unittest.main()
