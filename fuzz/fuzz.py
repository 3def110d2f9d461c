#!/usr/bin/env python3
"""Runs the fuzz targets one after the other, and tells how far each saw.

    fuzz/fuzz.py [--seconds N] [--runs N] [--hang S] [--keep | --minimise] [TARGET...]

TARGET is toml, obj, mesh, image, scene, checkpoint, recipe: by default all. A target ends after so many
seconds or executions, whichever comes first; a crash, a leak, more than 1 GiB or an input that takes
longer than --hang seconds ends it at once, and leaves the input in build/fuzz/findings. What it
discovers is gathered in build/fuzz/corpus; --keep distills that into fuzz/corpus, for `make test` to
replay: few and short inputs that reach every edge which all of them reach, and the seeds do not.
--minimise distills without fuzzing, from what fuzz/corpus and build/fuzz/corpus hold. Exits 1 if anything was
found, if a target saw much less than its seeds alone show (then it is blind), or if edges were lost.
"""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
BUILD = HERE.parent / "build" / "fuzz"
LEAST_EDGES = {"toml": 1500, "obj": 1000, "mesh": 1000, "image": 500, "scene": 6000, "checkpoint": 3000, "recipe": 900}
LONGEST_INPUT = {"toml": 4096, "obj": 4096, "mesh": 4096, "scene": 4096, "image": 2048}
KEPT_BYTES = 2048  # a longer input is not kept in the repository
LENT = {"scene": "toml"}  # whose seeds and corpus a target is given, too; as in CMakeLists.txt
MOST_LOST = 0.01  # of the edges: some of them come and go with the order of inputs
MEMORY = pathlib.Path("/dev/shm")


def known_targets():
    return sorted(path.name[len("fuzz_"):] for path in (BUILD / "fuzz").glob("fuzz_*") if path.is_file())


def grown(target):
    """Where what a target discovers is gathered."""
    work = BUILD / "corpus" / target
    work.mkdir(parents=True, exist_ok=True)
    return work


def given(target):
    """What a target begins with, whatever it keeps of its own: its seeds, and what is lent to it."""
    lender = LENT.get(target)
    lent = [HERE / "seeds" / lender, HERE / "corpus" / lender] if lender else []
    return [HERE / "seeds" / target] + lent


def files_in(*folders):
    return [file for folder in folders if folder.is_dir() for file in folder.iterdir()]


def command(target, *options):
    longest = LONGEST_INPUT.get(target, 4096)
    return [str(BUILD / "fuzz" / f"fuzz_{target}"), f"-max_len={longest}", *options]


def run(target, arguments, place):
    """Fuzzes one target; its exit status, executions and edges."""
    findings = BUILD / "findings"
    findings.mkdir(parents=True, exist_ok=True)
    options = [
        f"-max_total_time={arguments.seconds}", f"-timeout={arguments.hang}", "-rss_limit_mb=1024",
        "-malloc_limit_mb=1024", "-print_final_stats=1", "-reload=0",
        f"-artifact_prefix={findings}/{target}-",
    ]
    if arguments.runs:
        options.append(f"-runs={arguments.runs}")
    words = HERE / "dictionaries" / f"{target}.dict"
    if words.is_file():
        options.append(f"-dict={words}")
    log = BUILD / f"{target}.log"
    kept = HERE / "corpus" / target
    inputs = [str(folder) for folder in (grown(target), *given(target), kept) if folder.is_dir()]
    with open(log, "wb") as stream:
        status = subprocess.run(
            command(target, *options, *inputs), stdout=stream, stderr=stream, env=environment(place),
            check=False).returncode
    text = log.read_text(errors="replace")
    edges = [int(number) for number in re.findall(r"\bcov: (\d+)", text)]
    executions = re.findall(r"stat::number_of_executed_units: (\d+)", text)
    spent = re.findall(r"Done \d+ runs in (\d+) second", text)
    return {"status": status, "edges": edges[-1] if edges else 0, "log": log,
            "executions": int(executions[-1]) if executions else 0,
            "seconds": int(spent[-1]) if spent else None}


