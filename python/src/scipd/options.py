# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""The command line of a scipd for a test: free ports, and files in a folder of its own."""

from __future__ import annotations

import json
import os
import pathlib
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

from .program import find_world

PathLike = Union[str, "os.PathLike[str]"]
ConfigLike = Union[PathLike, Mapping[str, Any]]

# What a service manager says to the test is not said to its scipd.
_NOT_HANDED_ON = ("NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID", "LISTEN_FDS", "LISTEN_PID", "LISTEN_FDNAMES",
                  "JOURNAL_STREAM", "INVOCATION_ID")
# A scanner in the plane of the floor sees what stands on it or not, by chance. In the maze scipd mounts it so as well.
_MOUNT = "0,0,0.25,0,0,0"
# How a source of poses begins that is no file.
_LIVE = ("udp:", "vda5050:", "gz:", "ros2:", "rosbridge:")


def is_live(poses: object) -> bool:
    return isinstance(poses, str) and poses.startswith(_LIVE)


def environment_for(folder: pathlib.Path) -> Dict[str, str]:
    environment = {key: value for key, value in os.environ.items() if key not in _NOT_HANDED_ON}
    return {**environment, "RUNTIME_DIRECTORY": str(folder)}


def options(folder: pathlib.Path, *, world: Optional[PathLike], model: str, config: Optional[ConfigLike],
            poses: Optional[str], clock: str, accuracy: Optional[str], seed: Optional[int],
            args: Sequence[str]) -> List[str]:
    """Without the program. What `args` has as well is left to it. `poses` are those that scipd reads itself."""
    if clock not in ("wall", "poses"):
        raise ValueError(f"clock is 'wall' or 'poses', not {clock!r}")
    chosen: Dict[str, Optional[str]] = {
        "--control": str(folder / "control.sock"), "--http": "127.0.0.1:0", "--clock": clock,
        "--scene": None if world is None else find_world(world), "--seed": None if seed is None else str(seed),
        "--poses": poses}
    if config is None:
        chosen.update({"--model": model, "--tcp": "127.0.0.1:0", "--pty": "auto", "--accuracy": accuracy,
                       "--mount": None if world is None or "--sensor-from" in args else _MOUNT})
    else:
        if accuracy is not None:
            raise ValueError("accuracy is of one scanner: with config=, write it there")
        chosen["--config"] = _config_file(folder, config)
    given = {argument.split("=", 1)[0] for argument in args}
    line = [part for option, value in chosen.items() if value is not None and option not in given
            for part in (option, value)]
    return [*line, *args]


def _config_file(folder: pathlib.Path, config: ConfigLike) -> str:
    """A file as it is. A dict becomes one in the folder of this scipd, as JSON is YAML as well."""
    if not isinstance(config, Mapping):
        return os.fspath(config)
    file = folder / "scipd.yaml"
    file.write_text(json.dumps(config))
    return str(file)
