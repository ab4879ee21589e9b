#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
The large libraries that read files from outside are in scipd-read, and in no other program; GDAL, which takes longest
to load, is in a module of scipd-read: linked_libraries_test.py READER PROGRAMS...
"""
import re
import subprocess
import sys

FOREIGN = re.compile(r"lib(assimp|gdal|tiff|turbojpeg)\.so")


def foreign(program):
    linked = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    return sorted(set(FOREIGN.findall(linked)))


def main():
    reader, *others = sys.argv[1:]
    assert foreign(reader) == ["assimp", "tiff", "turbojpeg"], f"{reader} links {foreign(reader)}"
    found = [f"{program} links {foreign(program)}" for program in others if foreign(program)]
    sys.exit("\n".join(found) or None)


main()
