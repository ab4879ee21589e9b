# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What a scanner has sent comes again from a scanner that plays it, to the bit: over TCP and a tty, from each format
# that keeps stamps, with codes, intensities and echoes. Faults act on top of it, and people steer it.
# replay_test.py SCIPD SCIPCAT SCIPCTL SCENES
import contextlib
import json
import math
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time

from fault_lab import PATIENCE_S, Control, wait_for

sys.path.append(str(pathlib.Path(__file__).parents[1] / "tools/recording"))
import foreign_files as foreign  # noqa: E402

SCANS = 25
MODELS = ["URG-04LX", "UTM-30LX", "UST-10LX", "UTM-30LX-EW", "UHG-08LX"]


class Scipd:
    def __init__(self, scipd, folder, *options, tcp="127.0.0.1:0", pty="auto"):
        self.folder = pathlib.Path(folder)
        self.errors = open(self.folder / "stderr", "w")
        self.process = subprocess.Popen(
            [scipd, *options, *(["--tcp", tcp] if tcp else []),
             *(["--pty", pty, "--timing", "ideal"] if pty else [])],
            stdout=subprocess.PIPE, stderr=self.errors, env={**os.environ, "XDG_RUNTIME_DIR": str(folder)})
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
        assert replay()["state"] == "waiting"
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
    for from_s, scan, state in [(30, 2, "waiting"), (0, 0, "waiting"), (1000, None, None)]:
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


def bag_of(folder, ranges, fan_rad, limits_m=(0.02, 60)):
    """A bag of ten scans at 10 Hz."""
    stamps = [foreign.BEGIN_S * 10**9 + i * 100_000_000 for i in range(10)]
    (folder / "fan.bag").write_bytes(foreign.bag([[
        ("/scan", "sensor_msgs/LaserScan", stamp, foreign.ros1_scan(stamp, ranges, (), fan_rad, limits_m))]
        for stamp in stamps]))
    return folder / "fan.bag"


