# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""A client's conversation with one scanner: one scan, or a stream of consecutive ones. In lockstep time goes on while
it waits, and stands again as soon as a scan is there, before the next revolution begins. One thread."""

from __future__ import annotations

from typing import Optional

from .clock import Clock
from .errors import NoScan
from .line import Line
from .scan import Scan, angles_of
from .scip import Parameters, parameters_of, scan_request, status_of, values_of

# In lockstep, the step of time before the scanner has told its speed of rotation.
_STEP_S = 0.002
_SHORTEST_STEP_S = 0.0005
_REFUSED = ("0E", "0F")


class Known:
    """Facts about a scanner that do not change from one conversation to the next."""

    parameters: Optional[Parameters] = None
    has_intensities = True  # until it has refused them


class Conversation:
    """A context manager, which closes the line. All methods raise NoScan."""

    def __init__(self, line: Line, clock: Clock, sensor: str, known: Known, timeout_s: float) -> None:
        self._line, self._clock, self._sensor, self._known = line, clock, sensor, known
        self._timeout_s = timeout_s
        self._meanwhile = self._let_time_go_on if clock.leads else None
        self._sweep_s = 0.0  # time that passes for certain before the next scan
        self._request = ""
        clock.go_with(line.take_in)

    def __enter__(self) -> "Conversation":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        self._clock.go_without(self._line.take_in)
        self._line.close()

    def answers(self, timeout_s: float) -> bool:
        """False: another client has the scanner."""
        try:
            self._line.ask("VV", timeout_s, self._meanwhile)
            return True
        except NoScan:
            return False

    @property
    def parameters(self) -> Parameters:
        known = self._known.parameters
        if known is None:
            known = self._known.parameters = parameters_of(self._ask("PP"))
        return known

    def begin(self, scans: int) -> None:
        """Asks for so many scans, 0: without end."""
        status = ""
        for with_intensities in (True, False):
            if with_intensities and not self._known.has_intensities:
                continue
            self._request = scan_request(self.parameters, with_intensities, scans)
            status = status_of(self._ask(self._request))
            if with_intensities and status in _REFUSED:
                self._known.has_intensities = False
            else:
                break
        if status != "00":
            raise NoScan(f"the scanner has answered {self._request} with {status}")
        self._sweep_s = self.parameters.sweep_s

    def next_scan(self) -> Scan:
        # The echo of a counted stream has the scans that remain.
        message = self._line.message(self._request[:-2], self._timeout_s, self._meanwhile)
        if status_of(message) != "99":
            raise NoScan(f"in the place of a scan came {status_of(message)}")
        self._sweep_s = self.parameters.sweep_s
        return self._scan_of(message)

    def _ask(self, request: str) -> bytes:
        return self._line.ask(request, self._timeout_s, self._meanwhile)

    def _let_time_go_on(self) -> None:
        """At first by the sweep of a revolution, then by half the time that passes between two sweeps: so time stands
        before the next revolution begins, and whatever the caller changes now holds for all of it."""
        parameters = self._known.parameters
        step_s = _STEP_S if parameters is None else max(_SHORTEST_STEP_S,
                                                        (parameters.turn_s - parameters.sweep_s) / 2)
        step_s, self._sweep_s = self._sweep_s or step_s, 0.0
        self._clock.run(step_s)

    def _scan_of(self, message: bytes) -> Scan:
        parameters = self.parameters
        stamp_ms, sent_mm, intensities = values_of(message, self._request.startswith("ME"))
        nearest, farthest = parameters.dmin_mm, parameters.dmax_mm
        steps = range(parameters.first_step, parameters.first_step + len(sent_mm))
        return Scan(self._sensor, [mm / 1000 if nearest <= mm <= farthest else None for mm in sent_mm], intensities,
                    stamp_ms, angles_of(steps, parameters.front_step, parameters.steps_per_turn), sent_mm)
