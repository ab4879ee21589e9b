# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What a scanner has sent comes again from a scanner that plays it, to the bit: over TCP and a tty, from each format
# that keeps stamps, with codes, intensities and echoes. Faults act on top of it, and people steer it.
# replay_test.py SCIPD SCIPCAT SCIPCTL SCENES
import contextlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from fault_lab import PATIENCE_S, Control, wait_for

SCANS = 25
MODELS = ["URG-04LX", "UTM-30LX", "UST-10LX", "UTM-30LX-EW", "UHG-08LX"]


class Scipd:
    def __init__(self, scipd, folder, *options):
        self.folder = pathlib.Path(folder)
        self.errors = open(self.folder / "stderr", "w")
        self.process = subprocess.Popen(
            [scipd, *options, "--tcp", "127.0.0.1:0", "--pty", "auto", "--timing", "ideal"], stdout=subprocess.PIPE,
            stderr=self.errors, env={**os.environ, "XDG_RUNTIME_DIR": str(folder)})
        line = self.process.stdout.readline()
        assert line, (self.folder / "stderr").read_text()
        self.ready = json.loads(line)
        self.sensor = self.ready["sensors"][0]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(PATIENCE_S)
        self.errors.close()

    @property
    def tcp(self):
        return "tcp://" + self.sensor["tcp"]


def record(scipcat, target, file, *more):
    done = subprocess.run([scipcat, "record", target, "-o", str(file), "-n", str(SCANS), *more], capture_output=True,
                          text=True, timeout=PATIENCE_S, check=False)
    assert done.returncode == 0, done.stderr
    return file


def scans(file):
    """By their stamps."""
    return {scan["stamp_ms"]: scan for scan in map(json.loads, file.read_text().splitlines())}


def values(scan):
    """What the driver of another moment gets alike."""
    assert len(scan["distances_mm"]) > 500
    return {key: value for key, value in scan.items() if key != "host_time_s"}


def comes_again(model, programs, folder):
    scipd, scipcat, _, scenes = programs
    wants = ["--intensity"] if model.startswith(("UST", "UTM")) else []
    with Scipd(scipd, folder, "--scene", f"{scenes}/rescue_maze.sdf", "--poses", f"{scenes}/rescue_maze.tum",
               "--model", model) as original:
        recording = record(scipcat, original.tcp, folder / "a.jsonl", *wants)
    first = scans(recording)
    assert len(first) == SCANS, f"{model}: {len(first)} scans"
    with Scipd(scipd, folder, "--replay", str(recording), "--loop", "true") as player:
        assert player.sensor["model"].split("@")[0] == model, player.sensor
        for target in (player.tcp, player.sensor["pty"]):
            again = scans(record(scipcat, target, folder / "b.jsonl", *wants))
            common = set(first) & set(again)
            assert len(common) >= SCANS - 2, f"{model}: {len(common)} stamps in common: {sorted(again)[:5]}"
            for stamp in common:
                assert values(first[stamp]) == values(again[stamp]), f"{model}: another scan at {stamp} ms"
    return recording


def can_be_steered(recording, programs, folder):
    scipd, _, scipctl, _ = programs

    def replay(*words):
        done = subprocess.run([scipctl, "replay", *words, "--json"], capture_output=True, text=True, timeout=PATIENCE_S,
                              env={**os.environ, "XDG_RUNTIME_DIR": str(folder)}, check=False)
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    with Scipd(scipd, folder, "--replay", str(recording), "--loop", "on"):
        assert replay()["state"] == "playing"
        assert replay("pause")["state"] == "paused"
        at = replay("robot/scanner", "seek", "0.1")
        assert at["state"] == "paused" and abs(at["at_s"] - 0.1) < 0.11, at
        before = at["scan"]
        stepped = replay("step", "2")
        assert (stepped["state"], stepped["scan"]) == ("paused", before + 2), stepped
        wait_for(lambda: replay()["state"] == "paused", "pause")
        assert replay() == stepped, replay()
        assert replay("speed", "2")["speed"] == 2
        assert replay("play")["state"] == "playing"


def begins_where_it_is_told(programs, folder):
    """A scan a second: what comes more than two seconds before from_s is not read."""
    scipd = programs[0]
    step = 0.00436332313
    (folder / "slow.jsonl").write_text("".join(json.dumps({
        "host_time_s": 1000.5 + i, "stamp_ms": 1000 * i, "model": "UST-10LX", "first_step": 0,
        "first_angle_rad": -540 * step, "angle_increment_rad": step, "distances_mm": [1000 + i] * 1081}) + "\n"
        for i in range(60)))
    for from_s, scan, state in [(30, 2, "playing"), (0, 0, "playing"), (1000, None, None)]:
        (folder / "slow.yaml").write_text(json.dumps({"robots": {"robot": {"sensors": {"scanner": {
            "replay": {"file": "slow.jsonl", "from_s": from_s}, "pty": "none", "tcp": "127.0.0.1:0"}}}}}))
        if scan is None:
            done = subprocess.run([scipd, "--config", str(folder / "slow.yaml")], capture_output=True, text=True,
                                  timeout=PATIENCE_S, check=False)
            assert done.returncode == 2 and "has no scan from from_s on" in done.stderr, done
            continue
        with subprocess.Popen([scipd, "--config", str(folder / "slow.yaml"), "--control", str(folder / "s")],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
            assert process.stdout.readline()
            status, told = Control(folder / "s").ask("GET", "/sensors/robot/scanner/replay")
            process.terminate()
        assert status == 200 and (told["scan"], told["state"]) == (scan, state), told
        assert told["at_s"] == from_s and told["duration_s"] > 59 and told["scans"] == (32 if from_s else 60), told


def refuses_what_is_none(programs, folder):
    scipd = programs[0]
    for name, text, advice in [("a.txt", "hello\n", "a.txt"), ("empty.jsonl", "", "empty.jsonl")]:
        (folder / name).write_text(text)
        done = subprocess.run([scipd, "--replay", str(folder / name)], capture_output=True, text=True,
                              timeout=PATIENCE_S, check=False)
        assert done.returncode == 2 and advice in done.stderr, (done.returncode, done.stderr)


def main(*programs):
    for model in MODELS:
        with tempfile.TemporaryDirectory() as folder:
            recording = comes_again(model, programs, pathlib.Path(folder))
            if model == "UST-10LX":
                can_be_steered(recording, programs, pathlib.Path(folder))
    with tempfile.TemporaryDirectory() as folder:
        refuses_what_is_none(programs, pathlib.Path(folder))
        begins_where_it_is_told(programs, pathlib.Path(folder))
    print("recorded scans come again")


if __name__ == "__main__":
    main(*sys.argv[1:])
