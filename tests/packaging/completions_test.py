#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
What shells offer, asked of the shells themselves: completions_test.py COMPLETIONS BIN WORLD. A shell that is not there
is left out, but bash must be. A scipd runs meanwhile, whose names they offer.
"""
import contextlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

FOLDER, BIN, WORLD = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])

# What is typed up to the cursor, and words that must be offered, and words that must not.
CASES = [
    ("scipd --acc", ["--accuracy"], ["--model"]),
    ("scipd --accuracy ", ["ideal", "sensor", "material"], ["--accuracy"]),
    ("scipd --model UTM", ["UTM-30LX", "UTM-30LX-EW"], ["UST-10LX"]),
    ("scipd --backend ", ["auto", "reference"], ["--model"]),
    ("scipd --model=UTM", ["UTM-30LX", "UTM-30LX-EW"], ["UST-10LX", "--model"]),
    ("scipd --backend=", ["auto", "reference"], ["--model"]),
    ("scipcat plot x --color ", ["distance", "intensity", "material", "error"], ["--color"]),
    ("scipcat ", ["info", "record", "plot", "compare", "check", "completion"], ["--baud"]),
    ("scipcat check --", ["--section", "--unsafe", "--junit", "--html", "--json"], ["--color"]),
    ("scipcat tw", ["twin"], ["truth"]),
    ("scipcat twin --", ["--output", "--seconds", "--json"], ["--scans"]),
    ("scipcat compare --", ["--no-fit", "--stream-a", "--output", "--json"], ["--color"]),
    ("scipcat plot --in", ["--intensity"], ["info"]),
    ("scipctl pose p", ["play"], ["get"]),
    ("scipctl --control x pose play --sp", ["--speed"], ["--control"]),
    ("scipctl scene add --con", ["--control"], ["--scale"]),
    ("scipctl scene medium ", ["fog", "rain"], ["list"]),
    ("scipctl scene map --", ["--output", "--resolution"], ["--replace"]),
    ("scipctl completion ", ["bash", "zsh", "fish"], ["status"]),
    ("scipfit ro", ["room"], ["export"]),
    ("scipfit --", ["--room", "--report", "--output"], ["--for"]),
    ("scipfit export x --for ", ["amcl", "gz", "mvsim", "stage"], ["--for"]),
    ("scipbench com", ["compare", "completion"], ["table3"]),
    ("scipd --vers", ["--version"], ["--help"]),
    ("scipctl --vers", ["--version"], ["--help"]),
    ("scipctl pose get --", ["--json"], ["--version"]),
    # What the scipd that runs meanwhile knows.
    ("scipctl fault start ", ["tank/top", "stall", "reboot"], ["tank"]),
    ("scipctl fault start tank/top st", ["stall", "status"], ["freeze"]),
    ("scipctl fault stop ", ["tank/top"], ["stall"]),
    ("scipctl truth ", ["tank/top"], ["tank"]),
    ("scipctl pose set ", ["tank"], ["tank/top"]),
    ("scipctl pose play --robot ", ["tank"], ["tank/top"]),
    ("scipctl scene remove ", ["room"], ["tank"]),
    ("scipcat plot x --truth ", ["tank/top"], ["tank"]),
]

# Where a file is due. zsh offers files beside these completions, and bash where they offer nothing.
FILES = ["scipctl scene load ", "scipctl scene add x ", "scipctl fleet add x ", "scipctl scenario run ",
         "scipctl pose play "]


def bash(program, line, home):
    words = [word for word in re.split(r"(=)| ", line) if word is not None]
    if words[-2:] == ["=", ""]:
        words.pop()  # the cursor is at the =
    script = (f"source {FOLDER}/{program}.bash; COMP_WORDS=(); for word in \"$@\"; do COMP_WORDS+=(\"$word\"); done; "
              f"COMP_CWORD={len(words) - 1}; $(complete -p {program} | sed 's/.*-F \\([^ ]*\\).*/\\1/'); "
              "printf '%s\\n' \"${COMPREPLY[@]}\"")
    return run(["bash", "-c", script, "bash", *words], home)


def fish(program, line, home):
    """It offers --model=UTM-30LX as a whole."""
    script = f"source {FOLDER}/{program}.fish; complete --do-complete '{line}'"
    return [word.rpartition("=")[2] for word in run(["fish", "--no-config", "-c", script], home)]


def zsh(program, line, home):
    """zsh finds the function in a folder. What it hands to compadd is offered where it begins as typed."""
    shutil.copy(FOLDER / f"{program}.zsh", home / f"_{program}")
    script = (f"fpath=({home} $fpath); autoload -Uz _{program}; _files() {{}}; compset() {{}}; "
              "compadd() { shift; print -rl -- \"$@\" }; "
              f"words=(\"$@\"); CURRENT=$#; _{program}")
    words = line.split(" ")
    begun = words[-1].rpartition("=")[2]
    return [word for word in run(["zsh", "-fc", script, "zsh", *words], home) if word.startswith(begun)]


def run(command, home):
    environment = {"HOME": str(home), "PATH": f"{BIN}:/usr/bin:/bin", "TERM": "dumb", "LC_ALL": "C.UTF-8",
                   "XDG_RUNTIME_DIR": str(home)}
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, env=environment, check=True)
    return [line.split("\t")[0].strip() for line in done.stdout.splitlines()]


def faults(shell, line, wanted, unwanted, home):
    program = line.split(" ")[0]
    if not (FOLDER / f"{program}.bash").exists():
        return  # scipbench, of a build without a depth buffer
    offered = shell(program, line, home)
    for word in wanted:
        if word not in offered:
            yield f"{shell.__name__}: {line!r} does not offer {word}, but {offered}"
    for word in unwanted:
        if word in offered:
            yield f"{shell.__name__}: {line!r} offers {word}"


@contextlib.contextmanager
def running_scipd(home):
    daemon = subprocess.Popen(
        [BIN / "scipd", "--scene", WORLD, "--name", "tank/top", "--tcp", "none"], stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL, text=True,
        env={key: value for key, value in os.environ.items() if key != "RUNTIME_DIRECTORY"} | {"XDG_RUNTIME_DIR": home})
    try:
        assert "ready" in daemon.stdout.readline()
        yield
    finally:
        daemon.terminate()
        daemon.wait(timeout=30)


def main():
    found = []
    with tempfile.TemporaryDirectory() as home, running_scipd(home):
        for shell in (bash, zsh, fish):
            if shutil.which(shell.__name__) is None:
                print(f"{shell.__name__} is not here")
                assert shell is not bash
                continue
            for line, wanted, unwanted in CASES:
                found += faults(shell, line, wanted, unwanted, pathlib.Path(home))
        for line in FILES:
            found += [f"bash: {line!r} offers {word}" for word in bash("scipctl", line, pathlib.Path(home)) if word]
            if shutil.which("fish"):
                found += faults(fish, line + "/usr/bi", ["/usr/bin/"], [], pathlib.Path(home))
    sys.exit("\n".join(found) or None)


if __name__ == "__main__":
    main()
