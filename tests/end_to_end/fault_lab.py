# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What tests of faults share: a scipd whose time is that of a drive, so that a run repeats to the byte, and a client
# that keeps all it gets.
import http.client
import json
import pathlib
import select
import shutil
import socket
import subprocess
import sys
import tempfile
import time

sys.path.append(str(pathlib.Path(__file__).parents[1] / "soak"))
from wire import decoded, sum_is_right  # noqa: E402

PATIENCE_S = 60


class Control(http.client.HTTPConnection):
    """The control API of a scipd."""

    def __init__(self, path):
        super().__init__("localhost", timeout=PATIENCE_S)
        self.path = str(path)

    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX)
        self.sock.settimeout(self.timeout)
        self.sock.connect(self.path)

    def ask(self, method, target, body=None):
        self.close()  # scipd may have ended a connection that was idle for long
        self.request(method, target, None if body is None else json.dumps(body))
        response = self.getresponse()
        text = response.read().decode()
        return response.status, json.loads(text) if text.strip() else None


class Lab:
    """A running scipd, ended with the block that uses it."""

    def __init__(self, scipd, scene, *, sensors, faults=(), seed=7, lockstep=True, drive_s=60, options=(),
                 **more):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="scipd-faults-"))
        (self.folder / "drive.tum").write_text("".join(
            f"{i / 10:.1f} {0.002 * i:.4f} 0 0 0 0 0 1\n" for i in range(10 * drive_s + 1)))
        configuration = {
            "scene": str(scene), "seed": seed, "clock": "poses" if lockstep else "wall",
            "control": str(self.folder / "control.sock"),
            "robots": {"robot": {"sensors": sensors}}, **more}
        if lockstep:
            configuration["robots"]["robot"]["poses"] = "drive.tum"
        (self.folder / "lab.yaml").write_text(json.dumps(configuration))
        self.errors = open(self.folder / "stderr", "w+")
        self.process = subprocess.Popen([scipd, "--config", str(self.folder / "lab.yaml"), *options],
                                        stdout=subprocess.PIPE, stderr=self.errors, text=True)
        line = self.process.stdout.readline()
        if not line:
            self.process.wait()
            raise SystemExit("scipd did not start:\n" + (self.folder / "stderr").read_text())
        self.ready = json.loads(line)
        self.control = Control(self.ready["control"])
        if faults:
            scenario = json.dumps({"seed": seed, "steps": list(faults)})
            status, answer = self.control.ask("PUT", "/scenario", {"name": "faults.yaml", "yaml": scenario})
            assert status == 200, answer

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(PATIENCE_S)
        self.process.stdout.close()
        self.errors.close()
        self.said = (self.folder / "stderr").read_text()  # its log, for who asks afterwards
        shutil.rmtree(self.folder)

    def errors_so_far(self):
        return (self.folder / "stderr").read_text()

    def address(self, sensor):
        told = next(s for s in self.ready["sensors"] if s["name"] == f"robot/{sensor}")
        host, port = told["tcp"].rsplit(":", 1)
        return host, int(port)

    def tty(self, sensor):
        return next(s for s in self.ready["sensors"] if s["name"] == f"robot/{sensor}")["pty"]

    def log(self, sensor):
        return self.control.ask("GET", f"/sensors/robot/{sensor}/faults/log")[1]["entries"]

    def faults(self, sensor):
        return self.control.ask("GET", f"/sensors/robot/{sensor}/faults")[1]


class Client:
    """Talks to a scanner by TCP, and keeps every byte that it gets."""

    def __init__(self, address):
        self.socket = socket.create_connection(address, timeout=PATIENCE_S)
        self.got = b""

    def close(self):
        self.socket.close()

    def say(self, line):
        self.socket.sendall(line.encode() + b"\n")

    def read(self, patience_s=None):
        """Some more bytes; none: the scanner has closed the connection."""
        patience_s = patience_s or self.socket.gettimeout()
        ready, _, _ = select.select([self.socket], [], [], patience_s)
        if not ready:
            raise TimeoutError(f"nothing came within {patience_s} s after {self.got[-200:]!r}")
        more = self.socket.recv(65536)
        self.got += more
        return more

    def read_until(self, end, begin=0):
        """All from `begin` until `end` is there."""
        while end not in self.got[begin:]:
            if not self.read():
                raise ConnectionError(f"closed after {self.got[-200:]!r}")
        return self.got[begin:]

    def ask(self, line, end=b"\n\n"):
        begin = len(self.got)
        self.say(line)
        return self.read_until(end, begin)

    def silent(self, seconds):
        """Whether nothing comes for so long."""
        return not select.select([self.socket], [], [], seconds)[0]


class Scan:
    """A message of a stream with three characters a value."""

    def __init__(self, message, values_per_step=1):
        lines = message.split(b"\n")
        self.echo, self.status, self.stamp_line, *data = lines
        self.sound = all(sum_is_right(line) for line in [self.status, self.stamp_line, *data] if line)
        self.stamp_ms = decoded(self.stamp_line[:4])
        block = b"".join(line[:-1] for line in data if line)
        values = [decoded(block[i:i + 3]) for i in range(0, len(block), 3)]
        self.ranges = values[::values_per_step]
        self.intensities = values[1::2] if values_per_step == 2 else []


def wait_for(condition, what, seconds=PATIENCE_S):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(what)
        time.sleep(0.02)
