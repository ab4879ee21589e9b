# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""A drive: poses at times. Read from a TUM file or made from pairs. A value."""

from __future__ import annotations

import bisect
import math
import os
import pathlib
from typing import Iterable, List, Sequence, Tuple, Union

from .errors import ScipdError
from .pose import Pose, PoseLike, between

TrajectoryLike = Union[str, "os.PathLike[str]", Iterable[Tuple[float, PoseLike]]]


class Trajectory:
    """Times are seconds from its begin."""

    def __init__(self, times_s: Sequence[float], poses: Sequence[Pose], speed: float = 1.0) -> None:
        if not times_s or not speed > 0:
            raise ValueError("a drive needs a pose and a speed above 0")
        self.times_s: List[float] = [(time - times_s[0]) / speed for time in times_s]
        self.poses = list(poses)
        if any(b <= a for a, b in zip(self.times_s, self.times_s[1:])):
            raise ValueError("the times of a drive must grow")

    @staticmethod
    def of(source: TrajectoryLike, speed: float = 1.0) -> "Trajectory":
        """Of a TUM file, or of [(seconds, pose), ...]."""
        if isinstance(source, (str, os.PathLike)):
            return _read_tum(pathlib.Path(source), speed)
        pairs = [(float(time), Pose.of(pose)) for time, pose in source]
        return Trajectory([time for time, _ in pairs], [pose for _, pose in pairs], speed)

    @property
    def seconds(self) -> float:
        return self.times_s[-1]

    def at(self, time_s: float) -> Pose:
        """Before its begin its first pose, after its end its last."""
        after = bisect.bisect_right(self.times_s, time_s)
        if after == 0 or after == len(self.times_s):
            return self.poses[0 if after == 0 else -1]
        begin, end = self.times_s[after - 1], self.times_s[after]
        return between(self.poses[after - 1], self.poses[after], (time_s - begin) / (end - begin))

    def next_time(self, time_s: float) -> float:
        """Of the first pose later than that; infinite behind the last."""
        after = bisect.bisect_right(self.times_s, time_s)
        return self.times_s[after] if after < len(self.times_s) else math.inf


def _read_tum(file: pathlib.Path, speed: float) -> Trajectory:
    times: List[float] = []
    poses: List[Pose] = []
    for number, line in enumerate(file.read_text(encoding="utf-8-sig").splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        try:
            t, x, y, z, qx, qy, qz, qw = map(float, line.split())
        except ValueError:
            raise ScipdError(f"{file}:{number}: is no line of TUM (t tx ty tz qx qy qz qw), the only format that this "
                             "package reads itself; scipctl pose play reads others") from None
        if times and t == times[-1]:
            continue  # as scipd reads it: the first pose of a stamp
        times.append(t)
        poses.append(Pose((x, y, z), (qx, qy, qz, qw)))
    if not poses:
        raise ScipdError(f"{file}: holds no pose")
    return Trajectory(times, poses, speed)
