# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# In lockstep, scanners whose scans end at one stamp are cast side by side, and send the same bytes for every number of
# threads: while they and people move, with materials and with skips, and where a fault stops one from the beginning.
# lockstep_threads_test.py SCIPD SCENES
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import threading

from fault_lab import PATIENCE_S, Client

THREADS = [1, 2, 5]
SECONDS = 3
POSES_PER_S = 50
# By model: its steps, turns that it passes over, and scans that come in a second.
MODELS = [("UST-10LX", "00001080", 0, 40), ("UTM-30LX", "00001080", 0, 40), ("URG-04LX-UG01", "00440725", 0, 10),
          ("UST-20LX", "00001080", 2, 13)]
ROBOTS = 12
STOPPED = 1  # it has a trajectory of its own, and its scanner sees from where that begins


def scanner(i):
    return {"model": MODELS[i % len(MODELS)][0], "tcp": "127.0.0.1:0", "mount": {"xyz": [0, 0, 0.3]},
            "accuracy": "material" if i % 3 == 0 else "sensor"}


def name(i):
    return f"r{i:02}"


def poses():
    """Each other robot drives in a circle of its own."""
    lines = []
    for k in range(POSES_PER_S * SECONDS + 1):
        for i in set(range(ROBOTS)) - {STOPPED}:
            angle = k / POSES_PER_S + i
            xyz = [0.3 * math.cos(angle) + 0.1 * i - 0.6, 0.3 * math.sin(angle), 0]
            lines.append(json.dumps({"robot": name(i), "t": k / POSES_PER_S, "xyz": xyz,
                                     "rpy": [0, 0, math.remainder(angle, 2 * math.pi)]}))
    return "\n".join(lines) + "\n"


def configure(folder, scenes):
    robots = {name(i): {"sensors": {"scanner": scanner(i)}} for i in range(ROBOTS)}
    robots[name(0)]["poses"] = "-"
    (folder / "drive.tum").write_text("".join(f"{t} {0.8 + 0.1 * t} 0 0 0 0 0 1\n" for t in range(SECONDS + 1)))
    robots[name(STOPPED)]["poses"] = "drive.tum"
    (folder / "stops.yaml").write_text(json.dumps(
        {"steps": [{"sensor": f"{name(STOPPED)}/scanner", "kind": "poses", "how": "stop"}]}))
    (folder / "lab.yaml").write_text(json.dumps(
        {"scene": str(scenes / "crossing.sdf"), "clock": "poses", "seed": 11, "control": str(folder / "s"),
         "scenario": "stops.yaml", "robots": robots}))
    return folder / "lab.yaml"


class Reader(threading.Thread):
    """Reads until the poses end, from another thread: time waits for whoever reads."""

    def __init__(self, address, i):
        super().__init__()
        host, port = address.rsplit(":", 1)
        self.client = Client((host, int(port)))
        _, steps, skips, per_second = MODELS[i % len(MODELS)]
        self.end = 1 + (SECONDS - 1) * per_second
        self.client.ask("BM")
        self.client.ask(f"MD{steps}00{skips}00")

    def run(self):
        while self.client.got.count(b"\n\n") < self.end and self.client.read():
            pass

    def messages(self):
        self.join(PATIENCE_S)
        messages = self.client.got.split(b"\n\n")
        assert len(messages) > self.end, f"{len(messages)} messages"
        return messages[:self.end]


def heard(scipd, configuration, threads):
    with subprocess.Popen([scipd, "--config", str(configuration), "--threads", str(threads)], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
        ready = json.loads(process.stdout.readline())
        readers = [Reader(sensor["tcp"], i) for i, sensor in enumerate(ready["sensors"])]
        for reader in readers:
            reader.start()
        process.stdin.write(poses())
        process.stdin.flush()
        messages = [reader.messages() for reader in readers]
        tasks = pathlib.Path(f"/proc/{process.pid}/task").iterdir()
        at_work = sum((task / "comm").read_text().startswith("casts ") for task in tasks)
        assert at_work == threads - 1, f"{at_work} threads beside the first"
        process.terminate()
    return messages


def main(scipd, scenes):
    with tempfile.TemporaryDirectory() as folder:
        configuration = configure(pathlib.Path(folder), pathlib.Path(scenes))
        alone, *others = [heard(scipd, configuration, threads) for threads in THREADS]
    for threads, other in zip(THREADS[1:], others):
        for i in range(ROBOTS):
            assert alone[i] == other[i], f"{name(i)} sends other bytes with {threads} threads"
    print("scanners send the same bytes with", ", ".join(map(str, THREADS)), "threads")


if __name__ == "__main__":
    main(*sys.argv[1:])
