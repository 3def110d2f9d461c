#!/usr/bin/env python3
"""Holds what CONTRIBUTING.md says of lists of types: a newcomer is one header and one word.

    tools/try_newcomers.py [--tests] [FOLDER]

Copies the sources to FOLDER (by default a new one, which is removed afterwards; give one to build
quicker the next time), adds to each list of types a newcomer that is as small as its contract
allows, builds the program without optimisation and renders a scene that uses all of them. With
--tests it builds the typed tests of those rooms, too, which must try the newcomers without being
told.

Where that fails it prints the files that would have needed more, and exits 1. To have another list
tried, add an entry to LISTS in tools/newcomers.py.
"""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from newcomers import LISTS

ROOT = pathlib.Path(__file__).resolve().parent.parent


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
            sys.exit(f"src/{one.header}: the list {one.variant} is not there; mend tools/newcomers.py")
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
