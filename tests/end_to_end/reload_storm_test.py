# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Reload after reload, each with another configuration: robots and sensors get other names, come and go, another
# trajectory, world or scenario holds. Meanwhile faults act, clients ask on over lines with latency, and pages look on.
# scipd lives, and the scanner that every configuration has keeps its client.
# reload_storm_test.py SCIPD SCENE [ROUNDS [SEED]]: so many reloads with each number of threads
import contextlib
import json
import os
import pathlib
import random
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

from fault_lab import PATIENCE_S, Client, Control, wait_for
from fault_storm_test import MEMBERS

ROUNDS = 8
THREADS = [1, 3]
NAMES = ["front", "rear", "left", "right"]
LINES = [{"latency_ms": 20}, {"latency_ms": 5, "jitter_ms": 5}, {}]
WORLDS = {
    "wall": "<pose>4.5 0 0.5 0 0 0</pose><geometry><box><size>1 9 9</size></box></geometry>",
    "pillar": "<pose>2 1 0.5 0 0 0</pose><geometry><sphere><radius>.5</radius></sphere></geometry>",
}


def free_ports(count):
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class Storm:
    """A scipd, and what its configurations are drawn from."""

    def __init__(self, scipd, scene, threads, seed):
        self.random = random.Random(seed)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="scipd-storm-"))
        self.worlds = [pathlib.Path(scene).resolve()]
        for name, visual in WORLDS.items():
            self.worlds.append(self.folder / f"{name}.sdf")
            self.worlds[-1].write_text(
                f'<sdf version="1.9"><world name="{name}"><model name="m"><static>true</static>'
                f'<link name="l"><visual name="v">{visual}</visual></link></model></world></sdf>')
        for drive in range(3):
            (self.folder / f"drive{drive}.tum").write_text("".join(
                f"{i / 10:.1f} {0.001 * i * drive:.4f} 0 0 0 0 0 1\n" for i in range(20000)))
        self.ports = free_ports(5)
        self.file = self.folder / "storm.yaml"
        self.write()
        self.errors = open(self.folder / "stderr", "w")
        self.process = subprocess.Popen([scipd, "--config", str(self.file), "--threads", str(threads)],
                                        stdout=subprocess.PIPE, stderr=self.errors,
                                        env={**os.environ, "XDG_RUNTIME_DIR": str(self.folder)})
        assert self.process.stdout.readline(), self.said()
        self.over = False

    def said(self):
        return (self.folder / "stderr").read_text()

    def lives(self):
        return self.process.poll() is None

    def sensor(self, port, tty):
        return {"model": self.random.choice(["UST-10LX", "UTM-30LX"]), "tcp": f"127.0.0.1:{port}", "timing": "ideal",
                "link": self.random.choice(LINES), "mount": {"xyz": [0, 0, 0.3]},
                "backend": self.random.choice(["embree", "auto"]), **({"pty": tty} if tty else {})}

    def robot(self, ports):
        robot = {"sensors": {name: self.sensor(port, f"tty{port}" if self.random.random() < 0.5 else None)
                             for name, port in zip(self.random.sample(NAMES, len(ports)), ports)}}
        if self.random.random() < 0.7:
            robot["poses"] = f"drive{self.random.randrange(3)}.tum"
        return robot

    def write(self):
        """The next configuration, and the names of its sensors but for the one that stays."""
        ports = self.random.sample(self.ports[1:], self.random.randrange(len(self.ports)))
        cut = self.random.randrange(len(ports) + 1)
        names = self.random.sample("abcd", 2)
        robots = {name: self.robot(some) for name, some in zip(names, (ports[:cut], ports[cut:])) if some}
        stays = {"model": "UST-10LX", "tcp": f"127.0.0.1:{self.ports[0]}", "mount": {"xyz": [0, 0, 0.3]}}
        configuration = {"scene": str(self.random.choice(self.worlds)), "control": str(self.folder / "control.sock"),
                         "robots": {"stays": {"sensors": {"here": stays}}, **robots}}
        if self.random.random() < 0.5:
            steps = [{"sensor": "*", "kind": "motor", "percent": 5, "every": {"s": 0.2}, "for": {"s": 0.1}}]
            (self.folder / "bad_day.yaml").write_text(json.dumps({"seed": self.random.randrange(9), "steps": steps}))
            configuration["scenario"] = "bad_day.yaml"
        fresh = self.folder / "fresh.yaml"
        fresh.write_text(json.dumps(configuration))
        fresh.replace(self.file)
        return {f"{robot}/{sensor}" for robot, has in configuration["robots"].items() for sensor in has["sensors"]}

    def ask(self, *request):
        with contextlib.closing(Control(self.folder / "control.sock")) as control:
            return control.ask(*request)

    def faults(self, sensors):
        """One at each sensor that may leave, until it does."""
        for sensor in sensors - {"stays/here"}:
            kind = self.random.choice(sorted(MEMBERS))
            fault = {"kind": kind, **MEMBERS[kind](self.random), "for": {"s": 1000}}
            if fault.get("percent", 1) == 0:
                continue
            status, answer = self.ask("POST", f"/sensors/{sensor}/faults", fault)
            assert status == 201, (fault, answer)

    def hurry(self, open_one):
        """A client that asks on and on, whatever comes, and comes back when it is cut off."""
        while not self.over:
            try:
                with open_one() as wire:
                    self.ask_on(wire)
            except OSError:
                time.sleep(0.02)

    def ask_on(self, wire):
        last = time.monotonic()
        for request in ["BM\n", "MD0000108000000\n"] + 500 * ["GD0000108000\n"]:
            if self.over or time.monotonic() - last > 1:
                return
            ready = select.select([wire], [wire], [], 0.02)
            if ready[1]:
                wire.write(request.encode())
            if ready[0]:
                last = time.monotonic()
                if not wire.read(1 << 16):
                    return

    def page(self, path, hello=None):
        """Looks on by a WebSocket, and drops what it sees."""
        while not self.over:
            with contextlib.suppress(OSError), socket.socket(socket.AF_UNIX) as page:
                page.settimeout(1)
                page.connect(str(self.folder / "control.sock"))
                head = ["Host: scipd", "Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
                        "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA=="]
                page.sendall("\r\n".join([f"GET {path} HTTP/1.1", *head, "", ""]).encode())
                end = time.monotonic() + 2
                while page.recv(1 << 16) and time.monotonic() < end and not self.over:
                    pass

    def reload(self):
        sensors = self.write()
        done = self.said().count("is running now")
        self.process.send_signal(signal.SIGHUP)
        wait_for(lambda: not self.lives() or self.said().count("is running now") > done, "it does not reload")
        assert self.lives(), f"scipd has ended with {self.process.returncode}:\n{self.said()[-2000:]}"
        told = {sensor["name"] for sensor in self.ask("GET", "/sensors")[1]}
        assert told == sensors, (told, sensors)
        return sensors


