# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Finds the program scipd: what SCIPD names, then PATH, then a build folder beside this package."""

from __future__ import annotations

import os
import pathlib
import shutil

from .errors import ScipdNotFound

# In the sources this file is ROOT/python/src/scipd/program.py.
_ROOT = pathlib.Path(__file__).resolve().parent.parent.parent.parent
# What a user would most likely mean comes first.
_PRESETS = ("release", "ci", "dev")


def find_program() -> str:
    """The path of scipd. Raises ScipdNotFound."""
    named = os.environ.get("SCIPD")
    if named:
        found = shutil.which(named)
        if found:
            return os.path.abspath(found)
        raise ScipdNotFound(f"SCIPD names {named}, which is no program that can be run")
    found = shutil.which("scipd")
    if found:
        return os.path.abspath(found)
    for preset in _PRESETS:
        built = _ROOT / "build" / preset / "bin" / "scipd"
        if os.access(built, os.X_OK):
            return str(built)
    raise ScipdNotFound("there is no program scipd: install the package scipd, put scipd on the PATH, or let the "
                        "environment variable SCIPD name it")
