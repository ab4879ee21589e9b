# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# systemd's side of the sockets, for a scipd that it has not started: it hears what scipd notifies, sets a watchdog,
# and hands sockets over.
import fcntl
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import time

sys.path.append(str(pathlib.Path(__file__).parents[1] / "end_to_end"))
from fault_lab import Control  # noqa: E402

PATIENCE_S = 60
FIRST_HANDED = 3


class Manager:
    """Starts a scipd with this configuration in this folder, and ends it with the block that uses it."""

    def __init__(self, scipd, folder, configuration, *, watchdog_s=None, watched_pid="$$", sockets=(), listen_pid="$$",
                 environment=None):
        self.folder = pathlib.Path(folder)
        self.told = []
        self.notified = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.notified.bind(str(self.folder / "notify"))
        self.file = self.folder / "service.yaml"
        self.configure(configuration)
        environment = {"PATH": os.environ["PATH"], "RUNTIME_DIRECTORY": str(self.folder),
                       "NOTIFY_SOCKET": str(self.folder / "notify"), **(environment or {})}
        script = "exec "
        handed = []
        for number, (name, held) in enumerate(sockets):
            # Far from the numbers that the shell is to give them.
            handed.append(fcntl.fcntl(held.fileno(), fcntl.F_DUPFD, 100))
            script += f"{FIRST_HANDED + number}<&{handed[-1]} "
        if sockets:
            environment["LISTEN_FDS"] = str(len(sockets))
            environment.setdefault("LISTEN_FDNAMES", ":".join(name for name, _ in sockets))
            script += f"; export LISTEN_PID={listen_pid}"
        if watchdog_s:
            environment["WATCHDOG_USEC"] = str(int(watchdog_s * 1e6))
            script += f"; export WATCHDOG_PID={watched_pid}"
        script += '; exec "$@"'
        self.errors = open(self.folder / "stderr", "w+")
        self.process = subprocess.Popen(
            ["bash", "-c", script, "bash", scipd, "--config", str(self.file)], env=environment, pass_fds=handed,
            stdout=subprocess.PIPE, stderr=self.errors, text=True)
        for descriptor in handed:
            os.close(descriptor)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGCONT)
            self.process.terminate()
        self.process.wait(PATIENCE_S)
        self.process.stdout.close()
        self.errors.close()
        self.notified.close()

    def configure(self, configuration):
        """Any text, or a document."""
        text = configuration if isinstance(configuration, str) else json.dumps(configuration)
        fresh = self.file.with_suffix(".new")
        fresh.write_text(text)
        fresh.rename(self.file)

    def hear(self, key, patience_s=PATIENCE_S, **wanted):
        """The next message that has this key, as a dictionary. Others are passed over."""
        end = time.monotonic() + patience_s
        while True:
            self.notified.settimeout(max(0.01, end - time.monotonic()))
            try:
                message = dict(line.split("=", 1) for line in self.notified.recv(65536).decode().splitlines())
            except TimeoutError as error:
                raise AssertionError(f"no {key} {wanted} in {patience_s} s; {self.log()}") from error
            self.told.append(message)
            if key in message and all(message.get(name) == value for name, value in wanted.items()):
                return message

    def ready(self):
        """The ready line. Sets what systemd shows as the status."""
        line = self.process.stdout.readline()
        assert line, self.log()
        self.status = self.hear("READY", READY="1")["STATUS"]
        self.line = json.loads(line)
        self.control = Control(self.line["control"])
        return self.line

    def reload(self):
        """Returns the status afterwards."""
        before = time.monotonic_ns() // 1000
        self.process.send_signal(signal.SIGHUP)
        reloading = self.hear("RELOADING", RELOADING="1")
        assert before <= int(reloading["MONOTONIC_USEC"]) <= time.monotonic_ns() // 1000, reloading
        return self.hear("READY", READY="1")["STATUS"]

    def meals(self, seconds):
        """How often the watchdog is fed in this time."""
        count, end = 0, time.monotonic() + seconds
        while time.monotonic() < end:
            self.notified.settimeout(max(0.01, end - time.monotonic()))
            try:
                count += self.notified.recv(65536) == b"WATCHDOG=1"
            except TimeoutError:
                pass
        return count

    def drain(self):
        self.notified.setblocking(False)
        try:
            while True:
                self.notified.recv(65536)
        except BlockingIOError:
            pass

    def log(self):
        return (self.folder / "stderr").read_text()

    def wait_for_log(self, text):
        """It is written by a thread of its own."""
        end = time.monotonic() + PATIENCE_S
        while text not in self.log():
            assert time.monotonic() < end, self.log()
            time.sleep(0.05)

    def address(self, sensor):
        told = next(s for s in self.line["sensors"] if s["name"] == sensor)
        host, port = told["tcp"].rsplit(":", 1)
        return host, int(port)


def run_all(tests, *arguments):
    for test in tests:
        print(test.__name__.replace("_", " "), flush=True)
        test(*arguments)
