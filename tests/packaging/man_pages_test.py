#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
Man pages tell all that --help and docs/configuration.md tell, and groff and mandoc find no fault in them. --help fits a
terminal, and has nothing in the words of the library that reads options.

  man_pages_test.py PAGES BIN SOURCES
"""
import pathlib
import re
import shutil
import subprocess
import sys

PAGES, BIN, SOURCES = (pathlib.Path(argument) for argument in sys.argv[1:4])


def printed(*command):
    words = [str(word) for word in command]
    return subprocess.run(words, capture_output=True, text=True, check=True, timeout=60).stdout


def rendered(page):
    """As a reader sees it, in one line. Words are not cut."""
    lines = ".hy 0\n.nh\n.ll 200n\n" + page.read_text()
    groff = ["groff", "-man", "-Tascii", "-P-cbou", "-rHY=0"]
    text = subprocess.run(groff, input=lines, capture_output=True, text=True, check=True, timeout=60).stdout
    return " ".join(text.split())


def helps(program, path=()):
    """What --help prints, for the program and for all its commands."""
    text = printed(program, *path, "--help")
    yield text
    listed = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.MULTILINE)
    for line in listed[1].splitlines() if listed else []:
        if line[2] != " ":
            yield from helps(program, (*path, line.split()[0]))


def words_of(help_text):
    """Options, and the words of what they do, from each line below a title."""
    for line in help_text.splitlines():
        if re.match(r"  -", line):
            yield from re.findall(r"(?<![\w:])--?[a-z][\w-]*", line.split("  ")[1])
        if line.startswith(" " * 30):
            yield line.strip().replace("`", "")


def faults_of_help(help_text):
    """Lines are wider only where a single word is, or an example."""
    for line in help_text.splitlines():
        if re.search(r"\b(INT|UINT|FLOAT|ENUM)\b|Excludes:|Needs:|REQUIRED|2147483647|PATH\(", line):
            yield f"--help is not for people: {line}"
        if line.startswith(" " * 30) and len(line) > 100:
            yield f"--help has a line of {len(line)} columns: {line}"


def keys_of(page):
    return re.findall(r"^\| `([a-z_0-9]+)` \|", page, re.MULTILINE)


def faults_in(page, text, expected):
    return [f"{page.name} lacks: {words}" for words in expected if " ".join(words.split()) not in text]


def lint(page):
    checks = [["groff", "-man", "-ww", "-z", "-Tutf8", "-Kutf8", page]]
    if shutil.which("mandoc"):
        checks.append(["mandoc", "-Tlint", page])
    for check in checks:
        done = subprocess.run(check, capture_output=True, text=True, timeout=60)
        yield from (done.stdout + done.stderr).splitlines()


def main():
    faults = []
    pages = sorted(PAGES.glob("*.[15]"))
    assert len(pages) >= 4, pages
    for page in pages:
        text = rendered(page)
        faults += lint(page)
        if page.name == "scipd.yaml.5":
            expected = keys_of((SOURCES / "docs/configuration.md").read_text())
        else:
            texts = list(helps(BIN / page.stem))
            expected = [words for help_ in texts for words in words_of(help_)]
            faults += [fault for help_ in texts for fault in faults_of_help(help_)]
        assert len(expected) > 5, (page, expected)
        faults += faults_in(page, text, expected)
    sys.exit("\n".join(faults) or None)


if __name__ == "__main__":
    main()
