#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
No check of `scipcat check` can pass by accident: each fails with a scanner that breaks just this promise, and does not
with one that breaks none. check_faults_test.py SCIPD SCIPCAT SCENE PART PARTS
"""
import concurrent.futures
import contextlib
import json
import pathlib
import queue
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).parents[2] / "end_to_end"))
from broken_promises import PROMISES  # noqa: E402
from fault_lab import Lab  # noqa: E402
from wrong_scanner import Fault, WrongScanner  # noqa: E402

SCIPD, SCIPCAT, SCENE = sys.argv[1:4]
PART, PARTS = map(int, sys.argv[4:6])
WORKERS = 8

# How many scanners of a kind there are, each for one client at a time, and what they are.
KINDS = {
    "ust": (WORKERS, {"model": "UST-10LX"}),
    "ew": (2, {"model": "UTM-30LX-EW"}),
    "urg": (4, {"model": "URG-04LX@3.3.00"}),
    "us": (2, {"model": "UST-30LC@4.1.0b-A"}),
    "io": (2, {"model": "UST-30LC@4.0.3", "profile": {"io_lines": True}}),
}
# Those that are another scanner after a check: each has a scipd of its own.
FRESH = {
    "scip1": {"model": "URG-04LX@3.3.00", "power_up": "scip1.1"},
    "wrap": {"model": "UST-10LX", "clock": {"start_ms": 2**24 - 4000}},
}


def sensor(keys):
    return {"tcp": "127.0.0.1:0", "mount": {"xyz": [0, 0, 0.3]}, **keys}


def lab(sensors):
    return Lab(SCIPD, SCENE, sensors={name: sensor(keys) for name, keys in sensors.items()}, lockstep=False)


def check(target, *options):
    """All that came of it, by number, and the exit code."""
    done = subprocess.run([SCIPCAT, "check", target, "--json", "--unsafe", *options], capture_output=True, text=True,
                          timeout=100)
    if not done.stdout:
        return {}, done.returncode
    return {each["id"]: each for each in json.loads(done.stdout)["checks"]}, done.returncode


class Scanners:
    """Lends each scanner to one at a time."""

    def __init__(self):
        self.idle = {kind: queue.Queue() for kind in KINDS}

    def fill(self, running):
        for kind, (count, _) in KINDS.items():
            for i in range(count):
                self.idle[kind].put(running.address(f"{kind}{i}"))

    @contextlib.contextmanager
    def one(self, kind):
        if kind in FRESH:
            with lab({"fresh": FRESH[kind]}) as running:
                yield running.address("fresh")
            return
        address = self.idle[kind].get()
        try:
            yield address
        finally:
            self.idle[kind].put(address)


def fault_of_broken(scanners, number):
    """What is wrong with a check: it must fail with the scanner that breaks its promise."""
    kind, fault = PROMISES[number]
    with scanners.one(kind) as address, WrongScanner(address, fault) as wrong:
        came, code = check(wrong.target, "--section", number)
    verdict = came.get(number, {}).get("verdict", "nothing")
    if verdict != "fail" or code != 1:
        return f"{number} says {verdict} of a scanner that breaks it (exit code {code}): {came.get(number)}"
    return None


def faults_of_sound(scanners, kind):
    """With a scanner that breaks nothing all these checks pass, through the same pieces."""
    numbers = [number for number, (its_kind, _) in PROMISES.items() if its_kind == kind]
    with scanners.one(kind) as address, WrongScanner(address, Fault()) as sound:
        came, code = check(sound.target, *(word for number in numbers for word in ("--section", number)))
    found = [f"{kind} breaks nothing, and {number} says {came.get(number)}" for number in numbers
             if came.get(number, {}).get("verdict") not in ("pass", "differs")]
    return found + ([f"{kind} breaks nothing, and the exit code is {code}"] if code else [])


def missing(scanners):
    """Checks that no scanner breaks."""
    with scanners.one("ust") as address:
        came, _ = check("tcp://%s:%d" % address)
    return [f"{number} is broken by no scanner of broken_promises.py" for number in came.keys() ^ PROMISES.keys()]


def main():
    scanners = Scanners()
    numbers = list(PROMISES)[PART::PARTS]
    sensors = {f"{kind}{i}": keys for kind, (count, keys) in KINDS.items() for i in range(count)}
    with lab(sensors) as running, concurrent.futures.ThreadPoolExecutor(WORKERS) as pool:
        scanners.fill(running)
        kinds = [*KINDS, *FRESH][PART::PARTS]
        jobs = [pool.submit(faults_of_sound, scanners, kind) for kind in kinds]
        jobs += [pool.submit(missing, scanners)] if PART == 0 else []
        broken = [pool.submit(fault_of_broken, scanners, number) for number in numbers]
        found = [fault for job in jobs for fault in job.result()]
        found += [job.result() for job in broken if job.result()]
    print(f"{len(numbers)} broken promises were tried")
    sys.exit("\n".join(found) or None)


if __name__ == "__main__":
    main()
