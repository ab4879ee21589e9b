# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""A robot on its way along a trajectory: it can be waited for and stopped."""

from __future__ import annotations

import json
import threading
import time
from typing import Callable

from .pose import Pose
from .trajectory import Trajectory
from .websocket import WebSocket, WebSocketClosed

# Poses are sent so long before their time, so that each sweep lies between two.
_AHEAD_S = 0.05
# Between poses that are farther apart than a second scipd would have the robot rest.
_LONGEST_STEP_S = 0.1


class Drive:
    @property
    def done(self) -> bool:
        raise NotImplementedError

    def wait(self) -> None:
        """Returns when the robot is at the end, or was stopped. In lockstep time goes on as far."""
        raise NotImplementedError

    def stop(self) -> None:
        """The robot stays where it is."""
        raise NotImplementedError


class LockstepDrive(Drive):
    """Time moves it. Made of what its clock can do."""

    def __init__(self, left_s: Callable[[], float], run: Callable[[float], None], rest: Callable[[], None]) -> None:
        self._left_s, self._run, self._rest = left_s, run, rest

    @property
    def done(self) -> bool:
        return self._left_s() == 0

    def wait(self) -> None:
        self._run(self._left_s())

    def stop(self) -> None:
        self._rest()


class WallDrive(Drive):
    """A thread that sends each pose shortly before its time."""

    def __init__(self, control: str, robot: str, trajectory: Trajectory) -> None:
        self._robot = robot
        self._trajectory = trajectory
        self._stopped = threading.Event()
        self._socket = WebSocket(control, "/poses")
        self._thread = threading.Thread(target=self._run, name=f"scipd drive of {robot}", daemon=True)
        self._thread.start()

    @property
    def done(self) -> bool:
        return not self._thread.is_alive()

    def wait(self) -> None:
        self._thread.join()

    def stop(self) -> None:
        self._stopped.set()
        self._thread.join()

    def _run(self) -> None:
        begin = time.monotonic()
        at_s = 0.0
        try:
            self._send(at_s)
            while at_s < self._trajectory.seconds:
                at_s = min(self._trajectory.next_time(at_s), at_s + _LONGEST_STEP_S)
                if self._stopped.wait(max(0.0, begin + at_s - _AHEAD_S - time.monotonic())):
                    return
                self._send(at_s)
            self._stopped.wait(max(0.0, begin + at_s - time.monotonic()))
        except WebSocketClosed:
            pass  # scipd is gone, and whoever asks it next is told
        finally:
            self._socket.close()

    def _send(self, at_s: float) -> None:
        pose: Pose = self._trajectory.at(at_s)
        self._socket.send(json.dumps({"robot": self._robot, "t": at_s, **pose.as_json()}))
