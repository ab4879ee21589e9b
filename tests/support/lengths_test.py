#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# `lengths_test.py ROOT`: checks the width of the lines of every source, script and page, and the length of functions.
# It skips data: worlds, dialogues, recordings, results. universal-ctags finds the functions, so this needs no build.
import json
import pathlib
import re
import subprocess
import sys
import tempfile

WIDEST_SOURCE = 100
WIDEST_TEXT = 120
LONGEST_FUNCTION = 60
SHORT_FUNCTION = 20
SHORT_SHARE = 0.9

FOLDERS = ("cmake", "daemon", "docs", "examples", "packaging", "protocol", "python", "scenes", "sim", "testing",
           "tests", "tools")
SOURCES = (".h", ".cpp")
TEXTS = (".md", ".py", ".cmake", ".yaml", ".json", ".txt", ".js", ".css", ".html", "")
# Data, which was recorded, measured or generated.
DATA = re.compile(r"scenes/.*\.(json|txt)$|tests/(bench/results/.*\.txt|fuzz/corpus/|protocol/dialogues/.*\.txt"
                  r"|sim/loaders/worlds/)")


def texts(root):
    """The project's own files that people read, as paths from the root."""
    found = [path for path in root.iterdir() if path.is_file()]
    for folder in FOLDERS:
        found += [path for path in (root / folder).rglob("*") if path.is_file()]
    for path in sorted(found):
        name = path.relative_to(root).as_posix()
        if path.suffix in SOURCES + TEXTS and path.name[0] != "." and not DATA.match(name):
            yield name


def breakable(page):
    """A page without what cannot be broken: tables, links, and text quoted from programs and files."""
    quoted = False
    for line in page.splitlines():
        fence = line.lstrip().startswith("```")
        quoted ^= fence
        yield "" if quoted or fence or line.startswith("|") else re.sub(r"\]\([^)]*\)|https?://\S+", "", line)


def wide_lines(name, text):
    widest = WIDEST_SOURCE if name.endswith(SOURCES) else WIDEST_TEXT
    lines = breakable(text) if name.endswith(".md") else text.splitlines()
    return [f"{name}:{number}: {len(line)} columns" for number, line in enumerate(lines, 1) if len(line) > widest]


def functions(root, names):
    """(lines, file, line, name) of each function that is defined."""
    tags = subprocess.run(["ctags", "--output-format=json", "--fields=+ne", "--c++-kinds=f", "--python-kinds=fm",
                           "--map-C++=+.h", "--languages=C++,Python", "-f", "-", "-L", "-"],
                          input="\n".join(names), cwd=root, capture_output=True, text=True, check=True).stdout
    for tag in map(json.loads, tags.splitlines()):
        if "end" in tag:
            yield tag["end"] - tag["line"] + 1, tag["path"], tag["line"], tag["name"]


def check_itself():
    """Checks that each limit can fail."""
    assert not wide_lines("sim/a.cpp", "x" * 100 + "\n")
    assert wide_lines("sim/a.cpp", "\n" + "x" * 101) == ["sim/a.cpp:2: 101 columns"]
    assert not wide_lines("a.md", "y" * 120) and wide_lines("a.md", "y" * 121)
    assert not wide_lines("a.md", "|" + "z" * 200) and not wide_lines("a.md", "[x](" + "z" * 200 + ")")
    assert wide_lines("a.md", "```\n" + "z" * 200 + "\n```\n" + "z" * 200) == ["a.md:4: 200 columns"]
    assert not wide_lines("sim/a.cpp", "\u2502" * 100), "columns are characters, not bytes"
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "a.cpp").write_text("namespace a {\nstruct B {\n    int c() {" + "\n" * 60 + "    }\n};\n}\n")
        (root / "d.py").write_text("def e():\n" + "    pass\n" * 60)
        assert sorted(functions(root, ["a.cpp", "d.py"])) == [(61, "a.cpp", 3, "c"), (61, "d.py", 1, "e")]


def main():
    check_itself()
    root = pathlib.Path(sys.argv[1])
    names = list(texts(root))
    faults = []
    for name in names:
        faults += wide_lines(name, (root / name).read_text(encoding="utf-8"))

    all_functions = list(functions(root, [name for name in names if name.endswith(SOURCES + (".py",))]))
    assert len(all_functions) > 1000, "ctags sees hardly any functions"
    faults += [f"{file}:{line}: {name} has {lines} lines; a function has at most {LONGEST_FUNCTION}"
               for lines, file, line, name in all_functions if lines > LONGEST_FUNCTION]
    share = sum(lines <= SHORT_FUNCTION for lines, *_ in all_functions) / len(all_functions)
    if share < SHORT_SHARE:
        faults.append(f"only {share:.1%} of all functions have at most {SHORT_FUNCTION} lines")

    print(f"{len(names)} files, {len(all_functions)} functions, {share:.1%} of them of at most {SHORT_FUNCTION} lines")
    print("\n".join(faults))
    return 1 if faults else 0


sys.exit(main())