def environment(place):
    symbolizer = shutil.which("llvm-symbolizer-14") or shutil.which("llvm-symbolizer") or ""
    return {"PATH": "/usr/bin:/bin", "TMPDIR": str(place), "ASAN_SYMBOLIZER_PATH": symbolizer,
            "ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=0"}


def quietly(target, place, *words):
    """Has a target do what takes no fuzzing, by edges alone; what it said."""
    return subprocess.run(
        command(target, "-use_counters=0", "-use_value_profile=0", *map(str, words)), env=environment(place),
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=True).stdout.decode(errors="replace")


def edges_of(target, place, *inputs):
    """How many edges all inputs in these folders reach together."""
    said = quietly(target, place, "-runs=0", *inputs)
    return int(re.findall(r"\bcov: (\d+)", said)[-1])


def keep(target, place):
    """Distills all short inputs into fuzz/corpus. Their number and bytes, and the edges before and after."""
    place = pathlib.Path(place)
    begun, short, chosen = place / "begun", place / "short", place / "chosen"
    for folder in (begun, short, chosen):
        folder.mkdir()
    for number, file in enumerate(files_in(*given(target))):
        shutil.copy(file, begun / f"{number}-{file.name}")
    kept = HERE / "corpus" / target
    for file in files_in(kept, grown(target)):
        if file.stat().st_size <= KEPT_BYTES:
            shutil.copy(file, short / file.name)
    shutil.copytree(begun, chosen, dirs_exist_ok=True)
    quietly(target, place, "-set_cover_merge=1", chosen, short)
    for file in begun.iterdir():
        (chosen / file.name).unlink()
    before, after = edges_of(target, place, begun, short), edges_of(target, place, begun, chosen)
    if not lost(before, after):
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(chosen, kept)
    files = list(chosen.iterdir())
    return len(files), sum(file.stat().st_size for file in files), before, after


def lost(before, after):
    return after < (1 - MOST_LOST) * before


def tell_kept(target, place):
    """Keeps what is worth it, and says what that is; whether no edge was lost."""
    count, size, before, after = keep(target, place)
    verdict = "  LOST TOO MANY, and left fuzz/corpus as it was" if lost(before, after) else ""
    print(f"{target:<12}{count:>6} inputs, {size} bytes: {after} edges, {before} before{verdict}", flush=True)
    return not verdict


def fuzz(target, arguments, place):
    """Fuzzes, and says how far that saw; whether nothing is wrong."""
    result = run(target, arguments, place)
    verdict = ""
    if result["status"] != 0:
        verdict = f"  FOUND SOMETHING, see {result['log']}"
    elif result["edges"] < LEAST_EDGES.get(target, 500):
        verdict = f"  BLIND: fewer than {LEAST_EDGES.get(target, 500)} edges"
    seconds = "-" if result["seconds"] is None else result["seconds"]
    print(f"{target:<12}{result['executions']:>12}{seconds:>9}{result['edges']:>8}{verdict}", flush=True)
    return not verdict


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--runs", type=int, default=0)
    parser.add_argument("--hang", type=int, default=2)
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--minimise", action="store_true")
    parser.add_argument("targets", nargs="*")
    arguments = parser.parse_args()
    known = known_targets()
    wrong = [target for target in arguments.targets if target not in known]
    if wrong or not known:
        print(f"fuzz: no target {' '.join(wrong)}; built are: {' '.join(known)}", file=sys.stderr)
        return 2
    well = True
    if not arguments.minimise:
        print(f"{'target':<12}{'executions':>12}{'seconds':>9}{'edges':>8}")
    for target in sorted(arguments.targets or known, key=lambda name: (name in LENT, name)):
        with tempfile.TemporaryDirectory(dir=MEMORY if MEMORY.is_dir() else None) as place:
            fine = arguments.minimise or fuzz(target, arguments, place)
            if fine and (arguments.keep or arguments.minimise):
                fine = tell_kept(target, place)
            well = well and fine
    return 0 if well else 1


if __name__ == "__main__":
    sys.exit(main())
