#!/usr/bin/env python3
"""Holds the pages for people against the sources.

    tools/check_docs.py [ROOT]      ROOT is the repository, by default the one this file stands in

Of README.md, CONTRIBUTING.md, CHANGELOG.md and docs/*.md it checks that

- a link to a file, or to a heading in one, leads somewhere;
- a source file that is named in backquotes exists (`src/photon/radau.h`, or `photon/radau.h`);
- a number with a constant's name behind it, in a comment that no reader sees, is that constant:
      20<!-- trusted_drift in src/photon/drift.h -->
- no page counts the tests: such a count is wrong by tomorrow.

Prints what is wrong with file and line, and exits 1 if anything is.
"""

import pathlib
import re
import sys

LINK = re.compile(r"(?<!!)\[[^\]\n]*\]\(([^)\s]+)\)")
NAMED_FILE = re.compile(r"`((?:[a-z_]+/)+[a-z0-9_]+\.(?:h|cpp|py|toml|cmake))`")
CONSTANT = re.compile(r"([\d.,]*\d(?:e-?\d+)?)<!-- (\w+) in ([\w./]+) -->")
COUNTED = re.compile(r"\b\d{3,} (?:of \d+ )?tests\b")


def anchors_of(text):
    """What a link to a heading of the page is called."""
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings}


def value_of(name, source):
    """The number that the source gives a constant, or None."""
    found = re.search(rf"\b{name} = ([\d.]+(?:e-?\d+)?)", source)
    return float(found.group(1)) if found else None


def faults_of(root, page):
    """What is wrong with a page, as (line, message)."""
    text = page.read_text(encoding="utf-8")
    in_code = False
    for number, line in enumerate(text.splitlines(), start=1):
        if line.startswith("```"):
            in_code = not in_code
        if in_code:
            continue
        for target in LINK.findall(line):
            if "://" in target:
                continue
            name, _, anchor = target.partition("#")
            file = page.parent / name if name else page
            if not file.exists():
                yield number, f"the link leads to no file: {target}"
            elif anchor and file.suffix == ".md" and anchor not in anchors_of(file.read_text(encoding="utf-8")):
                yield number, f"the link leads to no heading: {target}"
        for name in NAMED_FILE.findall(line):
            if not ((root / name).exists() or (root / "src" / name).exists()):
                yield number, f"there is no file {name}"
        for stated, name, file in CONSTANT.findall(line):
            source = root / file
            value = value_of(name, source.read_text(encoding="utf-8")) if source.exists() else None
            if value is None:
                yield number, f"{file} gives no {name}"
            elif value != float(stated.replace(",", "")):
                yield number, f"{name} is {value:g} in {file}, not {stated}"
        if COUNTED.search(line):
            yield number, "a count of tests is wrong by tomorrow: leave it out"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[1])
    pages = [root / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")]
    pages = [page for page in pages if page.exists()] + sorted((root / "docs").glob("*.md"))
    wrong = False
    for page in pages:
        for number, message in faults_of(root, page):
            print(f"{page.relative_to(root)}:{number}: {message}")
            wrong = True
    if not wrong:
        print(f"{len(pages)} pages agree with the sources")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
