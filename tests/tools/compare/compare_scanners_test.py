#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
What scipcat compare says of scanners of scipd: compare_scanners_test.py SCIPD SCIPCAT. Two scanners of one serial
number are one unit with other chance; what is changed in the others is named, and nothing else.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

SCIPD, SCIPCAT = sys.argv[1:3]

BOXES = [(5, 0, 0.2, 8), (-3, 0, 0.2, 8), (1, 4, 8, 0.2), (1, -4, 8, 0.2)]


def world(boxes):
    """Walls and a box, 2 m high."""
    models = "".join(
        f'<model name="m{i}"><static>true</static><pose>{x} {y} 1 0 0 0</pose><link name="l"><visual name="v">'
        f"<geometry><box><size>{long} {wide} 2</size></box></geometry></visual></link></model>"
        for i, (x, y, long, wide) in enumerate(boxes))
    return f'<sdf version="1.9"><world name="w">{models}</world></sdf>'


def robots(sensors):
    lines = ["robots:", "  r:", "    sensors:"]
    for name, words in sensors.items():
        lines.append(f"      {name}: {{model: UST-10LX, mount: {{xyz: [0, 0, 0.3]}}, tcp: '127.0.0.1:0'{words}}}")
    return "\n".join(lines) + "\n"


class Scipd:
    """A scipd with these sensors; `targets` by their names."""

    def __init__(self, folder, name, boxes, sensors):
        (folder / f"{name}.sdf").write_text(world(boxes))
        config = folder / f"{name}.yaml"
        config.write_text(f"scene: {name}.sdf\n" + robots(sensors))
        self.process = subprocess.Popen([SCIPD, "--config", config], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        text=True)
        ready = json.loads(self.process.stdout.readline())
        self.targets = {sensor["name"].split("/")[1]: "tcp://" + sensor["tcp"] for sensor in ready["sensors"]}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(timeout=30)


def record_all(folder, targets, scans):
    """All at once, so that it takes no longer than one."""
    recorders = [subprocess.Popen([SCIPCAT, "record", target, "-o", folder / f"{name}.mcap", "-n", str(scans)],
                                  stderr=subprocess.DEVNULL)
                 for name, target in targets.items()]
    assert all(recorder.wait(timeout=120) == 0 for recorder in recorders)


def compared(a, b, *words):
    done = subprocess.run([SCIPCAT, "compare", a, b, "--json", *words], capture_output=True, text=True, timeout=120)
    assert done.returncode in (0, 1), done.stderr
    document = json.loads(done.stdout)
    assert document["verdict"] == ("differ" if done.returncode else "alike")
    return document


def kinds(document):
    return {difference["what"] for difference in document["differ"]}


def steps(document, what):
    return sum(one["to"] - one["from"] + 1 for one in document["differ"] if one["what"] == what)


def check_one_unit(folder):
    document = compared(folder / "one.mcap", folder / "seed.mcap")
    assert document["verdict"] == "alike", document["differ"]
    assert abs(document["mean_mm"]) < document["floor"]["mean_mm"], document["mean_mm"]
    assert abs(document["sd_b_mm"] - document["sd_a_mm"]) < document["floor"]["sd_mm"]


def check_another_unit(folder):
    document = compared(folder / "one.mcap", folder / "unit.mcap")
    assert kinds(document) == {"mean"}, document["differ"]
    assert steps(document, "mean") > 500, document["differ"]
    # Given as a bias of 9 mm everywhere.
    assert abs(document["mean_mm"] - 9) < 1, document["mean_mm"]


def check_noise(folder):
    document = compared(folder / "one.mcap", folder / "loud.mcap")
    assert kinds(document) == {"sd"}, document["differ"]
    assert steps(document, "sd") > 900, document["differ"]
    assert 1.9 < document["sd_b_mm"] / document["sd_a_mm"] < 2.1, document


def check_moved(folder):
    document = compared(folder / "one.mcap", folder / "moved.mcap")
    box = [one for one in document["differ"] if one["what"] == "mean" and one["to"] - one["from"] > 20]
    assert len(box) == 1, document["differ"]
    # The face of the box is 2.2 m ahead and 1.1 to 1.9 m to the right: 540 less 27 to 41 degrees.
    assert 370 < box[0]["from"] and box[0]["to"] < 440, box
    assert 20 < box[0]["a"] - box[0]["b"] < 28, box


def check_clock(targets):
    # A busy machine hears of the time late. Its interval says so, and may hold 0 until it has heard for longer.
    for scans in 320, 960, 1600:
        document = compared(targets["one"], targets["fast"], "-n", str(scans))
        found = [one for one in document["differ"] if one["what"] == "clock"]
        if found:
            break
    assert len(found) == 1, (document["differ"], document["a"], document["b"])
    low, high = found[0]["within"]
    assert abs(found[0]["ppm"] - 50) < max(20, high - low), found
    assert 15 < document["a"]["latency_ms"] < 60, document["a"]


def main():
    one = ", profile: {serial: H0000042}, bias: none"
    sensors = {"one": one, "seed": one, "loud": one + ", noise: 2", "fast": one + ", clock: {ppm: 50}",
               "unit": ", profile: {serial: H0000042}, bias: [{range_m: 1, bias_m: 0.009}]"}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        with Scipd(folder, "still", [*BOXES, (2.5, -1.5, 0.6, 0.8)], sensors) as scipd:
            record_all(folder, {key: scipd.targets[key] for key in ("one", "seed", "loud", "unit")}, 80)
            check_one_unit(folder)
            check_another_unit(folder)
            check_noise(folder)
            check_clock(scipd.targets)
        with Scipd(folder, "changed", [*BOXES, (2.48, -1.5, 0.6, 0.8)], {"moved": one}) as scipd:
            record_all(folder, scipd.targets, 80)
        check_moved(folder)


if __name__ == "__main__":
    main()
