# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""What goes wrong at a scanner on purpose."""

from __future__ import annotations

from typing import Any, Dict, List, Optional

from .control import Control, quoted
from .errors import Refused


class Fault:
    """A fault that was asked for. As a context manager it ends with its block."""

    def __init__(self, control: Control, sensor: str, request: Dict[str, Any]) -> None:
        self._control = control
        self._faults = f"/sensors/{quoted(sensor)}/faults"
        self.sensor = sensor
        self.kind: str = request["kind"]
        answer = control.ask("POST", self._faults, request)
        self.id: int = answer["id"]
        self.notes: List[str] = answer.get("notes", [])

    @property
    def state(self) -> str:
        """waiting, active or ended."""
        return str(self._status()["state"])

    @property
    def hits(self) -> int:
        """How often it has acted."""
        return int(self._status()["hits"])

    @property
    def log(self) -> List[Dict[str, Any]]:
        """What it did, and when."""
        return [entry for entry in self._control.get(self._faults + "/log")["entries"] if entry["id"] == self.id]

    def stop(self) -> None:
        """Ends it, if it has not ended. The scanner is as if it had never been, but for what it has touched."""
        try:
            self._control.ask("DELETE", f"{self._faults}/{self.id}")
        except Refused as refused:
            if refused.status != 404:
                raise

    def __enter__(self) -> "Fault":
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def _status(self) -> Dict[str, Any]:
        status: Dict[str, Any] = self._control.get(f"{self._faults}/{self.id}")
        return status


def request_of(kind: str, after: float, seconds: Optional[float], members: Dict[str, Any]) -> Dict[str, Any]:
    """The request for a fault. `for_` is written so, as `for` is a word of Python."""
    request: Dict[str, Any] = {"kind": kind, **{key.rstrip("_"): value for key, value in members.items()}}
    if after:
        if "at" in request:
            raise TypeError("a fault begins either after= so many seconds, or at=")
        request["at"] = {"s": after}
    if seconds is not None:
        if "for" in request or "until" in request:
            raise TypeError("a fault lasts either seconds=, or for_=, or until=")
        request["for"] = {"s": seconds}
    return request
