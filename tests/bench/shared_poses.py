# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What poses cost where many daemons hold one world: `python3 tests/bench/shared_poses.py BIN_FOLDER` starts a broker,
# daemons and a sender for each number of daemons and bodies. It prints the processor time of each for one pose of one
# body, the time that they take at rest subtracted, and how much of the world's poses a daemon has at rest in memory.
# Processor time hardly depends on what else the machine does. Wall time is not measured. docs/scaling.md, "Figures".
import argparse
import json
import pathlib
import subprocess
import sys
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/end_to_end"))

from fleet_lab import FleetLab  # noqa: E402
from fault_lab import wait_for  # noqa: E402

LINES_A_SECOND = 20_000
MOST_HZ = 50
SETTLE_S = 1.5


def cpu_s(pid):
    """Processor time of all its threads, in steps of a nanosecond."""
    ran = 0
    for task in pathlib.Path(f"/proc/{pid}/task").iterdir():
        ran += int((task / "schedstat").read_text().split()[0])
    return ran * 1e-9


def rss_mb(pid):
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    return int(status.split("VmRSS:")[1].split()[0]) / 1024


def place(i, bodies):
    side = int(bodies ** 0.5) + 1
    return 20 + 2.0 * (i % side), 2.0 * (i // side)


def crowd(bodies):
    """A world of MVSim, since one of SDF takes megabytes a model to read."""
    blocks = ("<block name='b{}'><init_pose>{} {} 0</init_pose></block>".format(i, *place(i, bodies))
              for i in range(bodies))
    return "<mvsim_world version='1.0'>" + "".join(blocks) + "</mvsim_world>"


def frames(bodies):
    """Two of them: all bodies a little to one side, and to the other."""
    made = []
    for shift in (0.0, 0.1):
        lines = []
        for i in range(bodies):
            x, y = place(i, bodies)
            lines.append(json.dumps({"model": f"b{i}", "xyz": [x + shift, y, 0.5], "q": [0, 0, 0, 1]}))
        made.append(("\n".join(lines) + "\n").encode())
    return made


class Sender:
    """`scipctl pose stream`, as a simulator uses it."""

    def __init__(self, scipctl, url, bodies):
        self.process = subprocess.Popen([scipctl, "pose", "stream", "--to", url], stdin=subprocess.PIPE)
        self.frames = frames(bodies)
        self.period_s = 1 / min(MOST_HZ, LINES_A_SECOND / bodies)
        self.sent = 0
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        due = time.monotonic()
        while not self.over.is_set():
            self.process.stdin.write(self.frames[self.sent % 2])
            self.process.stdin.flush()
            self.sent += 1
            due = max(due + self.period_s, time.monotonic() - 1)
            time.sleep(max(0.0, due - time.monotonic()))

    def end(self):
        self.over.set()
        self.thread.join()
        self.process.stdin.close()
        self.process.wait(60)


def measure(programs, bodies, daemons, seconds, reading):
    with FleetLab(str(programs / "scipd")) as lab:
        (lab.folder / "crowd.xml").write_text(crowd(bodies))
        for i in range(daemons):
            lab.start(f"d{i}", scene="crowd.xml", world="crowd", backend="embree")
        if reading:
            for daemon in lab.daemons:
                daemon.scanner.say("MD0000108000000")
                threading.Thread(target=drain, args=(daemon.scanner,), daemon=True).start()
        rest = use(lab, None, seconds)
        sender = Sender(str(programs / "scipctl"), f"{lab.broker.url}/crowd", bodies)
        try:
            time.sleep(SETTLE_S)
            busy = use(lab, sender, seconds)
        finally:
            sender.end()
        last = place(bodies - 1, bodies)[0] + 0.1 * ((sender.sent - 1) % 2)
        for daemon in lab.daemons:
            wait_for(lambda d=daemon: abs(d.pose(f"/scene/models/b{bodies - 1}")[0] - last) < 1e-6,
                     f"{daemon.name} has not taken the last pose")
        dropped = sum(daemon.ask("GET", "/status")[1]["fleet"]["frames_dropped"] for daemon in lab.daemons)
        lines = busy["frames"] * bodies
        each = {who: 1e6 * (busy[who] - rest[who]) / lines for who in ("daemons", "broker")}
        return {"lines_a_second": lines / busy["seconds"], "daemon_us": each["daemons"] / daemons,
                "broker_us": each["broker"], "sender_us": 1e6 * busy["sender"] / lines,
                "daemon_mb": max(rss_mb(daemon.process.pid) for daemon in lab.daemons), "dropped": dropped}


def drain(scanner):
    try:
        while scanner.socket.recv(65536):
            pass
    except OSError:
        pass


def use(lab, sender, seconds):
    """Processor time of all within some seconds, and how many frames were sent in them."""
    def now():
        return {"daemons": sum(cpu_s(daemon.process.pid) for daemon in lab.daemons),
                "broker": cpu_s(lab.broker.process.pid), "sender": cpu_s(sender.process.pid) if sender else 0.0,
                "frames": sender.sent if sender else 0, "seconds": time.monotonic()}
    begin = now()
    time.sleep(seconds)
    end = now()
    return {who: end[who] - begin[who] for who in begin}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("programs", type=pathlib.Path, help="the folder with scipd and scipctl")
    parser.add_argument("--bodies", default="10,100,1000,10000")
    parser.add_argument("--daemons", default="1,2,4,8")
    parser.add_argument("--seconds", type=float, default=6.0)
    parser.add_argument("--reading", action="store_true", help="a client reads the scanner of each daemon")
    said = parser.parse_args()
    print("bodies daemons   lines/s   us of a daemon   us of the broker   the same a daemon   us of the sender   "
          "MB of a daemon   frames dropped")
    for bodies in map(int, said.bodies.split(",")):
        for daemons in map(int, said.daemons.split(",")):
            got = measure(said.programs, bodies, daemons, said.seconds, said.reading)
            print(f"{bodies:6} {daemons:7} {got['lines_a_second']:9.0f} {got['daemon_us']:16.2f} "
                  f"{got['broker_us']:18.3f} {got['broker_us'] / daemons:19.3f} {got['sender_us']:18.2f} "
                  f"{got['daemon_mb']:16.0f} {got['dropped']:16}", flush=True)


if __name__ == "__main__":
    main()
