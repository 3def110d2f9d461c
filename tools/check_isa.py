#!/usr/bin/env python3
"""Holds the engine of each instruction set to itself.

    tools/check_isa.py OBJECT...      object files of src/lanes/engine_{sse4,sse4_plain,avx2,avx512}.cpp

An inline function that is emitted in the object of a wide instruction set under a name that other
objects share may be the one the linker keeps, and then crashes processors without that set. So
every weak function of these objects must bear the tag of its set; constants may be shared, as they
hold no instructions. Prints those that don't, and exits 1 if there is any.
"""

import pathlib
import subprocess
import sys

TAGS = {
    "engine_sse4": "xsimd::sse4_2",
    "engine_sse4_plain": "xsimd::sse4_2",
    "engine_avx2": "xsimd::fma3<xsimd::avx2>",
    "engine_avx512": "xsimd::avx512bw",
}


def untagged(symbols, tag):
    """The weak functions in the output of `nm -C` that don't bear the tag."""
    found = []
    for line in symbols.splitlines():
        parts = line.split(maxsplit=2)
        if len(parts) == 3 and parts[1] == "W" and tag not in parts[2]:
            found.append(parts[2])
    return found


def main(paths):
    if not paths:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    bad = 0
    for path in map(pathlib.Path, paths):
        engine = path.name.split(".")[0]
        if engine not in TAGS:
            print(f"{path}: no engine's object; known are {', '.join(TAGS)}", file=sys.stderr)
            return 2
        symbols = subprocess.run(
            ["nm", "-C", path], check=True, capture_output=True, text=True
        ).stdout
        for name in untagged(symbols, TAGS[engine]):
            print(f"{path}: {name} does not bear {TAGS[engine]}")
            bad += 1
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
