# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What a driver gets, what is true, what they say to each other, and recordings of it.
import dataclasses
import json
import math
import re
import socket
import struct
import time

import pytest
from conftest import eventually

from scipd import NoScan, Scipd, ScipdError
from scipd.scip import parameters_of, values_of


def test_a_scan_is_what_the_room_is(scipd, room):
    daemon = scipd(world=room, accuracy="ideal")
    scan = daemon.scan()
    assert len(scan.ranges_m) == len(scan.angles_rad) == len(scan.intensities) == 1081
    assert scan.angles_rad[0] == pytest.approx(-0.75 * math.pi)
    for angle, range_m in [(0, 3), (math.pi / 2, 2), (-math.pi / 2, 2), (math.pi / 4, 1.8713), (-math.pi / 4, 2.1213)]:
        assert scan.at(angle) == pytest.approx(range_m, abs=0.0015)
    assert scan.nearest().range_m == min(scan.ranges_m)
    # What a failed assertion shows.
    assert re.fullmatch(r"<Scan of robot/scanner at \d+ ms: 1081 steps, the nearest 1\.8\d\d m at -?0\.\d\d rad>",
                        repr(scan))
    with pytest.raises(ValueError, match="looks from"):
        scan.at(math.pi)


def test_the_truth_is_that_of_the_same_turn(scipd, room):
    daemon = scipd(world=room)
    scan = daemon.scan()
    truth = daemon.truth(of=scan)
    assert truth.raw["sent_mm"] == scan.sent_mm
    assert truth.at(0).object == "room::body::front"
    assert truth.nearest().range_m == min(truth.ranges_m)
    assert re.fullmatch(r"<Truth of robot/scanner at \d+\.\d+ s: 1081 steps, the nearest .*, box::body::box>",
                        repr(truth))
    time.sleep(1.2)
    daemon.scan()
    with pytest.raises(ScipdError, match="ask within a second"):
        daemon.truth(of=scan)


def test_consecutive_scans_come_by_the_wall_clock_too(scipd, room):
    daemon = scipd(world=room, accuracy="ideal")
    stamps = [scan.stamp_ms for scan in daemon.scans(count=30)]
    assert all(after - before in (25, 26) for before, after in zip(stamps, stamps[1:]))
    assert sum(request.startswith("ME") for request in daemon.wire.requests) == 1, "they are of one stream"
    silent = daemon.fault("stall")
    with pytest.raises(NoScan, match="on purpose it has: stall"):
        next(daemon.scans(timeout_s=0.5))
    silent.stop()


def test_degrees_are_named(scipd, room):
    daemon = scipd(world=room, accuracy="ideal")
    with pytest.raises(ValueError, match=r"looks from .* rad, not to 90; .*did you mean 1\.571\?"):
        daemon.scan().at(90)


def test_codes_are_no_ranges():
    # The far end of this corridor is out of a URG's sight.
    with Scipd(model="URG-04LX", accuracy="ideal") as daemon:
        scan = daemon.scan()
        assert scan.intensities is None
        assert "no range" in repr(dataclasses.replace(scan, ranges_m=[None] * 5))
        assert all((r is None) == (mm < 20) for r, mm in zip(scan.ranges_m, scan.sent_mm))


def test_beside_a_driver_a_scan_comes_by_the_tty(scipd, room):
    daemon = scipd(world=room, accuracy="ideal")
    with socket.create_connection((daemon.host, daemon.port)) as driver:
        driver.sendall(b"MD0000108001000\n")
        daemon.wire.wait_for("MD")
        assert daemon.scan().at(0) == 3.0
        assert daemon.sensor().status["state"] == "streaming"
        eventually(lambda: {message.client for message in daemon.wire} == {"tcp", "tty"}, "the tty is not heard")
    lonely = scipd(world=room, args=["--pty", "none"])
    with socket.create_connection((lonely.host, lonely.port)) as driver:
        driver.sendall(b"VV\n")
        lonely.wire.wait_for("VV")
        with pytest.raises(NoScan, match="serves one TCP client at a time"):
            lonely.scan()
        assert lonely.truth().at(0).range_m == pytest.approx(3)


def test_the_wire_has_the_conversation(scipd, room):
    daemon = scipd(world=room)
    with socket.create_connection((daemon.host, daemon.port)) as driver:
        driver.sendall(b"XX\n")
        eventually(lambda: len(daemon.wire) == 2, "nothing is heard")
    request, reply = daemon.wire
    assert (request.line, request.sender, request.sensor) == ("XX", "client", "robot/scanner")
    assert reply.status in ("0E", "0F")
    assert daemon.wire.requests == ["XX"]
    assert "tcp > XX" in str(daemon.wire)
    with pytest.raises(ScipdError, match=r"no client has asked MD within 0.1 s; so far they have asked \['XX'\]"):
        daemon.wire.wait_for("MD", timeout_s=0.1)


def records_of(data):
    """The records of an MCAP file, by the specification, each with its kind."""
    magic = b"\x89MCAP0\r\n"
    assert data.startswith(magic) and data.endswith(magic)
    at, end = len(magic), len(data) - len(magic)
    while at < end:
        kind, size = struct.unpack_from("<BQ", data, at)
        yield kind, data[at + 9:at + 9 + size]
        at += 9 + size
    assert at == end


def test_a_recording_has_every_scan(scipd, room, tmp_path):
    daemon = scipd(world=room, accuracy="ideal")
    with daemon.record(tmp_path / "run.mcap") as recording, daemon.record(tmp_path / "run.jsonl"):
        eventually(lambda: recording.scans >= 10, "nothing is recorded")
    records = list(records_of((tmp_path / "run.mcap").read_bytes()))
    assert [kind for kind, _ in records] == [1, 3, 4] + [5] * recording.scans + [15, 2]
    channel = records[2][1]
    assert b"/robot/scanner/scan" in channel and b"json" in channel
    times = [struct.unpack_from("<Q", data, 6)[0] for kind, data in records if kind == 5]
    assert times == sorted(times)
    message = json.loads(records[3][1][22:])
    assert message["ranges"][540] == 3.0 and message["distances_mm"][540] == 3000
    assert message["start_angle"] == pytest.approx(-0.75 * math.pi)
    assert message["end_angle"] == pytest.approx(0.75 * math.pi)
    lines = [json.loads(line) for line in (tmp_path / "run.jsonl").read_text().splitlines()]
    numbers = [line["scan"] for line in lines]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
    with pytest.raises(ValueError, match="ends with .mcap or .jsonl"):
        daemon.record(tmp_path / "run.bag")


# From here on: bytes, without a daemon.


def with_sum(line):
    return line + bytes([(sum(line) & 0x3F) + 0x30])


def test_values_are_decoded_and_sums_are_checked():
    # 1234 is `CB` in two characters of SCIP's own manual; three characters, 5432 is `1Dh`, its next example.
    block = b"1Dh" + b"00o"
    message = b"\n".join([b"ME0000000101000", with_sum(b"99"), with_sum(b"0000"), with_sum(block)])
    assert values_of(message, True) == (0, [5432], [63])
    assert values_of(message, False) == (0, [5432, 63], None)
    with pytest.raises(NoScan, match="line 4 of the scan has a wrong sum"):
        values_of(message[:-1] + b"!", True)


def test_parameters_that_are_missing_are_named():
    with pytest.raises(NoScan, match="lacks 'DMAX'"):
        parameters_of(b"PP\n00P\nDMIN:20;5\n")
