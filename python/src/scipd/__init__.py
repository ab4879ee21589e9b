# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
scipd for tests: laser scanners that exist only in software, for the time of a test.

    with scipd.Scipd(world="room.sdf") as daemon:
        daemon.robot().pose = (1, 0, 1.57)
        assert daemon.scan().nearest().range_m > 0.3

pytest has the fixture `scipd`, which starts such daemons. docs/testing.md of the project shows more.
"""

from .clock import Clock
from .daemon import Scipd
from .drive import Drive
from .errors import NoScan, Refused, ScipdEnded, ScipdError, ScipdNotFound, ScipdNotReady, TimeStandsStill
from .fault import Fault
from .pose import Pose
from .program import find_program
from .recording import Recording
from .robot import Robot
from .scan import Scan, Seen, Truth
from .scene import Scene
from .sensor import Sensor
from .trajectory import Trajectory
from .version import __version__
from .wire import Wire, WireMessage

__all__ = ["Clock", "Drive", "Fault", "NoScan", "Pose", "Recording", "Refused", "Robot", "Scan", "Scene", "Scipd",
           "ScipdEnded", "ScipdError", "ScipdNotFound", "ScipdNotReady", "Seen", "Sensor", "TimeStandsStill",
           "Trajectory", "Truth", "Wire", "WireMessage", "__version__", "find_program"]
