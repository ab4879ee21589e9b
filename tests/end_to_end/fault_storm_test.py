# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Random scenarios of ten minutes. A driver goes on through all of it as well as it can; after the last fault everything
# that drivers do works again, and gets the very answers of a scanner that has never had a fault.
# fault_storm_test.py SCIPD SCENE [SEED..]
import json
import random
import sys
import threading
import time

from fault_lab import Client, Lab, Scan

MINUTES = 10
FAULTS_S = 60 * MINUTES - 40  # in which faults begin
LAST_S = 60 * MINUTES - 15    # all are over
FAULTS = 60
SCANNER = {"model": "UST-10LX", "tcp": "127.0.0.1:0", "pty": "auto", "mount": {"xyz": [0, 0, 0.3]}}
# Each gives the members of a kind.
MEMBERS = {
    "corrupt": lambda r: {"bytes": {"rate": r.choice([0.001, 0.1])}, "within": r.choice(["all", "sums"])},
    "lose": lambda r: {"bytes": {"rate": 0.001}, "messages": r.choice(["all", "scans", "replies"])},
    "duplicate": lambda r: {"bytes": {"at": [r.randrange(100)]}},
    "noise": lambda r: {"count": r.randrange(1, 200), "value": r.choice(["nul", "random"])},
    "delay": lambda r: {"ms": r.randrange(1, 500), "jitter_ms": r.randrange(0, 5)},
    "coalesce": lambda r: {"ms": r.randrange(1, 300)},
    "split": lambda r: {"bytes": {"every": r.randrange(200, 2000)}, "pause_ms": 1},
    "stall": lambda r: {},
    "cut": lambda r: {"how": r.choice(["fin", "rst", "silent", "refuse", "mute"]), "boot": r.random() < 0.5},
    "hangup": lambda r: {},
    "sums": lambda r: {"of": r.choice(["status", "data", "text", "all"]), "rate": r.random()},
    "truncate": lambda r: {"keep": r.randrange(0, 100), "rate": r.random()},
    "linefeed": lambda r: {"lines": r.choice(["last", "all"]), "rate": r.random()},
    "echo": lambda r: {"messages": r.choice(["all", "scans", "replies"])},
    "resend": lambda r: {"what": r.choice(["twice", "previous"])},
    "status": lambda r: {"status": r.choice(["0L", "0M", "10", "50"])},
    "reboot": lambda r: {"boot_s": r.choice([0.1, 3])},
    "state": lambda r: {"state": r.choice(["unstable", "recovering", "laser", "abnormal"])},
    "sleep": lambda r: {},
    "motor": lambda r: r.choice([{"percent": r.randrange(-50, 51)}, {"spin_up_s": 2}]),
    "clock": lambda r: r.choice([{"jump_ms": r.randrange(-100000, 100000)}, {"ppm": 5000}, {"wrap_in_s": 1.5},
                                 {"frozen": True}, {"repeat": 3}]),
    "repeat": lambda r: {"rate": r.random()},
    "reorder": lambda r: {"rate": r.random()},
    "freeze": lambda r: {},
    "skip": lambda r: {"rate": r.random()},
    "late": lambda r: {"ms": r.randrange(1, 900)},
    "shift": lambda r: {"by": r.randrange(1, 1000)},
    "intensity": lambda r: {},
    "dirty": lambda r: {"steps": [0, 1080], "reads": r.choice(["near", "weak", "nothing"])},
    "blind": lambda r: {"steps": [100, r.randrange(100, 1081)]},
    "interference": lambda r: {"rate": r.random()},
    "stick": lambda r: {"steps": [0, r.randrange(1081)]},
    "poses": lambda r: r.choice([{"how": "stop"}, {"how": "late", "ms": 300}, {"how": "jump", "xyz": [0.5, 0, 0]}]),
}
MOMENTARY = {"reboot"}


def step(r, kind):
    fault = {"sensor": "robot/front", "kind": kind, **MEMBERS[kind](r)}
    begin_s = r.uniform(0, FAULTS_S)
    if r.random() < 0.2 and begin_s < FAULTS_S / 2:
        fault["at"] = {"request": r.choice(["MD", "BM", "VV"]), "nth": r.randrange(1, 5)}
    elif r.random() < 0.3:
        fault["at"] = {"scans": round(begin_s * 40)}
    else:
        fault["at"] = {"s": round(begin_s, 3)}
    if kind not in MOMENTARY:
        fault["for"] = r.choice([{"s": round(r.uniform(0.01, 20), 3)}, {"scans": r.randrange(1, 400)}])
    return fault


