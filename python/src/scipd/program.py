# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Finds the program scipd: what SCIPD names, then PATH, then a build folder beside this package. Finds the scenes that
ship with it."""

from __future__ import annotations

import os
import pathlib
import re
import shutil
from typing import Dict, Union

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


def find_world(world: Union[str, "os.PathLike[str]"]) -> str:
    """The path of a scene that ships with scipd, such as square_room; any other world stays as it is. Raises ValueError
    where a plain name is neither."""
    path = os.fspath(world)
    if not re.fullmatch(r"\w+", path) or os.path.exists(path):
        return path
    scenes = _scenes()
    if path in scenes:
        return str(scenes[path])
    raise ValueError(f"there is no file {path!r} here, and no scene of that name ships with scipd; there are: "
                     f"{', '.join(sorted(scenes)) or 'none'}")


def _scenes() -> Dict[str, pathlib.Path]:
    """By name: those of the program, which is PREFIX/bin/scipd or ROOT/build/PRESET/bin/scipd, else those of the
    sources or of the Debian package."""
    prefix = pathlib.Path(os.path.realpath(find_program())).parent.parent
    for folder in (prefix / "share" / "scipd" / "scenes", prefix.parent.parent / "scenes", _ROOT / "scenes",
                   pathlib.Path("/usr/share/scipd/scenes")):
        maps = [file for file in folder.glob("*.yaml") if file.with_suffix(".pgm").exists()]
        scenes = {file.stem: file for file in (*maps, *folder.glob("*.sdf"))}
        if scenes:
            return scenes
    return {}
