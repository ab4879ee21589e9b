# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Reads what a program prints with --help, for itself and for each of its commands."""
import dataclasses
import os
import re
import subprocess

INDENT = 30  # of what an option does


@dataclasses.dataclass
class Entry:
    """An option, an argument or a command, as it is typed, and what it does."""
    name: str
    what: str


@dataclasses.dataclass
class Help:
    command: str
    what: str
    usage: str
    groups: dict
    footer: list
    commands: list


def printed(command):
    """It names no folder of whoever builds the page."""
    environment = {key: value for key, value in os.environ.items() if key != "RUNTIME_DIRECTORY"}
    done = subprocess.run([*command, "--help"], capture_output=True, text=True, check=True, timeout=60,
                          env=environment | {"XDG_RUNTIME_DIR": "$XDG_RUNTIME_DIR"})
    return done.stdout.splitlines()


def entries(lines):
    """What an entry does begins in a column, on the next line where the name is too long, and goes on below."""
    found = []
    for line in filter(str.strip, lines):
        if line.startswith(" " * INDENT):
            found[-1].what = f"{found[-1].what} {line.strip()}".strip()
            continue
        both = re.fullmatch(r"  (\S.*?)  +(\S.*)|.*", line)
        if both[2] and both.start(2) == INDENT:
            found.append(Entry(both[1], both[2]))
        else:
            found.append(Entry(line.strip(), ""))
    return found


def sections(lines):
    """(title, lines) of each group of options or arguments, then (None, footer)."""
    number = 0
    while number < len(lines):
        title = re.fullmatch(r"(\S.*):", lines[number])
        below = lines[number + 1] if number + 1 < len(lines) else ""
        if title and (below.startswith("  -") or title[1] in ("Positionals", "Subcommands")):
            end = number + 1
            while end < len(lines) and lines[end].startswith("  "):
                end += 1
            yield title[1], lines[number + 1:end]
            number = end
        elif lines[number]:
            yield None, lines[number:]
            return
        else:
            number += 1


def read_help(program, path=(), name=None):
    """`path` are the commands that lead to this one."""
    lines = printed([program, *path])
    usage = next(number for number, line in enumerate(lines) if line.startswith("Usage: "))
    groups, footer, commands = {}, [], []
    for title, body in sections(lines[usage + 1:]):
        if title is None:
            footer = body
        elif title == "Subcommands":
            commands = [read_help(program, (*path, entry.name), name) for entry in entries(body)]
        else:
            groups[title] = entries(body)
    what = " ".join(lines[:usage]).strip()
    return Help(" ".join([name, *path]), what, lines[usage].removeprefix("Usage: "), groups, footer, commands)
