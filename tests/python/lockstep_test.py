# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Time that a test has go on.
import hashlib
import json
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
