# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# scipctl top beside a stand-in for scipd that says what is written here, on a pipe and on a terminal.
# top_test.py SCIPCTL
import fcntl
import http.server
import json
import os
import pathlib
import pty
import select
import signal
import socketserver
import struct
import subprocess
import sys
import tempfile
import termios
import threading
import time

PATIENCE_S = 30


def sensor(name, scans, casts, **more):
    return {"name": name, "model": "UST-10LX", "state": "streaming", "clients": 1, "scans": scans, "lost": 3,
            "casts": casts, "lateness_ms": {"p50": 0.1, "p99": 0.25, "max": 9}, **more}


# Two seconds lie between the first two answers. All after them are like the second.
FIRST = {"uptime_s": 10, "scene": "maze.sdf", "sensors": [
    sensor("robot/front", 100, {"embree": 1000}), sensor("robot/changed", 500, {"embree": 500}),
    sensor("robot/gone", 1, {})]}
SECOND = {"uptime_s": 12, "scene": "maze.sdf", "sensors": [
    sensor("robot/front", 180, {"embree": 1080, "depth": 3}),
    sensor("robot/changed", 4, {"embree": 4}, state="standby", clients=0, lost=0),
    sensor("robot/new", 7, {"depth": 7}, lateness_ms={"p50": None, "p99": None, "max": None})]}


class Scipd(socketserver.ThreadingMixIn, socketserver.UnixStreamServer):
    daemon_threads = True

    def __init__(self, folder):
        self.path = str(pathlib.Path(folder) / "control.sock")
        self.asked = 0
        super().__init__(self.path, Handler)
        threading.Thread(target=self.serve_forever, daemon=True).start()


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def do_GET(self):
        assert self.path == "/status", self.path
        self.server.asked += 1
        body = json.dumps(FIRST if self.server.asked == 1 else SECOND).encode()
        self.send_response(200)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


def check_table(command):
    done = subprocess.run([*command, "--once"], capture_output=True, text=True, timeout=PATIENCE_S,
                          stdin=subprocess.DEVNULL)
    assert done.returncode == 0, done.stderr
    lines = [line.split("  ") for line in done.stdout.splitlines()]
    rows = [[cell.strip() for cell in line if cell.strip()] for line in lines if len(line) > 1]
    assert rows == [
        ["SENSOR", "MODEL", "STATE", "SCANS/S", "LOST", "LATE p99 ms", "CLIENTS", "CASTS/S"],
        ["robot/front", "UST-10LX", "streaming", "40.0", "3", "0.25", "1", "depth 1.5, embree 40.0"],
        ["robot/changed", "UST-10LX", "standby", "-", "0", "0.25", "0", "-"],
        ["robot/new", "UST-10LX", "streaming", "-", "3", "-", "1", "-"]], done.stdout
    assert "maze.sdf" in lines[0][0] and "12 s" in lines[0][0], done.stdout
    assert "\x1b" not in done.stdout


def check_json(command):
    with subprocess.Popen([*command, "--json"], stdout=subprocess.PIPE, text=True, stdin=subprocess.DEVNULL) as top:
        first, second = (json.loads(top.stdout.readline()) for _ in range(2))
        top.send_signal(signal.SIGTERM)
        assert top.wait(PATIENCE_S) == 0, "a signal ends it as asked"
    assert first["uptime_s"] == 12
    assert first["sensors"][0] == {
        "name": "robot/front", "model": "UST-10LX", "state": "streaming", "scans_per_s": 40, "lost": 3,
        "lateness_p99_ms": 0.25, "clients": 1, "casts_per_s": {"depth": 1.5, "embree": 40}}
    assert [s["scans_per_s"] for s in first["sensors"]] == [40, None, None]
    assert first["sensors"][2]["lateness_p99_ms"] is None
    assert second["sensors"][0]["scans_per_s"] is None, "no time has passed"


def check_terminal(command, end):
    """It draws twice, each time in the same place, ends with `end`, and leaves the terminal as it was."""
    child, terminal = pty.fork()
    if child == 0:
        os.execvp(command[0], command)
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 6, 50, 0, 0))
    before = termios.tcgetattr(terminal)
    text = b""
    limit = time.monotonic() + PATIENCE_S
    while text.count(b"\x1b[H") < 2 or not text.endswith(b"\x1b[J"):
        assert time.monotonic() < limit and select.select([terminal], [], [], PATIENCE_S)[0], text
        text += os.read(terminal, 4096)
    assert not termios.tcgetattr(terminal)[3] & termios.ECHO
    for drawn in text.split(b"\x1b[H")[1:]:
        lines = drawn.replace(b"\x1b[K", b"").replace(b"\x1b[J", b"").split(b"\r\n")
        assert len(lines) <= 6 and all(len(line) <= 50 for line in lines), lines
        assert lines[2].startswith(b"SENSOR") and lines[3].startswith(b"robot/front"), lines
    os.write(terminal, end)
    while not os.waitpid(child, os.WNOHANG)[0]:
        assert time.monotonic() < limit, "it does not end"
        if select.select([terminal], [], [], 0.05)[0]:
            try:
                os.read(terminal, 4096)
            except OSError:  # it has closed the terminal
                pass
    assert termios.tcgetattr(terminal) == before
    os.close(terminal)


def check_nobody_there(scipctl):
    done = subprocess.run([scipctl, "--control", "/no/such/socket", "top"], capture_output=True, text=True,
                          timeout=PATIENCE_S, stdin=subprocess.DEVNULL)
    assert done.returncode == 1 and "cannot reach scipd" in done.stderr, done


def main():
    scipctl, = sys.argv[1:]
    for check in [check_table, check_json, lambda command: check_terminal(command, b"q"),
                  lambda command: check_terminal(command, b"\x03")]:
        with tempfile.TemporaryDirectory() as folder, Scipd(folder) as scipd:
            try:
                check([scipctl, "--control", scipd.path, "top"])
            finally:
                scipd.shutdown()
    check_nobody_there(scipctl)
    print("top shows what happens")


main()
