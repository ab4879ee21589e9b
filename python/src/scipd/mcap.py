# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
Scans in an MCAP file, by its public specification (https://mcap.dev/spec), which Foxglove, Lichtblick and scipcat read.
Each scanner has a topic, whose messages are foxglove.LaserScan in JSON with the members that scipcat adds: distances_mm
and stamp_ms as they were sent. No chunks, no index: a file whose writer was killed has all that was written.
"""

from __future__ import annotations

import json
import struct
from typing import Any, BinaryIO, Dict

_MAGIC = b"\x89MCAP0\r\n"
_HEADER, _FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _DATA_END = 1, 2, 3, 4, 5, 15
_NUMBERS: Dict[str, Any] = {"type": "array", "items": {"type": "number"}}
_XYZ: Dict[str, Any] = {"type": "object", "properties": {axis: {"type": "number"} for axis in "xyz"}}
_XYZW: Dict[str, Any] = {"type": "object", "properties": {axis: {"type": "number"} for axis in "xyzw"}}
_LASER_SCAN: Dict[str, Any] = {
    "title": "foxglove.LaserScan", "type": "object", "properties": {
        "timestamp": {"type": "object", "title": "time",
                      "properties": {"sec": {"type": "integer"}, "nsec": {"type": "integer"}}},
        "frame_id": {"type": "string"},
        "pose": {"title": "foxglove.Pose", "type": "object", "properties": {"position": _XYZ, "orientation": _XYZW}},
        "start_angle": {"type": "number"}, "end_angle": {"type": "number"},
        "ranges": _NUMBERS, "intensities": _NUMBERS, "distances_mm": _NUMBERS, "stamp_ms": {"type": "integer"},
        "first_step": {"type": "integer"}}}


def _text(text: str) -> bytes:
    data = text.encode()
    return struct.pack("<I", len(data)) + data


class McapWriter:
    """Writes messages in JSON; one thread."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._channels: Dict[str, int] = {}
        file.write(_MAGIC)
        self._record(_HEADER, _text("") + _text("scipd"))
        schema = json.dumps(_LASER_SCAN).encode()
        self._record(_SCHEMA, struct.pack("<H", 1) + _text("foxglove.LaserScan") + _text("jsonschema") +
                     struct.pack("<I", len(schema)) + schema)

    def write(self, topic: str, time_ns: int, message: Dict[str, Any]) -> None:
        channel = self._channels.get(topic)
        if channel is None:
            channel = self._channels[topic] = len(self._channels) + 1
            self._record(_CHANNEL, struct.pack("<HH", channel, 1) + _text(topic) + _text("json") +
                         struct.pack("<I", 0))
        self._record(_MESSAGE, struct.pack("<HIQQ", channel, 0, time_ns, time_ns) + json.dumps(message).encode())

    def finish(self) -> None:
        self._record(_DATA_END, struct.pack("<I", 0))
        self._record(_FOOTER, struct.pack("<QQI", 0, 0, 0))
        self._file.write(_MAGIC)

    def _record(self, kind: int, content: bytes) -> None:
        self._file.write(struct.pack("<BQ", kind, len(content)) + content)
