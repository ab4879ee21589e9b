# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
What time is, and how it goes on: by itself on the wall clock, or in lockstep by the stamps that this package sends.
Poses are set here too, since in lockstep they are the stamps.
"""

from __future__ import annotations

import time
from typing import Callable, Dict, List, Optional, Tuple

from .control import Control, quoted
from .drive import Drive, LockstepDrive, WallDrive
from .errors import ScipdError, TimeStandsStill
from .pose import Pose
from .stamped_poses import StampedPoses
from .trajectory import Trajectory

# Each time that it goes on by itself, or that somebody takes a scan.
_PATIENCE_S = 30.0
_STEP_US = 100_000
# So many steps are sent before scipd is asked how far it is: it keeps only so many poses that are yet to come.
_STEPS_AHEAD = 10


def path_of(kind: str, name: str) -> str:
    """`kind`: robot or model."""
    return f"/robots/{quoted(name)}/pose" if kind == "robot" else f"/scene/models/{quoted(name)}/pose"


class Clock:
    """The wall clock, and what all clocks share."""

    leads = False  # whether run() makes time go on, rather than wait for it

    def __init__(self, control: Control, robots: List[str]) -> None:
        self._control = control
        self._robots = robots
        self._drives: Dict[str, Drive] = {}
        self._slow: List[Callable[[], None]] = []

    @property
    def time_s(self) -> float:
        """scipd's time: seconds since its start, or in lockstep the stamp."""
        return float(self._control.get(path_of("robot", self._robots[0]))["t"])

    @property
    def lately_s(self) -> Optional[float]:
        """A time without asking scipd, to be compared with another one of these; None: only scipd knows."""
        return time.monotonic()

    def run(self, seconds: float) -> None:
        """Returns when so much time has passed."""
        time.sleep(max(0.0, seconds))

    def place(self, kind: str, name: str, pose: Pose) -> None:
        """Puts a robot or a model there at once, and ends the drive that moves it."""
        self._end_drive(name)
        self._control.ask("PUT", path_of(kind, name), pose.as_json())

    def drive(self, robot: str, trajectory: Trajectory) -> Drive:
        """Has a robot move like this from now on."""
        self._end_drive(robot)
        self._drives[robot] = WallDrive(self._control.path, robot, trajectory)
        return self._drives[robot]

    def go_with(self, catch_up: Callable[[], None]) -> None:
        """In lockstep time waits for this at each step: a recording that falls behind would lose scans."""
        self._slow.append(catch_up)

    def go_without(self, catch_up: Callable[[], None]) -> None:
        self._slow.remove(catch_up)

    def close(self) -> None:
        for robot in list(self._drives):
            self._end_drive(robot)

    def _catch_up(self) -> None:
        for catch_up in self._slow:
            catch_up()

    def _end_drive(self, robot: str) -> None:
        drive = self._drives.pop(robot, None)
        if drive is not None:
            drive.stop()


class LedClock(Clock):
    """In lockstep by the poses of others, such as a simulator that sends them by UDP."""

    @property
    def lately_s(self) -> Optional[float]:
        return None

    def run(self, seconds: float) -> None:
        wait_for_time(self, self.time_s + seconds, self._catch_up)

    def place(self, kind: str, name: str, pose: Pose) -> None:
        raise ScipdError(f"the {kind} {name} cannot be put anywhere: in lockstep the source of the poses leads time, "
                         "so it has to move things as well")

    def drive(self, robot: str, trajectory: Trajectory) -> Drive:
        raise ScipdError(f"the robot {robot} cannot be driven: in lockstep the source of the poses leads time")


