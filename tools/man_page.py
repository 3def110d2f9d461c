#!/usr/bin/env python3
"""The manual page of the program, from what its --help says.

    man_page.py PROGRAM > portalens.1
"""
import re
import subprocess
import sys


def escaped(line):
    """A line of text for roff, that may begin with a control character."""
    line = line.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + line if line.startswith((".", "'")) else line


def verbatim(text):
    lines = [escaped(line) for line in text.strip("\n").splitlines()]
    return "\n".join([".nf", *lines, ".fi"])


def help_of(program, *words):
    return subprocess.run([program, *words, "--help"], check=True, text=True,
                          stdout=subprocess.PIPE).stdout


def commands_in(text):
    listed = text[text.index("Subcommands:"):].splitlines()[1:]
    names = []
    for line in listed:
        if not line.strip():
            break
        name = re.match(r"  ([a-z]+)\s", line)
        if name:
            names.append(name.group(1))
    return names


def main():
    program = sys.argv[1]
    version = subprocess.run([program, "--version"], check=True, text=True,
                             stdout=subprocess.PIPE).stdout.split()[-1]
    usage = help_of(program)
    parts = [f'.TH PORTALENS 1 "" "portalens {version}" "User Commands"',
             ".SH NAME", "portalens \\- renders scenes whose light bends and goes through portals",
             ".SH DESCRIPTION", verbatim(usage)]
    for command in commands_in(usage):
        parts += [f".SH PORTALENS {command.upper()}", verbatim(help_of(program, command))]
    print("\n".join(parts))


if __name__ == "__main__":
    main()
