# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Time that a test has go on.
import hashlib
import json
import math
import socket
import threading
import time

import pytest

from scipd import Scipd, ScipdError, TimeStandsStill, clock


def test_time_goes_on_by_what_was_asked_for(scipd, room):
    daemon = scipd(world=room, clock="poses", accuracy="ideal")
    assert daemon.clock.time_s == 0
    begin = time.monotonic()
    daemon.clock.run(60)
    assert time.monotonic() - begin < 30
    assert daemon.clock.time_s == pytest.approx(60, abs=1e-5)
    time.sleep(0.1)
    assert daemon.clock.time_s == pytest.approx(60, abs=1e-5)
    daemon.robot().pose = (1, 0, 0)
    assert daemon.robot().pose.x == 1
    assert daemon.scan().at(0) == 2.0
    assert daemon.clock.time_s < 60.5
    daemon.clock.run(0)


def test_with_the_wall_clock_it_just_waits(scipd, room):
    daemon = scipd(world=room)
    before = daemon.clock.time_s
    daemon.clock.run(0.3)
    assert daemon.clock.time_s >= before + 0.3


def test_a_drive_goes_with_time(scipd, scenes, room):
    daemon = scipd(world=room, clock="poses", accuracy="ideal", poses=scenes / "square_room.tum")
    first = daemon.robot().pose.yaw
    daemon.clock.run(1)
    assert daemon.robot().pose.yaw != pytest.approx(first)
    drive = daemon.robot().pose.play([(0, (-1, 0, 0)), (4, (1, 0, 0))])
    daemon.clock.run(2)
    assert daemon.robot().pose.x == pytest.approx(0, abs=1e-4)
    assert not drive.done
    drive.wait()
    assert drive.done and daemon.robot().pose.x == pytest.approx(1, abs=1e-4)
    drive = daemon.robot().play([(0, (-1, 0, 0)), (4, (1, 0, 0))])
    daemon.clock.run(1)
    drive.stop()
    daemon.clock.run(1)
    assert daemon.robot().pose.x == pytest.approx(-0.5, abs=1e-4)


@pytest.mark.parametrize("model, turn_ms", [("UST-10LX", 25.05), ("URG-04LX", 99.8), ("UXM-30LX-E", 49.8)])
@pytest.mark.parametrize("links", [[], ["--tcp", "none"]], ids=["tcp", "tty"])
def test_a_scan_is_the_next_revolution(scipd, room, model, turn_ms, links):
    daemon = scipd(world=room, model=model, clock="poses", accuracy="ideal", args=links)
    stamps = [daemon.scan().stamp_ms for _ in range(20)]
    assert all(abs(after - before - turn_ms) <= 1 for before, after in zip(stamps, stamps[1:])), stamps
    stamps = [scan.stamp_ms for scan in daemon.scans(count=20)]
    assert len(stamps) == 20
    assert all(abs(after - before - turn_ms) <= 1 for before, after in zip(stamps, stamps[1:])), stamps


@pytest.mark.parametrize("in_a_stream", [False, True])
def test_what_changes_between_two_scans_holds_for_all_of_the_next(scipd, room, in_a_stream):
    daemon = scipd(world=room, clock="poses", accuracy="ideal")
    scans = daemon.scans() if in_a_stream else iter(daemon.scan, None)
    stamps = [next(scans).stamp_ms]
    for x, y in [(1, 0), (0, 0.5), (-1, -0.5), (0.5, 1), (0, 0)]:
        daemon.robot().pose = (x, y, 0)
        scan = next(scans)
        stamps.append(scan.stamp_ms)
        assert (scan.at(-math.pi / 2), scan.at(0), scan.at(math.pi / 2)) == pytest.approx((2 + y, 3 - x, 2 - y))
    assert all(after - before in (25, 26) for before, after in zip(stamps, stamps[1:]))


def test_consecutive_scans_last_as_long_as_was_asked_for(scipd, room):
    daemon = scipd(world=room, clock="poses")
    assert len(list(daemon.scans(seconds=1))) == 40  # 25.05 ms each
    assert list(daemon.scans(count=0)) == []
    scans = daemon.scans("scanner")
    first = next(scans)
    daemon.clock.run(10)  # none is lost meanwhile, and none holds time up
    stamps = [first.stamp_ms] + [next(scans).stamp_ms for _ in range(398)]
    assert all(after - before in (25, 26) for before, after in zip(stamps, stamps[1:]))
    scans.close()
    assert daemon.sensor().status["clients"] == 0
    with pytest.raises(ValueError, match="there is no sensor 'laser'"):
        daemon.scans("laser")


