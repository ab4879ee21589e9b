# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""A robot of a running scipd: where it is, and how it moves."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Callable, Optional, Union

from .clock import Clock, path_of
from .control import Control
from .drive import Drive
from .pose import Pose, PoseLike, Quaternion, Vector
from .trajectory import Trajectory, TrajectoryLike


@dataclass(frozen=True)
class RobotPose(Pose):
    """Where a robot was when it was asked; play() has it drive."""

    _drive: Union[Callable[[Trajectory], Drive], None] = field(default=None, compare=False, repr=False)

    def play(self, source: TrajectoryLike, speed: float = 1.0) -> Drive:
        """As Robot.play()."""
        if self._drive is None:
            raise TypeError("only the pose of a robot plays a drive")
        return self._drive(Trajectory.of(source, speed))


class Robot:
    def __init__(self, control: Control, clock: Clock, name: str, poses_at: Optional[str] = None) -> None:
        self.name = name
        self.poses_at = poses_at  # where a simulator sends its poses, such as udp:127.0.0.1:14550
        self._control = control
        self._clock = clock

    @property
    def pose(self) -> RobotPose:
        """Set it to (x, y, yaw) or to (x, y, z, roll, pitch, yaw): the robot is there at once."""
        at = Pose.from_json(self._control.get(path_of("robot", self.name)))
        xyz: Vector = at.xyz
        q: Quaternion = at.q
        return RobotPose(xyz, q, lambda trajectory: self._clock.drive(self.name, trajectory))

    @pose.setter
    def pose(self, value: PoseLike) -> None:
        self._clock.place("robot", self.name, Pose.of(value))

    def play(self, source: TrajectoryLike, speed: float = 1.0) -> Drive:
        """Has it drive along a TUM file, or along [(seconds, pose), ...], evenly between these. It returns at once: on
        the wall clock the robot moves meanwhile, in lockstep it moves with clock.run()."""
        return self._clock.drive(self.name, Trajectory.of(source, speed))
