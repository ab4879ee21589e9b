# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Two daemons whose time somebody leads send the same bytes as one daemon with both robots, and one that dies holds
# nobody up. fleet_lockstep_test.py SCIPD SCIPCTL
import json
import subprocess
import sys
import threading

from fault_lab import Client, PATIENCE_S, wait_for
from fleet_lab import BOX, FleetLab, hall

SCANS = 80
POSES_PER_S = 50
SECONDS = 3
ROBOTS = {"east": {"body": "cart", "pose": {"xyz": [4, 1, 0.3]}},
          "west": {"body": "wagon", "pose": {"xyz": [-1, 0, 0.3]}}}
WAGON = BOX.format(name="wagon", pose="9 9 0.3", size="0.4 0.4 0.4")


def line(robot, i):
    t_s = 1.7e9 + i / POSES_PER_S
    x_m = 3 + 0.02 * i if robot == "east" else -0.5 + 0.01 * i
    return json.dumps({"robot": robot, "t": t_s, "xyz": [x_m, 0.1, 0.3], "rpy": [0, 0, 0.001 * i]}) + "\n"


def lines(begin=0, end=SECONDS * POSES_PER_S):
    return "".join(line(robot, i) for i in range(begin, end) for robot in ROBOTS)


class Reader(threading.Thread):
    """Reads so many scans, from another thread: time waits for whoever reads."""

    def __init__(self, client, scans=SCANS):
        super().__init__()
        self.client = client
        self.end = 1 + scans
        client.say("MD0000108001000")
        self.start()

    def run(self):
        while self.client.got.count(b"\n\n") < self.end:
            if not self.client.read():
                return

    def bytes(self):
        self.join(PATIENCE_S)
        messages = self.client.got.split(b"\n\n")
        assert len(messages) > self.end, f"{len(messages)} messages"
        return messages[:self.end]


def of_one_daemon(lab, scipd):
    sensors = {"scanner": {"model": "UST-10LX", "mount": {"xyz": [0, 0, 0.3]}, "tcp": "127.0.0.1:0"}}
    robots = {name: {**robot, "sensors": sensors} for name, robot in ROBOTS.items()}
    robots["east"]["poses"] = "-"
    (lab.folder / "one.yaml").write_text(json.dumps(
        {"scene": str(lab.folder / "hall.sdf"), "clock": "poses", "control": str(lab.folder / "one.sock"),
         "robots": robots}))
    with subprocess.Popen([scipd, "--config", str(lab.folder / "one.yaml")], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as one:
        ready = json.loads(one.stdout.readline())
        readers = []
        for sensor in ready["sensors"]:
            host, port = sensor["tcp"].rsplit(":", 1)
            readers.append(Reader(Client((host, int(port)))))
        one.stdin.write(lines())
        one.stdin.flush()
        heard = [reader.bytes() for reader in readers]
        one.terminate()
    return heard


def of_many_daemons(lab, scipctl):
    daemons = [lab.start(name, robot=robot, clock="poses", accuracy="sensor") for name, robot in ROBOTS.items()]
    readers = [Reader(daemon.scanner) for daemon in daemons]
    led = subprocess.run([scipctl, "pose", "stream", "--lockstep", "--to", lab.broker.url + "/hall"], input=lines(),
                         capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert led.returncode == 0 and not led.stderr, led
    heard = [reader.bytes() for reader in readers]
    for daemon in daemons:
        assert daemon.end() == 0
    return heard


def one_that_dies_holds_nobody_up(lab, scipctl):
    daemons = {name: lab.start(name, robot=robot, clock="poses") for name, robot in ROBOTS.items()}
    with subprocess.Popen([scipctl, "pose", "stream", "--lockstep", "--to", lab.broker.url + "/hall"],
                          stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as leader:
        leader.stdin.write(lines(0, 50))
        leader.stdin.flush()
        wait_for(lambda: daemons["west"].ask("GET", "/status")[1]["time_s"] > 1.7e9 + 0.9, "time does not go on")
        # Somebody else's step, a century ahead, carries time nowhere.
        for t_ns in (10 ** 18, 4 * 10 ** 18):
            lab.broker.say("scipd/hall/time", f"# step 7 t_ns {t_ns} from nobody\n", "-q", "1")
        wait_for(lambda: "step 7 from nobody refused" in daemons["west"].log(), "the leap is not told")
        daemons["east"].kill()
        leader.stdin.write(lines(50))
        leader.stdin.close()
        assert leader.wait(PATIENCE_S) == 0
        said = leader.stderr.read()
    assert "daemon east" in said and "left out" in said, said
    end_s = 1.7e9 + SECONDS - 1 / POSES_PER_S
    wait_for(lambda: abs(daemons["west"].ask("GET", "/status")[1]["time_s"] - end_s) < 1e-6, "time stands still")


def main(scipd, scipctl):
    with FleetLab(scipd) as lab:
        (lab.folder / "hall.sdf").write_text(hall(WAGON))
        alone = of_one_daemon(lab, scipd)
        together = of_many_daemons(lab, scipctl)
        for name, one, many in zip(ROBOTS, alone, together):
            assert len(set(one)) > SCANS / 2  # they do not stand still
            for number, (a, b) in enumerate(zip(one, many)):
                assert a == b, f"{name}: message {number} differs"
        one_that_dies_holds_nobody_up(lab, scipctl)


main(*sys.argv[1:])
