# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""A sensor of a running scipd: where it listens, what it sends, and what was true."""

from __future__ import annotations

import json
import time
from typing import Any, Dict, Iterator, List, Optional, Tuple

from .clock import Clock
from .control import Control, quoted
from .conversation import Conversation, Known
from .errors import NoScan, Refused, ScipdError
from .line import Line
from .scan import Scan, Truth, angles_of
from .websocket import WebSocket, WebSocketClosed

# In lockstep time goes on so far at once, while somebody waits for a truth: less than a turn of any scanner.
_TURN_S = 0.02
# A scanner whose TCP port somebody else uses lets a second client wait.
_IS_FREE_S = 1.0
# Half of the minute for which scipd keeps truths after a request for one.
_KEEPS_S = 30.0
# Those of a second, of the fastest scanner.
_MOST_TURNS_KEPT = 100


class Sensor:
    def __init__(self, control: Control, clock: Clock, told: Dict[str, Any]) -> None:
        """`told`: of the ready line."""
        self._control = control
        self._clock = clock
        self.name: str = told["name"]
        self.model: str = told["model"]
        host, _, port = (told.get("tcp") or "").rpartition(":")
        self.host: Optional[str] = host or None
        self.port: Optional[int] = int(port) if port else None
        self.tty: Optional[str] = told.get("pty")
        self._known = Known()
        self._asked_s: Optional[float] = None  # when it was last asked for a truth
        self._turn: Optional[Tuple[int, int]] = None  # the step that looks ahead, and how many there are in a turn

    @property
    def is_scanner(self) -> bool:
        return self.port is not None or self.tty is not None

    @property
    def status(self) -> Dict[str, Any]:
        """How it is doing, as the control API tells it."""
        status: Dict[str, Any] = self._control.get(f"/sensors/{quoted(self.name)}")
        return status

    def scan(self, timeout_s: float = 10.0) -> Scan:
        """The next whole revolution, over the wire as a driver gets it, with whatever goes wrong on purpose."""
        with self._conversation(timeout_s) as conversation:
            try:
                self._begin(conversation, 1)
                return conversation.next_scan()
            except NoScan as error:
                raise self._explained(error) from None

    def stream(self, timeout_s: float = 10.0) -> Iterator[Scan]:
        """Consecutive scans without end, as long as somebody iterates over them."""
        with self._conversation(timeout_s) as conversation:
            try:
                self._begin(conversation, 0)
                while True:
                    yield conversation.next_scan()
            except NoScan as error:
                raise self._explained(error) from None

    @property
    def turn_s(self) -> float:
        """The time of a revolution, once there was a scan; else 0."""
        return self._known.parameters.turn_s if self._known.parameters else 0.0

    def truth(self, of: Optional[Scan] = None, timeout_s: float = 10.0) -> Truth:
        """Of the next turn; or of a scan, if that is less than a second old. No driver notices it."""
        if of is not None:
            return self._truth_of(of)
        path = f"/stream?sensor={quoted(self.name)}"
        try:
            stream = WebSocket(self._control.path, path)
        except (OSError, WebSocketClosed) as error:
            raise self._control.why_gone() from error
        try:
            self._wait_for_scan(stream, timeout_s)
            return self._truth()  # of that turn, or of one after it
        finally:
            stream.close()

    def keep_scans(self) -> None:
        """For a minute scipd keeps the truth of the last second."""
        now_s = self._clock.lately_s
        if now_s is not None and self._asked_s is not None and 0 <= now_s - self._asked_s < _KEEPS_S:
            return
        self._asked_s = now_s
        try:
            self._control.get(self._truth_path())
        except Refused as refused:
            if refused.status != 404:
                raise

    # From here on: scans.

    def _conversation(self, timeout_s: float) -> Conversation:
        """By TCP where that is free, else by the tty."""
        if self.port is None and self.tty is None:
            raise ScipdError(f"{self.name} is no scanner that can be reached: it has neither TCP nor a tty")
        if self.host is not None and self.port is not None:
            nobody = self.status["clients"] == 0
            by_tcp = self._by(Line.tcp((self.host, self.port)), timeout_s)
            if nobody or by_tcp.answers(_IS_FREE_S):
                return by_tcp
            by_tcp.close()
        if self.tty is None:
            raise NoScan(f"{self.name} serves one TCP client at a time, and another one is connected: give it a tty "
                         "(pty: auto), or ask for truth()")
        return self._by(Line.tty(self.tty), timeout_s)

    def _by(self, line: Line, timeout_s: float) -> Conversation:
        return Conversation(line, self._clock, self.name, self._known, timeout_s)

    def _begin(self, conversation: Conversation, scans: int) -> None:
        self.keep_scans()
        conversation.begin(scans)
        parameters = conversation.parameters
        self._turn = (parameters.front_step, parameters.steps_per_turn)

    def _explained(self, error: NoScan) -> NoScan:
        faults = [fault["kind"] for fault in self._control.get(f"/sensors/{quoted(self.name)}/faults")
                  if fault["state"] == "active"]
        wrong = f"; on purpose it has: {', '.join(faults)}" if faults else ""
        return NoScan(f"{self.name} ({self.model}) has sent no scan: {error}. Its state is "
                      f"'{self.status['state']}'{wrong}")

    # From here on: the truth.

    def _truth_path(self, scan: Optional[int] = None) -> str:
        return f"/sensors/{quoted(self.name)}/truth" + ("" if scan is None else f"?scan={scan}")

    def _wait_for_scan(self, stream: WebSocket, timeout_s: float) -> None:
        """Until there is one that begins after now."""
        begin_s = self._clock.time_s
        end = time.monotonic() + timeout_s
        while True:
            try:
                message = json.loads(stream.receive(0.01 if self._clock.leads else max(0.01, end - time.monotonic())))
                if message.get("time_s", -1) >= begin_s:
                    if "front_step" in message:
                        self._turn = (message["front_step"], message["steps_per_turn"])
                    return
            except TimeoutError:
                if time.monotonic() > end:
                    raise NoScan(f"{self.name} has measured nothing within {timeout_s} s; its state is "
                                 f"'{self.status['state']}'") from None
                if self._clock.leads:
                    self._clock.run(_TURN_S)
            except WebSocketClosed as error:
                raise self._control.why_gone() from error

    def _truth_of(self, scan: Scan) -> Truth:
        latest = self._truth()
        if latest.raw.get("stamp_ms") == scan.stamp_ms:
            return latest
        # There is none of turns that nobody wanted.
        for number in range(latest.scan - 1, latest.scan - _MOST_TURNS_KEPT, -1):
            try:
                truth = self._truth(number)
            except Refused:
                continue
            if truth.raw.get("stamp_ms") == scan.stamp_ms:
                return truth
        raise ScipdError(f"scipd keeps no truth of the scan with the stamp {scan.stamp_ms} ms: ask within a second")

    def _truth(self, scan: Optional[int] = None) -> Truth:
        raw = self._control.get(self._truth_path(scan))
        return Truth(self.name, raw["true_m"], raw["object"], raw["material"], self._angles(raw), raw["scan"],
                     raw["time_s"], raw)

    def _angles(self, raw: Dict[str, Any]) -> List[float]:
        return angles_of(raw["steps"], *self._turn) if "steps" in raw and self._turn else []