class Traffic(threading.Thread):
    """A stream of the scanner beside it, with which time goes on. It misses nothing."""

    def __init__(self, address):
        super().__init__(daemon=True)
        self.client = Client(address)
        self.client.ask("BM")
        self.client.ask("MD0000108010000")
        self.scans = 0
        self.gaps = set()

    def run(self):
        last = None
        buffer = self.client.got.split(b"\n\n", 2)[2]
        while last is None or self.scans < 40 * LAST_S:
            time.sleep(0.001)  # so that the driver sees something of each fault
            *messages, buffer = (buffer + self.client.socket.recv(1 << 16)).split(b"\n\n")
            for message in messages:
                stamp = Scan(message).stamp_ms
                if last is not None:
                    self.gaps.add(stamp - last)
                last = stamp
                self.scans += 1
        self.client.close()


def drive(address, traffic):
    """A driver that begins anew whenever something is wrong."""
    streams = 0
    while traffic.is_alive():
        try:
            client = Client(address)
        except OSError:
            traffic.join(0.01)
            continue
        client.socket.settimeout(0.1)
        try:
            for line in ("QT", "VV", "BM", "MD0000108000005"):
                client.say(line)
                client.got = b""
                while not client.got.endswith(b"\n\n"):
                    more = client.socket.recv(65536)
                    if not more:
                        raise ConnectionError
                    client.got += more
            streams += 1
        except OSError:
            pass
        client.close()
    return streams


def ask_all(lab):
    """Everything that drivers do, and what is answered but for times and noise."""
    client = Client(lab.address("front"))
    client.ask("RS")
    answers = [client.ask(line) for line in ("VV", "PP", "BM", "QT", "TM0", "TM2", "BM")]
    for line, last in (("MD0000108000003", b"MD0000108000000\n99b\n"), ("MD0000108002102", b"MD0000108002100\n99b\n"),
                       ("ME0000108000001", b"ME0000108000000\n99b\n")):
        begin = len(client.got)
        client.ask(line)
        client.read_until(last, begin)
        client.read_until(b"\n\n", client.got.index(last, begin))
        stream = client.got[begin:]
        answers.append([message[:20] for message in stream.split(b"\n\n")])
        for message in stream.split(b"\n\n")[1:-1]:
            assert Scan(message).sound, message
    for line in ("BM", "GD0000108000", "GS0000108000", "%ST", "II", "QT"):
        answers.append(client.ask(line)[:8])
    client.close()
    return answers


def try_storm(scipd, scene, seed, expected):
    r = random.Random(seed)
    kinds = list(MEMBERS) + [r.choice(list(MEMBERS)) for _ in range(FAULTS - len(MEMBERS))]
    # While the traffic ends, time runs ahead by what the kernel holds of its stream.
    with Lab(scipd, scene, sensors={"front": SCANNER, "rear": SCANNER}, drive_s=60 * MINUTES + 300) as lab:
        told = {kind["kind"] for kind in lab.control.ask("GET", "/faults/kinds")[1]}
        assert told == set(MEMBERS), f"MEMBERS lacks or has too many: {told ^ set(MEMBERS)}"
        scenario = json.dumps({"seed": seed, "steps": [step(r, kind) for kind in kinds]})
        status, answer = lab.control.ask("PUT", "/scenario", {"name": "storm.yaml", "yaml": scenario})
        assert status == 200, answer
        traffic = Traffic(lab.address("rear"))
        traffic.start()
        streams = drive(lab.address("front"), traffic)
        assert traffic.scans >= 40 * LAST_S and traffic.gaps <= {24, 25, 26}, f"the other one's gaps: {traffic.gaps} ms"
        states = lab.control.ask("GET", "/scenario")[1]
        left = [s for s in states["steps"] if s["state"] != "ended"]
        hits = sum(s["hits"] for s in states["steps"])
        lab.control.ask("DELETE", "/scenario")
        answers = ask_all(lab)
        assert answers == expected, [(a, b) for a, b in zip(answers, expected) if a != b][:3]
        assert not lab.log("rear")
        print(f"seed {seed}: {traffic.scans} scans, {streams} streams of the driver, {hits} injections, "
              f"{len(left)} faults waited in vain", flush=True)
        assert hits > 100 and streams > 5


def main(scipd, scene, *seeds):
    with Lab(scipd, scene, sensors={"front": SCANNER, "rear": SCANNER}) as lab:
        expected = ask_all(lab)
    for seed in [int(seed) for seed in seeds] or [1, 2]:
        try_storm(scipd, scene, seed, expected)


if __name__ == "__main__":
    main(*sys.argv[1:])
