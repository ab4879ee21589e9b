# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What tests of a shared world use: a broker of their own on a free port, or one that is none, and daemons whose
# scanners can be asked.
import contextlib
import json
import pathlib
import shutil
import socket
import subprocess
import tempfile
import threading
import time

from fault_lab import Client, Control, PATIENCE_S, Scan, wait_for

BOX = ("<model name='{name}'><pose>{pose} 0 0 0</pose><link name='l'><visual name='v'><geometry><box>"
       "<size>{size}</size></box></geometry></visual></link></model>")
CRATE = BOX.format(name="crate", pose="0 0 0", size="0.5 0.5 0.5")


def hall(extra=""):
    """A wall whose face is 10 m ahead of the origin, a cart of 0.5 m that waits beside it, and a pillar."""
    return ("<sdf version='1.9'><world name='hall'>" +
            BOX.format(name="wall", pose="10.5 0 0", size="1 40 4").replace("<pose>", "<static>1</static><pose>", 1) +
            BOX.format(name="cart", pose="8 5 0.3", size="0.5 0.5 0.5") +
            BOX.format(name="pillar", pose="0 -6 0", size="0.4 0.4 4") + extra + "</world></sdf>")


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class Broker:
    def __init__(self, folder):
        self.folder = folder
        self.port = free_port()
        self.url = f"mqtt://127.0.0.1:{self.port}"
        (folder / "broker.conf").write_text(
            f"listener {self.port} 127.0.0.1\nallow_anonymous true\npersistence false\nmax_queued_messages 0\n")
        self.process = None
        self.start()

    def start(self):
        self.process = subprocess.Popen(["mosquitto", "-c", str(self.folder / "broker.conf")],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_for(self.answers, "the broker does not start")

    def answers(self):
        try:
            socket.create_connection(("127.0.0.1", self.port), 1).close()
            return True
        except OSError:
            return False

    def kill(self):
        self.process.kill()
        self.process.wait()

    def say(self, topic, text, *more):
        subprocess.run(["mosquitto_pub", "-p", str(self.port), "-t", topic, "-s" if text else "-n", *more],
                       input=text.encode("latin-1"), check=True, timeout=PATIENCE_S)

    def kept(self, topics):
        """What it keeps under these topics."""
        told = subprocess.run(["mosquitto_sub", "-p", str(self.port), "-t", topics, "-W", "1", "--retained-only",
                               "-F", "%j"], capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        messages = [json.loads(line) for line in told.stdout.splitlines()]
        return {message["topic"]: message["payload"] for message in messages}


class FakeBroker:
    """Answers whoever connects with these bytes, so many times or always, and hangs up; then nobody listens."""

    def __init__(self, answer, times=None, hangs_up=True):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.url = f"mqtt://127.0.0.1:{self.listener.getsockname()[1]}"
        self.answer, self.times, self.hangs_up = answer, times, hangs_up
        self.clients = []
        self.thread = threading.Thread(target=self.serve)

    def serve(self):
        while self.times is None or len(self.clients) < self.times:
            try:
                client = self.listener.accept()[0]
            except OSError:
                return
            self.clients.append(client)
            client.sendall(self.answer)
            if self.hangs_up:
                client.recv(1)
                client.shutdown(socket.SHUT_WR)
        self.listener.close()

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        with contextlib.suppress(OSError):
            self.listener.shutdown(socket.SHUT_RDWR)
        self.listener.close()
        self.thread.join()
        for client in self.clients:
            client.close()


class Daemon:
    """A scipd whose robot has the name of the daemon, and one scanner at its origin that looks along x."""

    def __init__(self, scipd, folder, url, name, *, robot=None, world="hall", scene="hall.sdf", clock="wall",
                 accuracy="ideal", backend="auto", **fleet):
        self.folder = folder / f"{name}-{time.monotonic_ns()}"
        self.folder.mkdir()
        self.name = name
        sensors = {"scanner": {"model": "UST-10LX", "mount": {"xyz": [0, 0, 0.3]}, "accuracy": accuracy,
                               "backend": backend, "tcp": "127.0.0.1:0"}}
        configuration = {"scene": str(folder / scene), "clock": clock, "control": str(self.folder / "control.sock"),
                         "fleet": {"broker": url, "world": world, "name": name, **fleet},
                         "robots": {name: {"sensors": sensors, **(robot or {})}}}
        (self.folder / "scipd.yaml").write_text(json.dumps(configuration))
        self.errors = open(self.folder / "log", "w+")
        self.process = subprocess.Popen([scipd, "--config", str(self.folder / "scipd.yaml")], stdout=subprocess.PIPE,
                                        stderr=self.errors, text=True)
        line = self.process.stdout.readline()
        self.ready = json.loads(line) if line else None
        if self.ready:
            self.control = Control(self.ready["control"])
            host, port = self.ready["sensors"][0]["tcp"].rsplit(":", 1)
            self.scanner = Client((host, int(port)))
            if clock == "wall":
                self.scanner.ask("BM")

    def log(self):
        return (self.folder / "log").read_text()

    def ask(self, method, target, body=None):
        return self.control.ask(method, target, body)

    def ahead_m(self):
        """What the scanner sees straight ahead, now."""
        answer = self.scanner.ask("GD0540054000")
        return Scan(answer.strip(b"\n")).ranges[0] / 1000

    def sees(self, range_m):
        return abs(self.ahead_m() - range_m) < 0.0015

    def wait_to_see(self, range_m):
        wait_for(lambda: self.sees(range_m), f"{self.name} does not see {range_m} m ahead")

    def pose(self, what):
        status, answer = self.ask("GET", what + "/pose")
        assert status == 200, answer
        return answer["xyz"]

    def kill(self):
        self.process.kill()
        self.end()

    def end(self):
        if self.ready:
            self.scanner.close()
        if self.process.poll() is None:
            self.process.terminate()
        code = self.process.wait(PATIENCE_S)
        self.process.stdout.close()
        self.errors.close()
        return code


class FleetLab:
    def __init__(self, scipd):
        self.scipd = scipd
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="scipd-fleet-"))
        (self.folder / "hall.sdf").write_text(hall())
        self.broker = Broker(self.folder)
        self.daemons = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for daemon in self.daemons:
            daemon.kill()
        self.broker.kill()
        shutil.rmtree(self.folder)

    def start(self, name, *, url=None, **more):
        daemon = Daemon(self.scipd, self.folder, url or self.broker.url, name, **more)
        self.daemons.append(daemon)
        return daemon
