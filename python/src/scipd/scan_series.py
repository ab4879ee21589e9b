# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Consecutive scans of one scanner, or of several in step."""

from __future__ import annotations

from typing import Iterator, List, Optional, Sequence, Tuple

from .errors import ScipdError
from .scan import Scan
from .sensor import Sensor

_STAMPS_PER_WRAP = 1 << 24
# The scanner's clock and that of scipd are compared again after this time: they may differ by some 0.01 %.
_TRUSTED_MS = 10_000


class Series:
    """The scans of one scanner, each with the time when it begins. Ends with close()."""

    def __init__(self, sensor: Sensor, timeout_s: float) -> None:
        self.sensor = sensor
        self._scans = sensor.stream(timeout_s)
        self._now_ms = 0  # of its own clock, which does not wrap
        self._offset_ms: Optional[float] = None  # from there to scipd's
        self._compared_ms = 0
        self._held: Optional[Scan] = None

    def close(self) -> None:
        close = getattr(self._scans, "close")
        close()

    def __iter__(self) -> Iterator[Scan]:
        return self

    def __next__(self) -> Scan:
        scan = next(self._scans)
        self._now_ms += (scan.stamp_ms - self._now_ms) % _STAMPS_PER_WRAP
        self._held = scan
        return scan

    @property
    def stamp_ms(self) -> int:
        """Of the latest scan, by the scanner's clock, but without its wrap."""
        return self._now_ms

    def time_s(self) -> float:
        """When the latest scan began, by scipd's clock."""
        if self._held is not None and (self._offset_ms is None or self._now_ms - self._compared_ms > _TRUSTED_MS):
            try:
                self._offset_ms = self.sensor.truth(of=self._held).time_s * 1000 - self._now_ms
                self._compared_ms = self._now_ms
            except ScipdError:  # a slow test gets scans that are too old for that
                if self._offset_ms is None:
                    raise
        return (self._now_ms + (self._offset_ms or 0)) / 1000

    def nearest_to(self, time_s: float) -> Scan:
        """The scan that began nearest to that time. Times must grow."""
        while self._held is None or self.time_s() < time_s - self.sensor.turn_s / 2:
            next(self)
        return self._held


def limited(series: Series, seconds: Optional[float], count: Optional[int]) -> Iterator[Scan]:
    """Ends with the series closed."""
    try:
        first_ms, number = 0, 0
        while count is None or number < count:
            scan = next(series)
            first_ms = first_ms if number else series.stamp_ms
            if seconds is not None and series.stamp_ms - first_ms >= 1000 * seconds:
                return
            number += 1
            yield scan
    finally:
        series.close()


def in_step(sensors: Sequence[Sensor], seconds: Optional[float], count: Optional[int],
            timeout_s: float) -> Iterator[Tuple[Scan, ...]]:
    """The slowest scanner sets the pace: with each of its scans come those of the others that began nearest to it."""
    every: List[Series] = [Series(sensor, timeout_s) for sensor in sensors]
    try:
        for series in every:
            next(series)
        slowest = max(every, key=lambda series: series.sensor.turn_s)
        for scan in limited(slowest, seconds, count):
            time_s = slowest.time_s()
            yield tuple(scan if series is slowest else series.nearest_to(time_s) for series in every)
    finally:
        for series in every:
            series.close()
