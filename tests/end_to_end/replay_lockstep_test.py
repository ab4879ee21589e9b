# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# A scanner that plays a recording and one that sees the world, in lockstep with the same poses: each recorded scan
# begins at its own timestamp, the other scanner sees the wall from where the robot is at its own, and two runs send the
# same bytes.
# replay_lockstep_test.py SCIPD SCENES
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import threading

from fault_lab import PATIENCE_S, Client, Control
from replay_test import two_scanners

BEGIN_S = 1_700_000_000
POSES_PER_S = 50
SECONDS = 3
SPEED = 0.5  # metres a second, ahead
RECORDED = 40
FIRST_S = BEGIN_S + 0.26
GAP = 20  # after so many scans the recorder rested for a second
WALL_M = 3.0  # ahead in the square room


def recorded_s(scan):
    return FIRST_S + 0.025 * scan + (1.0 if scan >= GAP else 0.0)


def make_recording(file):
    step = math.radians(0.25)
    file.write_text("".join(json.dumps({
        "host_time_s": recorded_s(k), "stamp_ms": 5000 + round(1000 * (recorded_s(k) - FIRST_S)), "model": "UST-10LX",
        "serial": "H1", "first_step": 0, "cluster": 1, "first_angle_rad": -540 * step, "angle_increment_rad": step,
        "distances_mm": [1000 + k] * 1081}) + "\n" for k in range(RECORDED)))


def configure(folder, scenes, begins):
    sensors = {"played": {"replay": {"file": "drive.jsonl", "begins_s": begins}, "tcp": "127.0.0.1:0"},
               "sees": {"model": "UST-10LX", "accuracy": "ideal", "tcp": "127.0.0.1:0",
                        "mount": {"xyz": [0, 0, 0.3]}}}
    (folder / "lab.yaml").write_text(json.dumps({
        "scene": str(scenes / "square_room.sdf"), "clock": "poses", "seed": 3, "control": str(folder / "s"),
        "robots": {"robot": {"poses": "-", "sensors": sensors}}}))
    return folder / "lab.yaml"


def poses():
    return "".join(json.dumps({"t": BEGIN_S + i / POSES_PER_S, "xyz": [SPEED * i / POSES_PER_S, 0, 0],
                               "q": [0, 0, 0, 1]}) + "\n" for i in range(POSES_PER_S * SECONDS + 1))


class Driver(threading.Thread):
    """Reads so many scans."""

    def __init__(self, address, scans):
        super().__init__()
        host, port = address.rsplit(":", 1)
        self.client = Client((host, int(port)))
        self.end = scans + 2
        self.client.ask("BM")
        self.client.ask("MD0000108000000")
        self.start()

    def run(self):
        while self.client.got.count(b"\n\n") < self.end and self.client.read():
            pass

    def messages(self):
        self.join(PATIENCE_S)
        messages = self.client.got.split(b"\n\n")
        assert len(messages) > self.end, f"{len(messages)} messages of {self.end}"
        return messages[:self.end]


class Recorder(threading.Thread):
    """What the control API records of a scanner."""

    def __init__(self, control, sensor, scans):
        super().__init__()
        self.talk = Control(control)
        self.talk.request("GET", f"/sensors/robot/{sensor}/recording?format=jsonl&scans={scans}")
        self.start()

    def run(self):
        self.answer = self.talk.getresponse().read()

    def scans(self):
        self.join(PATIENCE_S)
        return [json.loads(line) for line in self.answer.splitlines()]


def drive(scipd, configuration):
    with subprocess.Popen([scipd, "--config", str(configuration)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True) as process:
        ready = json.loads(process.stdout.readline())
        places = {sensor["name"]: sensor["tcp"] for sensor in ready["sensors"]}
        drivers = [Driver(places["robot/played"], RECORDED), Driver(places["robot/sees"], 100)]
        recorders = [Recorder(ready["control"], "played", RECORDED), Recorder(ready["control"], "sees", 100)]
        Control(ready["control"]).ask("GET", "/status")
        process.stdin.write(poses())
        process.stdin.flush()
        heard = [driver.messages() for driver in drivers]
        recorded = [recorder.scans() for recorder in recorders]
        process.terminate()
    return heard, recorded


def keeps_two_in_step(scipd, folder):
    """Two scanners of one log, the second of which was switched on later."""
    sensors = {name: {"replay": {"file": str(two_scanners(folder)), "stream": f"/{name}/scan"}, "tcp": "127.0.0.1:0"}
               for name in ("front", "rear")}
    (folder / "two.yaml").write_text(json.dumps({
        "clock": "poses", "control": str(folder / "s"), "robots": {"robot": {"poses": "-", "sensors": sensors}}}))
    with subprocess.Popen([scipd, "--config", str(folder / "two.yaml")], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True) as process:
        control = json.loads(process.stdout.readline())["control"]
        recorders = [Recorder(control, "rear", 15), Recorder(control, "front", 22)]
        Control(control).ask("GET", "/status")
        process.stdin.write(poses())
        process.stdin.flush()
        rear, front = (recorder.scans() for recorder in recorders)
        process.terminate()
    recorded = [[(scan["distances_mm"][300] - 1000) // 10 for scan in scans] for scans in (front, rear)]
    assert recorded == [list(range(22)), list(range(7, 22))], recorded
    begins_s = [scan["host_time_s"] - 0.1 * k for scans, ks in zip((front, rear), recorded)
                for scan, k in zip(scans, ks)]
    assert max(begins_s) - min(begins_s) < 0.002, begins_s


def main(scipd, scenes):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_recording(folder / "drive.jsonl")
        configuration = configure(folder, pathlib.Path(scenes), "recorded")
        heard, (played, seen) = drive(scipd, configuration)
        for k, scan in enumerate(played):
            assert abs(scan["host_time_s"] - recorded_s(k)) < 0.0011, (k, scan["host_time_s"] - BEGIN_S)
            assert scan["distances_mm"] == [1000 + k] * 1081, k
            assert scan["stamp_ms"] == 5000 + round(1000 * (recorded_s(k) - FIRST_S)), (k, scan["stamp_ms"])
        ahead = 540
        for scan in seen:
            fired_s = scan["host_time_s"] - BEGIN_S + ahead / 1440 * 0.025
            wanted_mm = 1000 * (WALL_M - SPEED * fired_s)
            assert abs(scan["distances_mm"][ahead] - wanted_mm) <= 1, (fired_s, scan["distances_mm"][ahead], wanted_mm)
        again, _ = drive(scipd, configuration)
        assert heard == again, "two runs differ"
        configure(folder, pathlib.Path(scenes), FIRST_S)  # the same as a number
        assert drive(scipd, configuration)[0] == heard, "a number is another line"
        configuration.write_text(configuration.read_text().replace('"poses", "seed"', '"wall", "seed"'))
        wrong = subprocess.run([scipd, "--config", str(configuration)], capture_output=True, text=True,
                               timeout=PATIENCE_S, check=False)
        assert wrong.returncode == 2 and "needs clock: poses" in wrong.stderr, wrong
        keeps_two_in_step(scipd, folder)
    print("recorded and computed scans are on one line of stamps")


if __name__ == "__main__":
    main(*sys.argv[1:])
