# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What goes wrong on purpose, as a test asks for it.
import time

import pytest

from scipd import NoScan, Refused


@pytest.fixture
def daemon(scipd, room):
    return scipd(world=room, accuracy="ideal")


def test_a_fault_lasts_for_seconds_or_until_it_is_stopped(daemon):
    begin = time.monotonic()
    fault = daemon.fault("stall", seconds=1)
    assert daemon.scan().at(0) == 3.0
    assert time.monotonic() - begin > 0.9
    assert fault.state == "ended" and fault.hits > 0
    with daemon.fault("cut", how="mute", seconds=60) as fault:
        assert fault.state == "active"
        with pytest.raises(NoScan, match=r"robot/scanner \(UST-10LX\) has sent no scan: .* on purpose it has: cut"):
            daemon.scan(timeout_s=0.3)
    assert daemon.scan().at(0) == 3.0
    fault.stop()


def test_a_fault_begins_later(daemon):
    fault = daemon.fault("dirty", after=60, steps=[500, 580], reads="near")
    assert fault.state == "waiting"
    assert daemon.scan().at(0) == 3.0
    fault.stop()
    fault = daemon.fault("dirty", steps=[500, 580], reads="near", for_={"scans": 1000})
    assert daemon.scan().at(0) == pytest.approx(0.03)
    assert {entry["kind"] for entry in fault.log} == {"dirty"}


def test_a_wrong_sum_makes_no_scan(daemon):
    daemon.fault("sums", of="data", messages="scans")
    with pytest.raises(NoScan, match="line 3 of the scan has a wrong sum"):
        daemon.scan()


def test_in_lockstep_seconds_are_those_of_the_clock(scipd, room):
    daemon = scipd(world=room, accuracy="ideal", clock="poses")
    fault = daemon.fault("poses", how="stop", after=1, seconds=3)
    states = []
    for _ in range(3):
        states.append(fault.state)
        daemon.clock.run(2)
    assert states == ["waiting", "active", "active"]
    assert fault.state == "ended"


def test_what_is_wrong_is_told(daemon):
    with pytest.raises(Refused, match="400.*stahl"):
        daemon.fault("stahl")
    with pytest.raises(TypeError, match="either after= so many seconds, or at="):
        daemon.fault("stall", after=1, at={"scan": 4})
    with pytest.raises(TypeError, match="either seconds="):
        daemon.fault("stall", seconds=1, until="RB")
