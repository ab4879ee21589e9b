#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
Every firmware that scipd can be passes `scipcat check` as itself, within 45 s, and is told from all others, over TCP
and a tty. check_models_test.py SCIPD SCIPCAT SCENE
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
# Of those that have a tty as well.
BY_TTY = {"UST-10LX@2.23.0000", "UTM-30LX@P.1.05"}


def all_models():
    listed = subprocess.run([SCIPD, "--list-models"], capture_output=True, text=True, check=True).stdout
    return [line.split()[0] for line in listed.split("\n\n")[0].splitlines()[1:]]


def faults(model, target):
    begun = time.monotonic()
    done = subprocess.run([SCIPCAT, "check", target, "--json"], capture_output=True, text=True, timeout=100)
    took_s = time.monotonic() - begun
    report = json.loads(done.stdout)
    verdicts = [check["verdict"] for check in report["checks"]]
    print(f"{model} by {target}: {took_s:.1f} s, {len(verdicts)} checks, {verdicts.count('pass')} pass, "
          f"{verdicts.count('differs')} differ, nearest {report['nearest']}")
    found = [f"{model}: {check['id']} {check['name']}: {check['why']}; sent {check['sent']}, got {check['got']}"
             for check in report["checks"] if check["verdict"] == "fail"]
    nearest = report["nearest"] or {}
    if nearest.get("model") != model or nearest["alike"] != nearest["of"] or nearest["of"] < 100:
        found.append(f"{model} is taken for {nearest}")
    if done.returncode != 0 or report["failed"] != 0 or took_s > LONGEST_S:
        found.append(f"{model}: exit code {done.returncode} after {took_s:.1f} s")
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
        targets = [(keys["model"], "tcp://%s:%d" % lab.address(name)) for name, keys in sensors.items()]
        targets += [(keys["model"], lab.tty(name)) for name, keys in ttys.items()]
        # Nearly all of the time each of them waits.
        with concurrent.futures.ThreadPoolExecutor(len(targets)) as pool:
            found = [fault for each in pool.map(faults, *zip(*targets)) for fault in each]
    sys.exit("\n".join(found) or None)


if __name__ == "__main__":
    main()
