# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""SCIP as a host speaks it, as far as one scan needs it: requests, sums, and what a scan says. No I/O."""

from __future__ import annotations

from typing import Dict, List, NamedTuple, Optional

from .errors import NoScan

_DISTANCE_CHARACTERS = 3
_STAMP_CHARACTERS = 4

# For any model: what is less is a code, and a UST sends 65533 where nothing comes back. PP of a model says more.
NEAREST_MM = 20
NOTHING_MM = 65533


class Parameters(NamedTuple):
    """What PP tells that a scan needs."""

    dmin_mm: int
    dmax_mm: int
    first_step: int
    last_step: int
    front_step: int
    steps_per_turn: int
    turns_per_minute: int

    @property
    def turn_s(self) -> float:
        return 60 / self.turns_per_minute

    @property
    def sweep_s(self) -> float:
        """From the begin of a revolution to its last step."""
        return self.turn_s * self.last_step / self.steps_per_turn


class Values(NamedTuple):
    stamp_ms: int
    distances_mm: List[int]
    intensities: Optional[List[int]]


def scan_request(parameters: Parameters, with_intensities: bool, scans: int) -> str:
    """So many scans, from the next whole revolution on; 0: without end. It switches the laser on and off by itself."""
    command = "ME" if with_intensities else "MD"
    return f"{command}{parameters.first_step:04}{parameters.last_step:04}010{scans:02}"


def sum_is_right(line: bytes) -> bool:
    return len(line) > 1 and (sum(line[:-1]) & 0x3F) + 0x30 == line[-1]


def status_of(message: bytes) -> str:
    """The two characters behind the echo."""
    lines = message.split(b"\n")
    if len(lines) < 2 or not sum_is_right(lines[1]):
        raise NoScan(f"the scanner has answered {message[:60]!r}, whose status has a wrong sum")
    return lines[1][:-1].decode("latin-1")


def parameters_of(message: bytes) -> Parameters:
    """Of the answer to PP: lines such as `DMIN:20;5`, whose sum is behind the semicolon."""
    fields: Dict[str, str] = {}
    for line in message.decode("latin-1").split("\n")[2:]:
        key, colon, value = line.partition(":")
        if colon:
            fields[key] = value.rpartition(";")[0]
    try:
        return Parameters(*(int(fields[key]) for key in ("DMIN", "DMAX", "AMIN", "AMAX", "AFRT", "ARES",
                                                      "SCAN")))
    except (KeyError, ValueError) as error:
        raise NoScan(f"the scanner has answered PP with {message[:200]!r}, which lacks {error}") from None


def values_of(message: bytes, with_intensities: bool) -> Values:
    """Of a scan, whose status is 99. Raises NoScan where a sum is wrong."""
    _, _, stamp, *data = message.split(b"\n")
    for number, line in enumerate([stamp, *data], 3):
        if not sum_is_right(line):
            raise NoScan(f"line {number} of the scan has a wrong sum: {line!r}")
    block = b"".join(line[:-1] for line in data)
    size = _DISTANCE_CHARACTERS
    values = [_decoded(block[i:i + size]) for i in range(0, len(block), size)]
    stamp_ms = _decoded(stamp[:_STAMP_CHARACTERS])
    return Values(stamp_ms, values[::2], values[1::2]) if with_intensities else Values(stamp_ms, values, None)


def _decoded(characters: bytes) -> int:
    value = 0
    for character in characters:
        value = value << 6 | (character - 0x30)
    return value
