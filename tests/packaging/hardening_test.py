#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
The programs are hardened as Debian's hardening-check wants it, and bind all symbols at the start: hardening_test.py
PROGRAMS...
"""
import re
import subprocess
import sys


def readelf(program, *what):
    return subprocess.run(["readelf", "--wide", *what, program], capture_output=True, text=True, check=True).stdout


def faults(program):
    dynamic, segments, symbols = (readelf(program, what) for what in ("--dynamic", "--segments", "--dyn-syms"))
    if not re.search(r"\(FLAGS.*\).*\bNOW\b", dynamic):
        yield "binds symbols late"
    if "GNU_RELRO" not in segments:
        yield "may have its table of symbols overwritten"
    if not re.search(r"\(FLAGS_1\).*\bPIE\b", dynamic):
        yield "is at the same address each time"
    if not re.search(r" __\w+_chk@", symbols):
        yield "calls no checked functions of the C library"


def main():
    found = [f"{program} {fault}" for program in sys.argv[1:] for fault in faults(program)]
    sys.exit("\n".join(found) or None)


main()