def test_scanners_are_read_in_step(scipd, room):
    common = {"tcp": "127.0.0.1:0", "accuracy": "ideal", "mount": {"xyz": [0, 0, 0.25]}}
    sensors = {"front": {"model": "UST-10LX", **common},
               "rear": {"model": "UST-10LX", **common, "clock": {"start_ms": 16777000}},  # its stamps wrap
               "slow": {"model": "URG-04LX", **common}}
    daemon = scipd(config={"scene": str(room), "robots": {"robot": {"sensors": sensors}}}, clock="poses")
    for names in (["front", "rear"], ["front", "slow"], ["rear", "slow", "front"]):
        latest = None
        tuples = 0
        for scans in daemon.scans_of(names, count=12):
            assert [scan.sensor for scan in scans] == [f"robot/{name}" for name in names]
            begins = [daemon.truth(of=scan).time_s for scan in scans]
            assert max(begins) - min(begins) < 0.0126, "half a revolution of the faster one"
            pace_s, off_s = (0.0998, 0.0126) if "slow" in names else (0.02505, 0.001)
            assert latest is None or begins[0] - latest == pytest.approx(pace_s, abs=off_s)
            latest = begins[0]
            tuples += 1
        assert tuples == 12
    for wrong in ([], ["front", "robot/front"]):
        with pytest.raises(ValueError, match="each once"):
            daemon.scans_of(wrong)


def run_of(room):
    """All that a driver got in twelve seconds with a drive, a fault and a crate, as a digest."""
    digest, messages = hashlib.sha256(), 0
    with Scipd(world=room, clock="poses", seed=5) as daemon:
        driver = socket.create_connection((daemon.host, daemon.port))
        driver.sendall(b"MD0000108001000\n")
        daemon.wire.wait_for("MD")

        def read():
            nonlocal messages
            while messages < 400:
                data = driver.recv(65536)
                if not data:
                    return
                for byte in data.splitlines(keepends=True):
                    messages += byte == b"\n"
                    if messages < 400:
                        digest.update(byte)

        reader = threading.Thread(target=read)
        reader.start()
        daemon.robot().play([(0, (-1, 0, 0)), (6, (1, 0, 1))])
        daemon.clock.run(3)
        daemon.fault("corrupt", bytes={"rate": 0.001}, seconds=2)
        daemon.scene.add("crate", box=(0.4, 0.4, 0.4), pose=(2, 0.5, 0))
        daemon.clock.run(9)
        reader.join(30)
        assert messages >= 400
        driver.close()
    return digest.hexdigest()


def test_two_runs_give_the_same_bytes(room):
    assert run_of(room) == run_of(room)


def test_a_driver_that_does_not_read_is_named(scipd, room, monkeypatch):
    monkeypatch.setattr(clock, "_PATIENCE_S", 1.0)
    daemon = scipd(world=room, clock="poses")
    with socket.create_connection((daemon.host, daemon.port)) as driver:
        driver.sendall(b"ME0000108001000\n")
        daemon.wire.wait_for("ME")
        with pytest.raises(TimeStandsStill, match="a client does not read its scans"):
            daemon.clock.run(600)


def test_a_simulator_leads_time_by_its_own_poses(scipd, room):
    daemon = scipd(world=room, clock="poses", poses="udp:127.0.0.1:0")
    host, port = daemon.robot().poses_at[len("udp:"):].rsplit(":", 1)
    stopped = threading.Event()

    def simulate():
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as simulator:
            for i in range(10000):
                if stopped.wait(0.002):
                    return
                simulator.sendto(f'{{"t":{i * 0.02},"xyz":[0,0,0]}}'.encode(), (host, int(port)))

    simulator = threading.Thread(target=simulate)
    simulator.start()
    try:
        before = daemon.clock.time_s
        daemon.clock.run(2)
        assert daemon.clock.time_s >= before + 2
        with pytest.raises(ScipdError, match="the source of the poses leads time"):
            daemon.robot().pose = (0, 0, 0)
    finally:
        stopped.set()
        simulator.join()


def test_time_waits_for_a_recording(scipd, room, tmp_path):
    daemon = scipd(world=room, clock="poses")
    with daemon.record(tmp_path / "run.jsonl") as recording:
        daemon.clock.run(20)
    numbers = [json.loads(line)["scan"] for line in (tmp_path / "run.jsonl").read_text().splitlines()]
    assert numbers == list(range(numbers[0], numbers[0] + recording.scans)) and len(numbers) > 780
    assert daemon.sensor().status["stream_lost"] == 0
