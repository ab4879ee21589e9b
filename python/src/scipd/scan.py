# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""A scan as a driver gets it, and the truth of one. Values."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Dict, List, NamedTuple, Optional, Tuple


class Seen(NamedTuple):
    """One beam of a scan."""

    range_m: float
    angle_rad: float  # 0 is ahead, counter-clockwise is positive
    object: Optional[str] = None  # MODEL::LINK::VISUAL, where the truth is known
    material: Optional[str] = None


@dataclass(frozen=True)
class Scan:
    """What a scanner has sent. Each list has an element for each step."""

    sensor: str
    ranges_m: List[Optional[float]]  # None: the scanner has sent a code
    intensities: Optional[List[int]]  # None: the model has none
    stamp_ms: int  # the scanner's clock, 24 bits
    angles_rad: List[float]
    sent_mm: List[int]  # ranges_m with the codes

    def __repr__(self) -> str:
        """One line: pytest shows it in each assertion that fails."""
        return _told(f"Scan of {self.sensor} at {self.stamp_ms} ms", self.ranges_m, self.nearest())

    def nearest(self) -> Optional[Seen]:
        """None: it has no range at all."""
        ranges = [(r, a) for r, a in zip(self.ranges_m, self.angles_rad) if r is not None]
        return Seen(*min(ranges)) if ranges else None

    def at(self, angle_rad: float) -> Optional[float]:
        """The range of the beam nearest to this direction."""
        return self.ranges_m[nearest_step(self.angles_rad, angle_rad)]


@dataclass(frozen=True)
class Truth:
    """What was true of a scan. Each list has an element for each step, None where the beam met nothing."""

    sensor: str
    ranges_m: List[Optional[float]]
    objects: List[Optional[str]]  # MODEL::LINK::VISUAL
    materials: List[Optional[str]]
    angles_rad: List[float]  # empty for cameras and rangers
    scan: int
    time_s: float
    raw: Dict[str, Any]  # all of it, as the control API tells it

    def __repr__(self) -> str:
        return _told(f"Truth of {self.sensor} at {self.time_s:.3f} s", self.ranges_m, self.nearest())

    def nearest(self) -> Optional[Seen]:
        """What is nearest. None: no beam met anything."""
        angles = self.angles_rad or [math.nan] * len(self.ranges_m)
        rays = [Seen(r, a, o, m) for r, a, o, m in zip(self.ranges_m, angles, self.objects, self.materials)
                if r is not None]
        return min(rays, key=lambda ray: ray.range_m) if rays else None

    def at(self, angle_rad: float) -> Optional[Seen]:
        """What the beam nearest to this direction met."""
        i = nearest_step(self.angles_rad, angle_rad)
        range_m = self.ranges_m[i]
        return None if range_m is None else Seen(range_m, self.angles_rad[i], self.objects[i], self.materials[i])


def _told(what: str, ranges_m: List[Optional[float]], nearest: Optional[Seen]) -> str:
    if nearest is None:
        return f"<{what}: {len(ranges_m)} steps, no range>"
    seen = f"{nearest.range_m:.3f} m at {nearest.angle_rad:.2f} rad"
    return f"<{what}: {len(ranges_m)} steps, the nearest {seen}{f', {nearest.object}' if nearest.object else ''}>"


def nearest_step(angles_rad: List[float], angle_rad: float) -> int:
    """Raises ValueError where the sensor does not look."""
    step = abs(angles_rad[1] - angles_rad[0]) if len(angles_rad) > 1 else math.inf
    found = min(range(len(angles_rad)), key=lambda i: abs(angles_rad[i] - angle_rad))
    if abs(angles_rad[found] - angle_rad) > step:
        degrees = f"; angles are radians: did you mean {math.radians(angle_rad):.4g}?" if abs(angle_rad) > 4 else ""
        raise ValueError(f"the scanner looks from {angles_rad[0]:.2f} to {angles_rad[-1]:.2f} rad, not to "
                         f"{angle_rad}{degrees}")
    return found


def angles_of(steps: "Tuple[int, ...] | List[int] | range", front_step: int, steps_per_turn: int) -> List[float]:
    return [(step - front_step) * 2 * math.pi / steps_per_turn for step in steps]
