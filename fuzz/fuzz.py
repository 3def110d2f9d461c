#!/usr/bin/env python3
"""Runs the fuzz targets one after the other, and tells how far each saw.

    fuzz/fuzz.py [--seconds N] [--runs N] [--hang S] [--keep] [TARGET...]

TARGET is toml, obj, mesh, image, scene, checkpoint: by default all. A target ends after so many
seconds or executions, whichever comes first; a crash, a leak, more than 1 GiB or an input that takes
longer than --hang seconds ends it at once, and leaves the input in build/fuzz/findings. What it
discovers is gathered in build/fuzz/corpus; --keep distills that into fuzz/corpus, for `make test` to
replay. Exits 1 if anything was found, or if a target saw much less than its seeds alone show: then it is blind.
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
LEAST_EDGES = {"toml": 1500, "obj": 1000, "mesh": 1000, "image": 500, "scene": 6000, "checkpoint": 3000}
LONGEST_INPUT = {"toml": 4096, "obj": 4096, "mesh": 4096, "scene": 4096, "image": 2048}
KEPT_BYTES = 2048  # a longer input is not kept in the repository
MEMORY = pathlib.Path("/dev/shm")


def known_targets():
    return sorted(path.name[len("fuzz_"):] for path in (BUILD / "fuzz").glob("fuzz_*") if path.is_file())


def folders(target):
    """Where a target's inputs lie; the first is the one that grows."""
    work = BUILD / "corpus" / target
    work.mkdir(parents=True, exist_ok=True)
    kept = [HERE / "seeds" / target, HERE / "corpus" / target]
    return [work] + [folder for folder in kept if folder.is_dir()]


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
    with open(log, "wb") as stream:
        status = subprocess.run(
            command(target, *options, *map(str, folders(target))), stdout=stream, stderr=stream,
            env=environment(place), check=False).returncode
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


def keep(target, place):
    """The fewest short inputs that reach all that was reached, into fuzz/corpus."""
    kept = HERE / "corpus" / target
    fresh = pathlib.Path(place) / "kept"
    fresh.mkdir()
    short = pathlib.Path(place) / "short"
    short.mkdir()
    for folder in folders(target):
        for file in folder.iterdir():
            if file.stat().st_size <= KEPT_BYTES:
                shutil.copy(file, short / file.name)
    subprocess.run(command(target, "-set_cover_merge=1", str(fresh), str(short)), env=environment(place),
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
    shutil.rmtree(kept, ignore_errors=True)
    shutil.copytree(fresh, kept)
    return sum(file.stat().st_size for file in kept.iterdir()), len(list(kept.iterdir()))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--runs", type=int, default=0)
    parser.add_argument("--hang", type=int, default=2)
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("targets", nargs="*")
    arguments = parser.parse_args()
    known = known_targets()
    wrong = [target for target in arguments.targets if target not in known]
    if wrong or not known:
        print(f"fuzz: no target {' '.join(wrong)}; built are: {' '.join(known)}", file=sys.stderr)
        return 2
    failed = False
    print(f"{'target':<12}{'executions':>12}{'seconds':>9}{'edges':>8}")
    for target in arguments.targets or known:
        with tempfile.TemporaryDirectory(dir=MEMORY if MEMORY.is_dir() else None) as place:
            result = run(target, arguments, place)
            verdict = ""
            if result["status"] != 0:
                verdict = f"  FOUND SOMETHING, see {result['log']}"
            elif result["edges"] < LEAST_EDGES.get(target, 500):
                verdict = f"  BLIND: fewer than {LEAST_EDGES.get(target, 500)} edges"
            failed = failed or bool(verdict)
            seconds = "-" if result["seconds"] is None else result["seconds"]
            print(f"{target:<12}{result['executions']:>12}{seconds:>9}{result['edges']:>8}{verdict}",
                  flush=True)
            if arguments.keep and not verdict:
                size, count = keep(target, place)
                print(f"{'':<12}kept {count} inputs, {size} bytes", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
