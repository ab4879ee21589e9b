# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
Scans in a file while scipd runs: all from now on, or the last seconds of a test that has failed. They come from scipd
itself and not from the wire, so a driver notices nothing. scipd computes each turn while somebody records.
"""

from __future__ import annotations

import collections
import json
import math
import os
import pathlib
import re
import threading
from typing import Any, BinaryIO, Deque, Dict, Optional, Tuple, Union

from .control import quoted
from .listener import Listener
from .mcap import McapWriter
from .scip import NEAREST_MM, NOTHING_MM

PathLike = Union[str, "os.PathLike[str]"]
_TIME = re.compile(r'"time_s":([-+.\deE]+)')


def laser_scan(scan: Dict[str, Any]) -> Dict[str, Any]:
    """A message of /stream as foxglove.LaserScan. What is no distance reads 0 there: those who show scans know no
    codes."""
    step = 2 * math.pi / scan["steps_per_turn"]
    first = (scan["first_step"] - scan["front_step"]) * step
    seconds = math.floor(scan["time_s"])
    x, y, z = scan["pose"]["xyz"]
    qx, qy, qz, qw = scan["pose"]["q"]
    return {
        "timestamp": {"sec": seconds, "nsec": round((scan["time_s"] - seconds) * 1e9) % 1000000000},
        "frame_id": "world",
        "pose": {"position": {"x": x, "y": y, "z": z}, "orientation": {"x": qx, "y": qy, "z": qz, "w": qw}},
        "start_angle": first, "end_angle": first + (len(scan["sent_mm"]) - 1) * step,
        "ranges": [mm / 1000 if mm >= NEAREST_MM and mm != NOTHING_MM else 0 for mm in scan["sent_mm"]],
        "intensities": scan["intensity"], "distances_mm": scan["sent_mm"], "stamp_ms": scan["stamp_ms"],
        "first_step": scan["first_step"]}


class _File:
    """A recording as its name says: .mcap, or .jsonl with a message of /stream a line."""

    def __init__(self, path: PathLike) -> None:
        ending = pathlib.Path(path).suffix
        if ending not in (".mcap", ".jsonl"):
            raise ValueError(f"a recording ends with .mcap or .jsonl, not {os.fspath(path)!r}")
        self._file: BinaryIO = open(path, "wb")
        self._mcap = McapWriter(self._file) if ending == ".mcap" else None
        self.scans = 0

    def write(self, text: str) -> None:
        scan = json.loads(text)
        if "sent_mm" not in scan:  # a fault, or what a camera or a ranger reads
            return
        self.scans += 1
        if self._mcap is None:
            self._file.write(text.encode() + b"\n")
            return
        self._mcap.write(f"/{scan['sensor']}/scan", max(0, round(scan["time_s"] * 1e9)),
                         laser_scan(scan))

    def close(self) -> None:
        if self._mcap is not None:
            self._mcap.finish()
        self._file.close()


class Recording:
    """Writes until stop() or the end of scipd. A context manager."""

    def __init__(self, control: str, path: PathLike, sensor: Optional[str]) -> None:
        self._file = _File(path)
        self._lock = threading.Lock()
        self._stopped = False
        target = "/stream" + (f"?sensor={quoted(sensor)}" if sensor else "")
        try:
            self._listener = Listener(control, target, self._hear)
        except BaseException:
            self._file.close()
            raise

    @property
    def scans(self) -> int:
        """How many it has written."""
        return self._file.scans

    def catch_up(self) -> None:
        self._listener.catch_up()

    def stop(self) -> None:
        self._listener.close()
        with self._lock:
            if not self._stopped:
                self._stopped = True
                self._file.close()

    def __enter__(self) -> "Recording":
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def _hear(self, text: str) -> None:
        with self._lock:
            if not self._stopped:
                self._file.write(text)


class LastScans:
    """Keeps what /stream has told in the last seconds, to be written when a test has failed."""

    def __init__(self, control: str, seconds: float) -> None:
        self._seconds = seconds
        self._kept: Deque[Tuple[float, str]] = collections.deque()
        self._listener = Listener(control, "/stream", self._hear)

    def save(self, path: PathLike) -> int:
        """How many scans there were."""
        file = _File(path)
        try:
            for _, text in list(self._kept):
                file.write(text)
        finally:
            file.close()
        return file.scans

    def catch_up(self) -> None:
        self._listener.catch_up()

    def close(self) -> None:
        self._listener.close()

    def _hear(self, text: str) -> None:
        found = _TIME.search(text)
        if found is None:
            return
        time_s = float(found[1])
        self._kept.append((time_s, text))
        while self._kept and self._kept[0][0] < time_s - self._seconds:
            self._kept.popleft()