def played(programs, folder, recording, *options):
    """What a driver gets of it: the ready line's sensor, PP, and a scan by angle, in mm; and the log."""
    scipd, scipcat, *_ = programs
    with Scipd(scipd, folder, "--replay", str(recording), "--loop", "true", *options) as player:
        done = subprocess.run([scipcat, "record", player.tcp, "-o", str(folder / "c.jsonl"), "-n", "1"],
                              capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        assert done.returncode == 0, done.stderr
        about = json.loads(subprocess.run([scipcat, "info", player.tcp, "--json"], capture_output=True, text=True,
                                          timeout=PATIENCE_S, check=True).stdout)
    scan = json.loads((folder / "c.jsonl").read_text().splitlines()[0])
    first, step = scan["first_angle_rad"], scan["angle_increment_rad"]
    by_angle = [(first + i * step, value) for i, value in enumerate(scan["distances_mm"])]
    return about, by_angle, (folder / "stderr").read_text()


def has_codes_again(programs, folder):
    """Drivers publish the code c as c / 1000 m; hokuyo_node -inf for too near, +inf for too far (REP 117)."""
    step = 2 * math.pi / 1440
    codes = {"UTM-30LX": ([0.001, 0.002, 0.003, 0.005, -math.inf, math.inf, math.nan, 0.0],
                          [1, 2, 3, 5, 2, 1, 1, 1]),
             "URG-04LX": ([0.001, 0.002, 0.006, 0.007, 0.008, 0.010, 0.015, 0.019, math.nan],
                          [1, 2, 6, 7, 8, 10, 15, 19, 0]),
             "UST-10LX": ([65.533, 0.004, 0.001, math.nan], [65533, 4, 65533, 65533])}
    for model, (published, sent) in codes.items():
        step = 2 * math.pi / (1024 if model.startswith("URG") else 1440)
        _, by_angle, _ = played(programs, folder, bag_of(folder, [1.0] * 10 + published + [1.0] * 10, (0, step)),
                                "--model", model)
        front = next(i for i, (angle, _) in enumerate(by_angle) if abs(angle) < step / 4)
        got = [value for _, value in by_angle[front:front + 20 + len(sent)]]
        assert got == [1000] * 10 + sent + [1000] * 10, f"{model}: {got}"


def has_any_fan(programs, folder):
    """A wall at 1 m to the left and at 1.5 m to the right, in scans that begin anywhere and go either way."""
    count = 720
    step = 2 * math.pi / count
    for first, increment, ends_twice in ((-math.pi, step, 0), (0, step, 0), (0, step, 1), (math.pi / 2, step, 0),
                                         (0, -step, 0), (math.pi, -step, 1)):
        angles = [first + i * increment for i in range(count + ends_twice)]
        recording = bag_of(folder, [1.0 if math.sin(angle) > 0 else 1.5 for angle in angles], (first, increment),
                           (0.1, 12))
        about, by_angle, log = played(programs, folder, recording)
        assert len(by_angle) == count and "warning" not in log, (first, increment, len(by_angle), log)
        assert "recorded" in about["model"], about
        wrong = [(angle, value) for angle, value in by_angle
                 if abs(math.sin(angle)) > 0.02 and value != (1000 if math.sin(angle) > 0 else 1500)]
        assert not wrong, (first, increment, wrong[:5])
        _, by_angle, log = played(programs, folder, recording, "--model", "UTM-30LX")
        assert "has no steps for" in log and "degrees" in log, log
        assert all(value == (1000 if angle > 0 else 1500) for angle, value in by_angle
                   if abs(math.sin(angle)) > 0.02), (first, increment)
    done = subprocess.run([programs[0], "--replay", str(recording), "--model", "UTM-30LX", "--strict"],
                          capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert done.returncode == 2 and "has no steps for" in done.stderr, done
    even = [1 + i / 100 for i in range(64)]
    _, by_angle, _ = played(programs, folder, bag_of(folder, even, (-31.5 * 0.01, 0.01), (0.1, 12)))
    assert [value for _, value in by_angle] == [1000 + 10 * i for i in range(64)], by_angle
    far = bag_of(folder, [150.0] * 361, (-math.pi / 2, math.pi / 360), (0.1, 200))
    about, by_angle, _ = played(programs, folder, far)
    assert (about["dmax_mm"], len(by_angle)) == (200000, 361) and {value for _, value in by_angle} == {150000}, about
    _, _, log = played(programs, folder, far, "--model", "UTM-30LX")
    assert "distances up to 150 m" in log, log


def two_scanners(folder, scans=40):
    """A bag of a front scanner and a rear one that was switched on 0.7 s later, at 10 Hz: scan i of the log has
    1000 + 10 i mm."""
    begin_ns = foreign.BEGIN_S * 10**9

    def message(topic, i):
        stamp = begin_ns + i * 100_000_000
        return topic, "sensor_msgs/LaserScan", stamp, foreign.ros1_scan(stamp, [1 + i / 100] * 541, (),
                                                                       (-math.pi / 2, math.pi / 540))

    (folder / "two.bag").write_bytes(foreign.bag([
        [message("/front/scan", i)] + ([message("/rear/scan", i)] if i >= 7 else []) for i in range(scans)]))
    return folder / "two.bag"


def serves_all_scanners(programs, folder):
    """Each on a port of its own. The first client gets the first scan, and the other scanner is 0.7 s behind."""
    scipd, scipcat, *_ = programs
    with Scipd(scipd, folder, "--replay", str(two_scanners(folder)), "--control", str(folder / "s")) as player:
        sensors = {sensor["name"]: sensor for sensor in player.ready["sensors"]}
        assert list(sensors) == ["robot/front_scan", "robot/rear_scan"], player.ready
        assert len({sensor["tcp"] for sensor in sensors.values()} | {s["pty"] for s in sensors.values()}) == 4, sensors
        control = Control(folder / "s")
        states = [control.ask("GET", f"/sensors/{name}/replay")[1] for name in sensors]
        assert [state["state"] for state in states] == ["waiting"] * 2, states
        done = subprocess.run([scipcat, "record", "tcp://" + sensors["robot/front_scan"]["tcp"], "-o",
                               str(folder / "front.jsonl"), "-n", "3"], capture_output=True, text=True,
                              timeout=PATIENCE_S, check=False)
        assert done.returncode == 0, done.stderr
        read = [json.loads(line)["distances_mm"][270] for line in (folder / "front.jsonl").read_text().splitlines()]
        assert read == [1000, 1010, 1020], read
        front, rear = (control.ask("GET", f"/sensors/{name}/replay")[1] for name in sensors)
        assert rear["state"] != "waiting", rear
        control.request("GET", "/configuration")
        saved = control.getresponse().read().decode()
        assert "/rear/scan" in saved, saved
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        low = probe.getsockname()[1]
    with Scipd(scipd, folder, "--replay", str(folder / "two.bag"), "--tcp", f"127.0.0.1:{low}", tcp=None) as player:
        ports = [int(sensor["tcp"].rsplit(":", 1)[1]) for sensor in player.ready["sensors"]]
        assert ports == [low, low + 1], ports


def plays_several_files(programs, folder):
    """The parts of a split log, by --replay and by a list of a configuration, which is saved as such."""
    step = math.radians(0.25)
    lines = [json.dumps({"host_time_s": 1000 + i / 40, "stamp_ms": 25 * i, "model": "UST-10LX", "first_step": 0,
                         "first_angle_rad": -540 * step, "angle_increment_rad": step,
                         "distances_mm": [1000 + i] * 1081}) + "\n" for i in range(30)]
    parts = [folder / "log_0.jsonl", folder / "log_1.jsonl"]
    for part, begin in zip(parts, (0, 15)):
        part.write_text("".join(lines[begin:begin + 15]))

    def holds_all(player):
        control = Control(folder / "s")
        status, replay = control.ask("GET", "/sensors/robot/scanner/replay")
        assert status == 200 and replay["scans"] == 30, replay
        control.request("GET", "/configuration")
        saved = control.getresponse().read().decode()
        assert all(str(part) in saved for part in parts), saved
        read = values_of(player, programs[1], folder)
        assert read == [1000 + i for i in range(30)], read
        return saved

    with Scipd(programs[0], folder, "--replay", *map(str, reversed(parts)), "--control", str(folder / "s")) as player:
        saved = holds_all(player)
    (folder / "saved.yaml").write_text(saved)
    with Scipd(programs[0], folder, "--config", str(folder / "saved.yaml"), "--control", str(folder / "s"), tcp=None,
               pty=None) as player:
        holds_all(player)


def values_of(player, scipcat, folder):
    """Step 300 of thirty scans."""
    done = subprocess.run([scipcat, "record", player.tcp, "-o", str(folder / "v.jsonl"), "-n", "30"],
                          capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert done.returncode == 0, done.stderr
    return [json.loads(line)["distances_mm"][300] for line in (folder / "v.jsonl").read_text().splitlines()]


def cuts_silence(programs, folder):
    """The front scanner rests for 90 s while the rear one goes on, and then both for 200 s."""
    begin_ns = foreign.BEGIN_S * 10**9
    times_s = {"/front/scan": [0, 1, 91, 92, 292, 293], "/rear/scan": [*range(93), 292.5, 293.5]}
    chunk = sorted((begin_ns + int(1e9 * time_s), topic) for topic, times in times_s.items() for time_s in times)
    (folder / "rests.bag").write_bytes(foreign.bag([[
        (topic, "sensor_msgs/LaserScan", stamp, foreign.ros1_scan(stamp, [1.0] * 541, (),
                                                                  (-math.pi / 2, math.pi / 540)))
        for stamp, topic in chunk]]))
    with Scipd(programs[0], folder, "--replay", str(folder / "rests.bag"), "--control", str(folder / "s")) as player:
        replays = [Control(folder / "s").ask("GET", f"/sensors/{sensor['name']}/replay")[1]
                   for sensor in player.ready["sensors"]]
    front_s, rear_s = (replay["duration_s"] for replay in replays)  # with a revolution behind the last scan
    assert 94 < front_s <= 95 and abs(rear_s - front_s - 0.5) < 1e-6, replays
    log = (folder / "stderr").read_text()
    assert "has no scan for more than a minute, 1 times, in sum for 199 s, which are left out" in log, log


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
        has_codes_again(programs, pathlib.Path(folder))
        has_any_fan(programs, pathlib.Path(folder))
        serves_all_scanners(programs, pathlib.Path(folder))
        cuts_silence(programs, pathlib.Path(folder))
        plays_several_files(programs, pathlib.Path(folder))
    print("recorded scans come again")


if __name__ == "__main__":
    main(*sys.argv[1:])
