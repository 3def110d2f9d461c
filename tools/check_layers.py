#!/usr/bin/env python3
"""Holds the rooms of src/ apart: includes go only the way docs/architecture.md says; and the public
headers in include/ apart from all of them.

    tools/check_layers.py [ROOT]      ROOT is the repository, by default the one this file stands in

Prints each include that goes the wrong way, with file and line, and exits 1 if there is any.
"""

import pathlib
import re
import sys

# What each room may include, besides itself.
BENEATH = {
    "core": [],
    "math": ["core"],
    "scene": ["core", "math"],
    "io": ["core", "math", "scene"],
    "geometry": ["core", "math"],
    "portal": ["core", "math", "geometry"],
    "gravity": ["core", "math", "geometry", "portal"],
    "photon": ["core", "math", "geometry", "portal", "gravity"],
    "lanes": ["core", "math", "geometry", "portal", "gravity", "photon"],
    "shading": ["core", "math", "geometry", "portal", "gravity", "photon"],
}
BENEATH["world"] = list(BENEATH)
BENEATH["render"] = list(BENEATH)
BENEATH["api"] = BENEATH["app"] = list(BENEATH)

# The public headers are for the room that stands behind them; all may ask for the version.
PUBLIC = "portalens"
PUBLIC_FOR = ["api"]
PUBLIC_FOR_ALL = ["portalens/version.h"]

# Libraries that only some places may know: start of the include -> starts of the paths.
KEPT = {
    "embree": ["geometry/box_tree.cpp"],
    "tbb/": ["render/parallel.h"],
    "oneapi/": ["render/parallel.h"],
    "Imf": ["io/exr_file.cpp"],
    "Imath": ["io/exr_file.cpp"],
    "Iex": ["io/exr_file.cpp"],
    "spng": ["io/png_file.cpp"],
    "turbojpeg": ["io/jpeg_file.cpp"],
    "OpenImageIO/": [],  # the tests' alone
    "toml": ["io/"],
    "tiny_obj_loader": [],  # the tests' alone: our reader is held against it
    "nlohmann/": ["app/", "io/"],
    "utf8.h": ["app/utf8.h", "io/toml_letters.cpp"],
    "CLI/": ["app/"],
    "xsimd/": ["math/", "lanes/"],
    "xxhash": ["io/digest.cpp"],
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def faults_of(source, path):
    """What is wrong with the includes of one file, as (line, message)."""
    room = path.split("/")[0]
    if room not in BENEATH:
        yield 1, f"'{room}' is no room; known are {', '.join(BENEATH)}"
        return
    for number, line in enumerate(source.splitlines(), start=1):
        found = INCLUDE.match(line)
        if not found:
            continue
        bracket, name = found.groups()
        for library, places in KEPT.items():
            if name.startswith(library) and not path.startswith(tuple(places)):
                yield number, f"<{name}> belongs only to {' and '.join(places)}"
        if bracket == "<":
            continue
        other = name.split("/")[0]
        if other == PUBLIC:
            if room not in PUBLIC_FOR and name not in PUBLIC_FOR_ALL:
                yield number, f'"{name}" is for those outside, and for {", ".join(PUBLIC_FOR)}'
        elif "/" not in name or other not in BENEATH:
            yield number, f'"{name}" should name its room, as in "math/vec3.h"'
        elif other != room and other not in BENEATH[room]:
            allowed = ", ".join(BENEATH[room]) or "nothing"
            yield number, f'{room} may not include "{name}"; it may include {allowed}'


def faults_of_public(source):
    """The same of a public header."""
    for number, line in enumerate(source.splitlines(), start=1):
        found = INCLUDE.match(line)
        if not found:
            continue
        bracket, name = found.groups()
        standard = bracket == "<" and re.fullmatch(r"[a-z_0-9]+", name)
        if not standard and not (bracket == '"' and name.startswith(PUBLIC + "/")):
            yield number, f"a public header includes only std and {PUBLIC}/, not {name}"


def check(root):
    """All the faults under root/src and root/include, as lines to print."""
    headers = pathlib.Path(root) / "include"
    for file in sorted(headers.rglob("*.h")):
        for number, message in faults_of_public(file.read_text(encoding="utf-8")):
            yield f"include/{file.relative_to(headers).as_posix()}:{number}: {message}"
    sources = pathlib.Path(root) / "src"
    for file in sorted(sources.rglob("*")):
        if file.suffix in {".h", ".cpp"}:
            path = file.relative_to(sources).as_posix()
            for number, message in faults_of(file.read_text(encoding="utf-8"), path):
                yield f"src/{path}:{number}: {message}"


def main(arguments):
    root = arguments[1] if len(arguments) > 1 else pathlib.Path(__file__).resolve().parent.parent
    faults = list(check(root))
    print("\n".join(faults) if faults else "all includes go the right way")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
