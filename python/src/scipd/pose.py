# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Where a robot or a model is. Metres and radians; x forward, y left, z up. Values."""

from __future__ import annotations

import math
import sys
import warnings
from dataclasses import dataclass
from typing import Any, Dict, Iterator, Sequence, Tuple, Union

Vector = Tuple[float, float, float]
Quaternion = Tuple[float, float, float, float]
PoseLike = Union["Pose", Sequence[float]]


@dataclass(frozen=True)
class Pose:
    xyz: Vector
    q: Quaternion = (0.0, 0.0, 0.0, 1.0)  # x, y, z, w

    @staticmethod
    def of(value: PoseLike) -> "Pose":
        """Of (x, y, yaw), of (x, y, z, roll, pitch, yaw), or of a pose."""
        if isinstance(value, Pose):
            return value
        numbers = tuple(float(number) for number in value)
        if len(numbers) == 3:
            numbers = (*numbers[:2], 0.0, 0.0, 0.0, numbers[2])
        if len(numbers) != 6 or not all(map(math.isfinite, numbers)):
            raise ValueError(f"a pose is (x, y, yaw) or (x, y, z, roll, pitch, yaw), not {value!r}")
        x, y, z, roll, pitch, yaw = numbers
        _warn_of_degrees((roll, pitch, yaw))
        return Pose((x, y, z), _quaternion(roll, pitch, yaw))

    @staticmethod
    def from_json(value: Dict[str, Any]) -> "Pose":
        x, y, z = value["xyz"]
        qx, qy, qz, qw = value["q"]
        return Pose((x, y, z), (qx, qy, qz, qw))

    def as_json(self) -> Dict[str, Any]:
        return {"xyz": list(self.xyz), "q": list(self.q)}

    @property
    def x(self) -> float:
        return self.xyz[0]

    @property
    def y(self) -> float:
        return self.xyz[1]

    @property
    def z(self) -> float:
        return self.xyz[2]

    @property
    def rpy(self) -> Vector:
        """Roll, pitch and yaw."""
        x, y, z, w = self.q
        return (math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
                math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x)))),
                math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))

    @property
    def yaw(self) -> float:
        return self.rpy[2]

    def __iter__(self) -> Iterator[float]:
        """x, y, z, roll, pitch, yaw."""
        return iter((*self.xyz, *self.rpy))


def _warn_of_degrees(angles: Vector) -> None:
    """Where one is more than a full turn, and all have at most one decimal: as scipd does with poses of a file."""
    if any(abs(angle) > 2 * math.pi for angle in angles) and all(round(angle, 1) == angle for angle in angles):
        degrees = ", ".join(f"{angle:g}" for angle in angles if angle)
        radians = ", ".join(f"{math.radians(angle):.6g}" for angle in angles if angle)
        warnings.warn(f"{degrees} looks like degrees, but angles of a pose are radians; did you mean {radians}?",
                      UserWarning, stacklevel=_level_of_the_test())


def _level_of_the_test() -> int:
    """The level, as warn() counts, of the line outside of this package that led here."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        level, frame = level + 1, frame.f_back
    return level


def _quaternion(roll: float, pitch: float, yaw: float) -> Quaternion:
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    return (sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy)


def between(a: Pose, b: Pose, share: float) -> Pose:
    """On the straight and even way from a to b."""
    x, y, z = (p + share * (q - p) for p, q in zip(a.xyz, b.xyz))
    dot = sum(p * q for p, q in zip(a.q, b.q))
    sign = -1.0 if dot < 0 else 1.0
    angle = math.acos(min(1.0, abs(dot)))
    if angle < 1e-6:
        return Pose((x, y, z), a.q)
    of_a, of_b = math.sin((1 - share) * angle), sign * math.sin(share * angle)
    q = [(of_a * p + of_b * r) / math.sin(angle) for p, r in zip(a.q, b.q)]
    return Pose((x, y, z), (q[0], q[1], q[2], q[3]))