class LockstepClock(Clock):
    """In lockstep by our own stamps, which begin with 0. Between run() and run() time stands still."""

    leads = True

    def __init__(self, control: Control, robots: List[str]) -> None:
        super().__init__(control, robots)
        self._stamps = StampedPoses(control.path)
        self._now_us = 0
        self._moving: Dict[str, Tuple[int, Trajectory]] = {}  # since when, and how
        self._resting: Dict[str, Pose] = {robot: self._pose("robot", robot) for robot in robots}

    @property
    def lately_s(self) -> Optional[float]:
        return self._now_us / 1e6

    def run(self, seconds: float) -> None:
        end_us = self._now_us + round(max(0.0, seconds) * 1e6)
        steps = 0
        while self._now_us < end_us:
            self._now_us = min(end_us, self._next_stop_us())
            self._say()
            steps += 1
            if self._slow or steps % _STEPS_AHEAD == 0 or self._now_us == end_us:
                self._settle()

    def place(self, kind: str, name: str, pose: Pose) -> None:
        # From a pose to the next one a thing moves evenly, but not within a microsecond: that is a jump.
        self._end_drive(name)
        for there in (self._pose(kind, name), pose, pose):
            self._stamps.say(self._now_us, {(kind, name): there})
        if kind == "robot":
            self._resting[name] = pose
        self._settle()

    def drive(self, robot: str, trajectory: Trajectory) -> Drive:
        self.place("robot", robot, trajectory.poses[0])
        self._moving[robot] = (self._now_us, trajectory)

        def left_s() -> float:
            return max(0.0, trajectory.seconds - (self._now_us - self._moving[robot][0]) / 1e6)

        def is_on() -> bool:
            return self._moving.get(robot, (0, None))[1] is trajectory and left_s() > 0

        self._drives[robot] = LockstepDrive(lambda: left_s() if is_on() else 0.0, self.run,
                                            lambda: self._rest(robot) if is_on() else None)
        return self._drives[robot]

    def close(self) -> None:
        self._drives.clear()
        self._stamps.close()

    def _pose(self, kind: str, name: str) -> Pose:
        return Pose.from_json(self._control.get(path_of(kind, name)))

    def _rest(self, robot: str) -> None:
        since_us, trajectory = self._moving.pop(robot)
        self._resting[robot] = trajectory.at((self._now_us - since_us) / 1e6)

    def _next_stop_us(self) -> int:
        stop_us = self._now_us + _STEP_US
        for since_us, trajectory in self._moving.values():
            next_s = trajectory.next_time((self._now_us - since_us + 0.5) / 1e6)
            if next_s < 1e9:
                stop_us = min(stop_us, since_us + round(next_s * 1e6))
        return max(stop_us, self._now_us + 1)

    def _say(self, later_us: int = 0) -> None:
        """Where all is that moves. Where nothing does, the first robot says that it stays."""
        at_us = self._now_us + later_us
        poses = {("robot", robot): trajectory.at((at_us - since_us) / 1e6)
                 for robot, (since_us, trajectory) in self._moving.items()}
        first = self._robots[0]
        self._stamps.say(at_us, poses or {("robot", first): self._resting[first]})

    def _settle(self) -> None:
        """A stamp takes effect with the next one, as others could move at the same stamp."""
        stamp_us = self._stamps.latest_us
        self._say(1)
        wait_for_time(self, stamp_us / 1e6, self._catch_up)
        self._stamps.check()
        self._catch_up()
        for robot, (since_us, trajectory) in list(self._moving.items()):
            if (self._now_us - since_us) / 1e6 >= trajectory.seconds:
                self._rest(robot)


def wait_for_time(clock: Clock, until_s: float, catch_up: Callable[[], None]) -> None:
    """Calls `catch_up` meanwhile. Raises TimeStandsStill where time does not go on at all for long."""
    latest: Optional[float] = None
    patience_end = pause_s = 0.0
    while True:
        now = clock.time_s
        if now >= until_s - 5e-7:
            return
        if now != latest:
            latest, pause_s, patience_end = now, 0.0001, time.monotonic() + _PATIENCE_S
        if time.monotonic() > patience_end:
            raise TimeStandsStill(f"time has stood still at {now:.6f} s for {_PATIENCE_S:.0f} s: a client does not "
                                  "read its scans, which holds time up, or poses of somebody else lead time")
        catch_up()
        time.sleep(pause_s)
        pause_s = min(2 * pause_s, 0.02)


def start_clock(control: Control, robots: List[str], lockstep: bool, led: bool) -> Clock:
    """`led`: by poses that do not come from this package."""
    if not lockstep:
        return Clock(control, robots)
    return LedClock(control, robots) if led else LockstepClock(control, robots)

