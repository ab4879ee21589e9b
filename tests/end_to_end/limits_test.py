# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What is beyond a limit is refused with a reason and counted, what is within is not, and a reload changes the limits of
# a running scipd. limits_test.py SCIPD SCENE
import json
import re
import signal
import socket
import sys

from fault_lab import Control, Lab, wait_for

SCANNER = {"front": {"model": "UST-10LX", "tcp": "127.0.0.1:0"}}
LIMITS = {"poses_per_s": 5, "http_body_bytes": 300, "scanner_connections": 2, "added_models": 1}
POSE = json.dumps({"xyz": [0.5, 0, 0]})


def counted(control, limit):
    control.close()
    control.request("GET", "/metrics")
    text = control.getresponse().read().decode()
    return int(re.search(rf'^scipd_limited_total{{limit="{limit}"}} (\d+)$', text, re.MULTILINE).group(1))


def put(connection, body, target="/robots/robot/pose"):
    connection.request("PUT", target, body)
    answer = connection.getresponse()
    text = answer.read().decode()
    return answer.status, json.loads(text) if text else {}


def check_poses(lab, control):
    """Each connection is a sender."""
    before = control.ask("GET", "/status")[1]["poses"]
    eager, other = Control(lab.control.path), Control(lab.control.path)
    answers = [put(eager, POSE) for _ in range(40)]
    assert [status for status, _ in answers[:5]] == [204] * 5, answers
    refused = [problem for status, problem in answers if status == 429]
    assert len(refused) >= 20, answers  # unless 40 requests take seconds
    assert "poses_per_s under limits" in refused[0]["detail"], refused[0]
    assert put(other, POSE)[0] == 204
    poses = control.ask("GET", "/status")[1]["poses"]
    assert poses["refused"] - before["refused"] == len(refused) == counted(control, "poses_per_s"), poses
    assert poses["last_refusal"] == refused[0]["detail"], poses


def check_bodies(lab, control, most, too_many):
    fits = POSE + " " * (most - len(POSE))
    assert put(Control(lab.control.path), fits)[0] == 204
    status, problem = put(Control(lab.control.path), fits + " ")
    assert status == 413 and f"larger than {most} bytes; http_body_bytes" in problem["detail"], problem
    assert counted(control, "http_body_bytes") == too_many


def check_scanner(control):
    host, port = control.ask("GET", "/sensors")[1][0]["tcp"].rsplit(":", 1)
    with socket.create_connection((host, int(port)), 60) as first, \
            socket.create_connection((host, int(port)), 60) as second:
        first.sendall(b"VV\n")
        assert first.recv(4).startswith(b"VV")
        second.sendall(b"VV\n")  # it waits for its turn
        with socket.create_connection((host, int(port)), 60) as third:
            assert third.recv(1) == b"", "it is closed"
        assert counted(control, "scanner_connections") == 1
        first.close()
        assert second.recv(4).startswith(b"VV")


def main():
    scipd, scene = sys.argv[1:]
    with Lab(scipd, scene, sensors=SCANNER, lockstep=False, limits=LIMITS) as lab:
        control = Control(lab.control.path)
        check_poses(lab, control)
        check_bodies(lab, control, 300, 1)
        check_scanner(control)
        file = lab.folder / "lab.yaml"
        file.write_text(json.dumps(json.loads(file.read_text()) | {"limits": {"http_body_bytes": 500}}))
        lab.process.send_signal(signal.SIGHUP)
        wait_for(lambda: put(Control(lab.control.path), POSE + " " * 300)[0] == 204, "the reload")
        check_bodies(lab, control, 500, counted(control, "http_body_bytes") + 1)


main()
