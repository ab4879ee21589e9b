# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Whatever the number of threads that scanners live on, they send the same bytes, poses and edits reach all of them,
# and a reload leaves them in peace. threads_test.py SCIPD SCENE
import contextlib
import json
import pathlib
import signal
import statistics
import subprocess
import sys
import threading
import time

from fault_lab import PATIENCE_S, Client, Lab, Scan, wait_for
from wire import decoded

THREADS = [1, 2, 5]
SCANNERS = 7
SCANS = 60
COMPARED = 15  # of each scanner, at least
PHASE_MS = 3  # that of every mirror, so that scan n has the same stamp in every run


def scanner(i):
    model = ["UST-10LX", "UTM-30LX", "URG-04LX-UG01"][i % 3]
    return {"model": model, "tcp": "127.0.0.1:0", "mount": {"xyz": [0, 0.05 * i, 0.3]}, "clock": {"phase_ms": PHASE_MS},
            "backend": "embree", "accuracy": "material" if i == 0 else "sensor"}


def lab(program, scene, threads, **more):
    return Lab(program, scene, sensors={f"s{i}": scanner(i) for i in range(SCANNERS)}, lockstep=False,
               options=["--threads", str(threads)], **more)


def stream(client, scans=SCANS):
    """Asks for so many scans; 0: for all that come."""
    client.ask("BM")
    steps = "00440725" if "URG-04LX" in client.ask("VV").decode() else "00001080"
    client.say(f"MD{steps}000{scans:02}")


def messages(client):
    """The scans that have come whole."""
    return [text for text in client.got.split(b"\n\n")[:-1] if b"\n99b\n" in text]


class Stamped:
    """A client's scans by their stamps. What has come is looked at once, so that this keeps up with many clients."""

    def __init__(self, client):
        self.client = client
        self.scans = {}

    def read(self):
        more = self.client.read()
        scans = messages(self.client)
        self.scans |= {decoded(text.split(b"\n")[2][:4]): text for text in scans}
        self.client.got = self.client.got.split(b"\n\n")[-1]
        return more


def all_messages(client, scans=SCANS):
    wait_for(lambda: client.read() and len(messages(client)) == scans, "scans")
    return messages(client)


def in_common(clients):
    """The stamps of the scans that each of them has got."""
    return set.intersection(*(set(client.scans) for client in clients))


def sends_the_same_bytes(program, scene):
    """A machine that is too slow loses other scans in every run: some are in common sooner or later."""
    with contextlib.ExitStack() as runs:
        labs = [runs.enter_context(lab(program, scene, threads)) for threads in THREADS]
        scanners = [[Stamped(Client(running.address(f"s{i}"))) for running in labs] for i in range(SCANNERS)]
        everyone = [client for clients in scanners for client in clients]
        for client in everyone:
            stream(client.client, 0)
        wait_for(lambda: all(client.read() for client in everyone)
                 and all(len(in_common(clients)) >= COMPARED for clients in scanners), "scans to compare")
        seen = set()
        for i, clients in enumerate(scanners):
            for stamp in in_common(clients):
                assert len({client.scans[stamp] for client in clients}) == 1, f"s{i}: {stamp} differs"
                seen.add(clients[0].scans[stamp])
        assert len(seen) >= COMPARED * SCANNERS, "all scans are alike"


def ahead_m(running, i):
    """Of one scan that was fired from now on: the median of the beams in its middle, which look along x."""
    client = Client(running.address(f"s{i}"))
    stream(client, 3)
    last = Scan(all_messages(client, 3)[-1])
    client.close()
    middle = len(last.ranges) // 2
    return statistics.median(last.ranges[middle - 10:middle + 11]) / 1000


def tells_all_of_poses_and_edits(program, scene):
    with lab(program, scene, 4) as running:
        before = [ahead_m(running, i) for i in range(SCANNERS)]
        status, said = running.control.ask("PUT", "/robots/robot/pose", {"xyz": [1.2, 0, 0], "rpy": [0, 0, 0]})
        assert status in (200, 204), said
        moved = [ahead_m(running, i) for i in range(SCANNERS)]
        box = ("<model name='b'><static>true</static><pose>1.9 0 0.3 0 0 0</pose><link name='l'><visual name='v'>"
               "<geometry><box><size>0.2 4 0.6</size></box></geometry></visual></link></model>")
        status, said = running.control.ask("POST", "/scene/models",
                                           {"name": "b", "sdf": box, "pose": {"xyz": [1.9, 0, 0.3]}})
        assert status in (200, 201), said
        walled = [ahead_m(running, i) for i in range(SCANNERS)]
        for i in range(SCANNERS):
            assert before[i] - moved[i] > 0.5, f"s{i} did not move: {before[i]} m, {moved[i]} m"
            assert abs(walled[i] - 0.6) < 0.1, f"s{i} does not see the wall at 0.6 m: {walled[i]} m"


def reloads_in_peace(program, scene):
    with lab(program, scene, 4) as running:
        clients = [Client(running.address(f"s{i}")) for i in range(SCANNERS)]
        for client in clients:
            stream(client)
        file = running.folder / "lab.yaml"
        configuration = json.loads(file.read_text())
        for i in range(5):
            configuration["robots"]["robot"]["sensors"][f"more{i}"] = scanner(i)
            file.write_text(json.dumps(configuration))
            running.process.send_signal(signal.SIGHUP)
            wait_for(lambda: len(running.control.ask("GET", "/status")[1]["sensors"]) == SCANNERS + i + 1, "reload")
        for client in clients:
            assert len(all_messages(client)) == SCANS
        lost = [sensor["lost"] for sensor in running.control.ask("GET", "/status")[1]["sensors"]]
        assert sum(lost) == 0, lost


def moves_in_peace(program, scene):
    """Whoever connects to a scanner is answered, while reloads move those that nobody uses."""
    light = {f"s{i}": scanner(3) for i in range(1, 5)}
    both = {**light, "heavy": scanner(0)}  # all that are light live on the other thread then
    with Lab(program, scene, sensors=light, lockstep=False, options=["--threads", "2"]) as running:
        file = running.folder / "lab.yaml"
        configuration = json.loads(file.read_text())
        addresses = [running.address(name) for name in light]
        answered, faults, done = [0], [], threading.Event()

        def asks():
            try:
                while not done.is_set():
                    for address in addresses:
                        client = Client(address)
                        assert b"VEND" in client.ask("VV")
                        client.close()
                        answered[0] += 1
            except (AssertionError, OSError) as fault:
                faults.append(fault)

        asking = threading.Thread(target=asks)
        asking.start()
        for turn in range(40):
            configuration["robots"]["robot"]["sensors"] = light if turn % 2 else both
            file.write_text(json.dumps(configuration))
            running.process.send_signal(signal.SIGHUP)
            wait_for(lambda n=5 - turn % 2: len(running.control.ask("GET", "/status")[1]["sensors"]) == n, "reload")
        done.set()
        asking.join()
        assert not faults, faults
        assert answered[0] >= 20, answered


def refuses_what_is_no_number(program, scene):
    for wrong in ["0", "-1", "many", "5000"]:
        said = subprocess.run([program, "--threads", wrong], capture_output=True, text=True, timeout=PATIENCE_S)
        assert said.returncode == 2 and "--threads" in said.stderr, said


if __name__ == "__main__":
    program, scene = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    for check in [refuses_what_is_no_number, sends_the_same_bytes, tells_all_of_poses_and_edits, reloads_in_peace,
                  moves_in_peace]:
        begin = time.monotonic()
        check(program, scene)
        print(f"{check.__name__}: {time.monotonic() - begin:.1f} s")
