#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
Every firmware that scipd can be passes `scipcat check` as itself, within 45 s, and is told from all others, over TCP
a tty. A machine too busy for 24 of them at once makes scipd late, and its kernel what a tty is given. So what fails
is checked once more, one scanner after the other. check_models_test.py SCIPD SCIPCAT SCENE
"""
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import time

sys.path.append(str(pathlib.Path(__file__).parents[2] / "end_to_end"))
from fault_lab import Lab  # noqa: E402

SCIPD, SCIPCAT, SCENE = sys.argv[1:4]
LONGEST_S = 45
# Two of those that have a tty as well.
BY_TTY = {"UST-10LX@2.23.0000", "UTM-30LX@P.1.05"}


def all_models():
    listed = subprocess.run([SCIPD, "--list-models"], capture_output=True, text=True, check=True).stdout
    return [line.split()[0] for line in listed.split("\n\n")[0].splitlines()[1:]]


def report_of(target, *options):
    done = subprocess.run([SCIPCAT, "check", target, "--json", *options], capture_output=True, text=True, timeout=100)
    return done.returncode, json.loads(done.stdout)


def failed_checks(report):
    return [check for check in report["checks"] if check["verdict"] == "fail"]


class Subject:
    """A scanner that is checked: its model, and where it is reached."""

    def __init__(self, model, target):
        self.model, self.target = model, target

    def check(self):
        begun = time.monotonic()
        self.exit_code, report = report_of(self.target)
        self.took_s = time.monotonic() - begun
        self.nearest = report["nearest"] or {}
        self.failed = failed_checks(report)
        verdicts = [check["verdict"] for check in report["checks"]]
        print(f"{self.model} by {self.target}: {self.took_s:.1f} s, {len(verdicts)} checks, "
              f"{verdicts.count('pass')} pass, {verdicts.count('differs')} differ, nearest {report['nearest']}")

    def check_again(self):
        """What has failed; all where an answer that came late hid which firmware it is."""
        if not self.nearest:
            return self.check()
        sections = [word for check in self.failed for word in ("--section", check["id"])]
        print(f"{self.model} by {self.target}: again", *(check["id"] for check in self.failed))
        self.exit_code, report = report_of(self.target, *sections)
        assert len(report["checks"]) == len(self.failed), report
        self.failed = failed_checks(report)

    def faults(self):
        found = [f"{self.model}: {check['id']} {check['name']}: {check['why']}; sent {check['sent']}, "
                 f"got {check['got']}" for check in self.failed]
        nearest = self.nearest
        if nearest.get("model") != self.model or nearest["alike"] != nearest["of"] or nearest["of"] < 100:
            found.append(f"{self.model} is taken for {nearest}")
        if self.exit_code != 0 or self.took_s > LONGEST_S:
            found.append(f"{self.model}: exit code {self.exit_code} after {self.took_s:.1f} s")
        return found


def main():
    models = all_models()
    assert len(models) >= 21, models
    mount = {"xyz": [0, 0, 0.3]}
    sensors = {f"m{i}": {"model": model, "tcp": "127.0.0.1:0", "mount": mount} for i, model in enumerate(models)}
    ttys = {f"t{i}": {"model": model, "pty": f"tty{i}", "mount": mount}
            for i, model in enumerate(models) if model in BY_TTY}
    # As slow as serial lines are, which carry no whole scan in a turn.
    ttys["line"] = {"model": "URG-04LX@3.3.00", "pty": "line", "mount": mount, "link": {"baud": 115200}}
    with Lab(SCIPD, SCENE, sensors={**sensors, **ttys}, lockstep=False) as lab:
        subjects = [Subject(keys["model"], "tcp://%s:%d" % lab.address(name)) for name, keys in sensors.items()]
        subjects += [Subject(keys["model"], lab.tty(name)) for name, keys in ttys.items()]
        # Nearly all of the time each of them waits.
        with concurrent.futures.ThreadPoolExecutor(len(subjects)) as pool:
            list(pool.map(Subject.check, subjects))
        for subject in subjects:
            if subject.failed:
                subject.check_again()
    sys.exit("\n".join(fault for subject in subjects for fault in subject.faults()) or None)


if __name__ == "__main__":
    main()
