#!/usr/bin/env python3
"""Holds source files and functions small: no file over 350 lines, no function in C++ over 60.

    tools/check_sizes.py [ROOT]      ROOT is the repository, by default the one this file stands in

A function counts from the line its head begins on to its last brace; lambdas and local classes count to
the function they stand in. Of a constructor the list of members does not count where it has braces.
Prints what is too long, with file and line, and exits 1 if anything is.
"""

import pathlib
import re
import sys

FOLDERS = ("src", "include", "tests", "benchmarks", "fuzz", "examples", "tools")
MOST_OF_FILE = 350
MOST_OF_FUNCTION = 60

# What may hold braces that are none, or words that mean nothing here.
SILENT = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<end>\w*)\(.*?\)(?P=end)"|"(?:\\.|[^"\\\n])*"'
    r"|\b\d[\w.']*|'(?:\\.|[^'\\\n])+'|^[ \t]*#(?:\\\n|[^\n])*",
    re.DOTALL | re.MULTILINE)
TEMPLATE = re.compile(r"\btemplate\s*<(?:[^<>]|<(?:[^<>]|<[^<>]*>)*>)*>")
NEXT = re.compile(r"\S")
SCOPE = re.compile(r"\s*(?:(?:inline )?namespace|extern(?=\s*$)|class|struct|union)\b")


def without_words(source):
    """The source with comments, texts, numbers and macros blank, its lines where they were."""
    return SILENT.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), source)


def functions_of(source):
    """The functions that stand in namespaces and classes, as (first line, count of lines, head)."""
    text = without_words(source)
    begin = 0  # of the statement
    within = 0  # braces of a function or a table that is being passed over
    head = None
    for found in re.finditer(r"[{};]|\b(?:public|private|protected):", text):
        mark = found.group()
        if within:
            within += {"{": 1, "}": -1}.get(mark, 0)
            if within:
                continue
            if head:
                first = text.count("\n", 0, start) + 1
                yield first, text.count("\n", 0, found.start()) + 2 - first, head
        elif mark == "{":
            said = TEMPLATE.sub("", text[begin:found.start()])
            if not SCOPE.match(said):
                within = 1
                start = NEXT.search(text, begin).start()
                head = " ".join(said.split()) if "(" in said else None
                continue
        begin = found.end()


def faults_of(file):
    """What is too long in one file, as (line, message)."""
    source = file.read_text(encoding="utf-8")
    count = len(source.splitlines())
    if count > MOST_OF_FILE:
        yield 1, f"{count} lines, of at most {MOST_OF_FILE}"
    if file.suffix == ".py":
        return
    for line, length, head in functions_of(source):
        if length > MOST_OF_FUNCTION:
            yield line, f"a function of {length} lines, of at most {MOST_OF_FUNCTION}: {head[:60]}"


def check(root):
    """All the faults under root, as lines to print."""
    for folder in FOLDERS:
        for file in sorted((pathlib.Path(root) / folder).rglob("*")):
            if file.suffix in {".h", ".cpp", ".py"}:
                for line, message in faults_of(file):
                    yield f"{file.relative_to(root).as_posix()}:{line}: {message}"


def main(arguments):
    root = arguments[1] if len(arguments) > 1 else pathlib.Path(__file__).resolve().parent.parent
    faults = list(check(root))
    print("\n".join(faults) if faults else "no file and no function is too long")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