class Tcp:
    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=1)
        self.socket.setblocking(False)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def fileno(self):
        return self.socket.fileno()

    def write(self, text):
        with contextlib.suppress(BlockingIOError):
            self.socket.send(text)

    def read(self, most):
        return self.socket.recv(most)


class Tty:
    def __init__(self, path):
        self.descriptor = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.descriptor)

    def fileno(self):
        return self.descriptor

    def write(self, text):
        with contextlib.suppress(BlockingIOError):
            os.write(self.descriptor, text)

    def read(self, most):
        return os.read(self.descriptor, most)


def rage(storm, rounds):
    good = Client(("127.0.0.1", storm.ports[0]))
    good.ask("BM")
    good.ask("MD0000108000000")
    threads = [threading.Thread(target=storm.hurry, args=(lambda p=p: Tcp(p),)) for p in storm.ports[1:]]
    threads += [threading.Thread(target=storm.hurry, args=(lambda p=p: Tty(storm.folder / f"tty{p}"),))
                for p in storm.ports[1:]]
    pages = ("/stream", "/view", "/wire?sensor=a/front")
    threads += [threading.Thread(target=storm.page, args=(path,)) for path in pages]
    for thread in threads:
        thread.start()
    try:
        for _ in range(rounds):
            storm.faults(storm.reload())
            time.sleep(storm.random.random() / 3)
            good.got = b""
            good.read_until(b"\n99b\n")
    except BaseException:
        storm.process.kill()
        raise
    finally:
        storm.over = True
        for thread in threads:
            thread.join(PATIENCE_S)
    storm.process.send_signal(signal.SIGTERM)
    code = storm.process.wait(PATIENCE_S)
    assert code == 0, f"scipd ended with {code}:\n{storm.said()[-2000:]}"
    assert "error" not in storm.said(), storm.said()
    shutil.rmtree(storm.folder)


def main(scipd, scene, rounds=ROUNDS, seed=1):
    for count in THREADS:
        rage(Storm(scipd, scene, count, int(seed)), int(rounds))
        print(f"{rounds} reloads with {count} threads, and scipd lives", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
