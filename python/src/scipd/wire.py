# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""The conversation of scanners with their clients, as scipd tells it: requests, replies, scans, what faults made of
them. Heard from the start of scipd on; any thread."""

from __future__ import annotations

import collections
import json
import threading
import time
from dataclasses import dataclass
from typing import Any, Deque, Dict, Iterator, List, Optional

from .control import quoted
from .errors import ScipdError
from .listener import Listener

# An hour of a scanner at 40 Hz takes more, and a test that fails has its reason near its end.
_MOST = 20000


@dataclass(frozen=True)
class WireMessage:
    sensor: str
    client: str  # "tcp" or "tty"
    time_s: float
    sender: str  # "client" or "scanner"
    line: str  # the request, or the echo of a reply
    status: Optional[str]  # of a reply
    means: str
    bytes: int
    dropped: int  # so many before it were left out

    @staticmethod
    def of(message: Dict[str, Any]) -> "WireMessage":
        return WireMessage(message["sensor"], message["client"], message["time_s"], message["from"], message["line"],
                           message["status"], message["means"], message["bytes"], message.get("dropped", 0))

    def __str__(self) -> str:
        arrow = ">" if self.sender == "client" else "<"
        lost = f"({self.dropped} messages are left out)\n" if self.dropped else ""
        status = f" {self.status}" if self.status else ""
        return f"{lost}{self.time_s:.6f} {self.sensor} {self.client} {arrow} {self.line}{status}: {self.means}"


class Wire:
    """What was said so far: iterable, with a length, and as text."""

    def __init__(self) -> None:
        self._messages: Deque[WireMessage] = collections.deque(maxlen=_MOST)
        self._news = threading.Condition()
        self._listeners: List[Listener] = []

    def listen(self, control: str, sensor: str) -> None:
        self._listeners.append(Listener(control, f"/wire?sensor={quoted(sensor)}", self._hear))

    def close(self) -> None:
        """What was said stays."""
        for listener in self._listeners:
            listener.close()

    def __iter__(self) -> Iterator[WireMessage]:
        with self._news:
            return iter(list(self._messages))

    def __len__(self) -> int:
        return len(self._messages)

    def __str__(self) -> str:
        return "".join(f"{message}\n" for message in self)

    @property
    def requests(self) -> List[str]:
        """What clients have asked, in order."""
        return [message.line for message in self if message.sender == "client"]

    def wait_for(self, request: str, timeout_s: float = 10.0) -> WireMessage:
        """The first request that begins so, such as MD: that of a driver that starts. Raises ScipdError."""
        end = time.monotonic() + timeout_s
        with self._news:
            while True:
                for message in self._messages:
                    if message.sender == "client" and message.line.startswith(request):
                        return message
                if not self._news.wait(end - time.monotonic()) and time.monotonic() >= end:
                    raise ScipdError(f"no client has asked {request} within {timeout_s} s; so far they have asked "
                                     f"{[m.line for m in self._messages if m.sender == 'client'][-10:] or 'nothing'}")

    def _hear(self, text: str) -> None:
        message = WireMessage.of(json.loads(text))
        with self._news:
            self._messages.append(message)
            self._news.notify_all()
