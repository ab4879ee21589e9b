# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What a real browser does with a page that attacks scipd: browser_test.py SCIPD SCENE
#
# Chromium opens a page of somebody else. The page tries to read from and write to the control API on TCP in every way
# that the web has: once from another origin, once under a name that the attacker makes mean scipd's address (DNS
# rebinding). The same page first attacks a server that trusts everybody. What succeeds there must fail with scipd.
import base64
import contextlib
import hashlib
import http.server
import json
import os
import pathlib
import queue
import shutil
import signal
import socket
import socketserver
import subprocess
import sys
import tempfile
import threading

SKIPPED = 77
PATIENCE_S = 60
POSE = "/robots/robot/pose"
EVIL = "evil.example"
PAGE = pathlib.Path(__file__).with_name("attack.html").read_bytes()


def successes(told):
    """An opaque answer is read as nothing, and a problem document tells nothing but that scipd refuses."""
    def refused(text):
        return not text or json.loads(text).get("status") in (403, 415)
    return {way for way, result in told.items() if result == "opened" or
            result.startswith("read: ") and not refused(result[len("read: "):])}


class Attacker(http.server.BaseHTTPRequestHandler):
    """Serves the page, and takes its report."""

    def do_GET(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.send_header("Content-Length", str(len(PAGE)))
        self.end_headers()
        self.wfile.write(PAGE)

    def do_POST(self):
        self.server.reports.put(self.rfile.read(int(self.headers["Content-Length"])))
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_):
        pass


class Trusting(http.server.BaseHTTPRequestHandler):
    """Answers whoever asks, and does what it is told."""
    protocol_version = "HTTP/1.1"

    def answer(self):
        self.server.asked.put((self.command, self.path))
        if key := self.headers["Sec-WebSocket-Key"]:
            self.send_response(101)
            accepted = hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()
            for name, value in (("Upgrade", "websocket"), ("Connection", "Upgrade"),
                                ("Sec-WebSocket-Accept", base64.b64encode(accepted).decode())):
                self.send_header(name, value)
            self.end_headers()
            self.close_connection = True
            return
        self.rfile.read(int(self.headers["Content-Length"] or 0))
        self.send_response(200)
        self.send_header("Content-Length", "2")
        self.end_headers()
        self.wfile.write(b"{}")

    do_GET = do_POST = do_PUT = do_DELETE = do_OPTIONS = answer

    def log_message(self, *_):
        pass


class Rebound(socketserver.BaseRequestHandler):
    """What the browser meets under the attacker's name: first the page, then, byte for byte, the target."""

    def handle(self):
        head = b""
        while b"\r\n\r\n" not in head:
            more = self.request.recv(65536)
            if not more:
                return
            head += more
        if head.startswith(b"GET /page "):
            self.request.sendall(b"HTTP/1.1 200 OK\r\nContent-Type: text/html\r\nConnection: close\r\n"
                                 b"Content-Length: %d\r\n\r\n" % len(PAGE) + PAGE)
            return
        with socket.create_connection(self.server.target) as target:
            back = threading.Thread(target=pump, args=(target, self.request), daemon=True)
            back.start()
            target.sendall(head)
            pump(self.request, target)
            back.join()


def pump(source, sink):
    with contextlib.suppress(OSError):
        while data := source.recv(65536):
            sink.sendall(data)
    with contextlib.suppress(OSError):
        sink.shutdown(socket.SHUT_WR)


class Threads(socketserver.ThreadingTCPServer):
    daemon_threads = True
    allow_reuse_address = True


@contextlib.contextmanager
def serving(address, handler, **attributes):
    with Threads(address, handler) as server:
        for name, value in attributes.items():
            setattr(server, name, value)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server
        server.shutdown()


@contextlib.contextmanager
def chromium(program, url):
    """EVIL means an address of this machine that is not the target's."""
    with tempfile.TemporaryDirectory() as profile:
        process = subprocess.Popen(
            [program, "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-dev-shm-usage",
             "--disable-background-networking", f"--user-data-dir={profile}",
             f"--host-resolver-rules=MAP {EVIL} 127.0.0.2", url],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            yield
        finally:
            # All its processes at once: the last ones would write into the profile while it is removed.
            os.killpg(process.pid, signal.SIGKILL)
            process.wait(timeout=PATIENCE_S)


def attack(browser, target):
    """What the page told, from another origin and after a rebinding."""
    reports = queue.Queue()
    address, port = target
    with serving(("127.0.0.1", 0), Attacker, reports=reports) as attacker, \
            serving(("127.0.0.2", port), Rebound, target=target):
        report = f"http://127.0.0.1:{attacker.server_address[1]}/report"
        from_elsewhere = f"{report}#http://{address}:{port},{report}"
        rebound = f"http://{EVIL}:{port}/page#http://{EVIL}:{port},{report}"
        for url in (from_elsewhere, rebound):
            with chromium(browser, url):
                yield json.loads(reports.get(timeout=PATIENCE_S))


def check_that_the_attacks_are_real(browser):
    asked = queue.Queue()
    with serving(("127.0.0.1", 0), Trusting, asked=asked) as server:
        from_elsewhere, rebound = attack(browser, ("127.0.0.1", server.server_address[1]))
    arrived = []
    while not asked.empty():
        arrived.append(asked.get())
    assert successes(from_elsewhere) == {"poses", "stream"}, from_elsewhere
    assert successes(rebound) == {"get", "put", "post", "remove", "plain", "poses", "stream", "frame", "form"}, rebound
    # Unasked, from another origin: a form, a beacon and an opaque request; when rebound, that of fetch, too.
    assert arrived.count(("POST", "/scene/models")) == 3 + 4, arrived
    assert arrived.count(("PUT", POSE)) == 1 and arrived.count(("DELETE", "/scene/models/box")) == 1, arrived


def over_the_socket(control, path):
    with contextlib.closing(socket.socket(socket.AF_UNIX)) as client:
        client.connect(control)
        client.sendall(f"GET {path} HTTP/1.1\r\nHost: scipd\r\nConnection: close\r\n\r\n".encode())
        data = b"".join(iter(lambda: client.recv(65536), b""))
    return json.loads(data.partition(b"\r\n\r\n")[2])


def state(control):
    """All that the page has tried to change."""
    accepted = over_the_socket(control, "/status")["poses"]
    return over_the_socket(control, "/scene"), over_the_socket(control, POSE)["xyz"], accepted


def check_that_scipd_refuses_them(browser, program, scene):
    with tempfile.TemporaryDirectory() as folder:
        scipd = subprocess.Popen([program, "--scene", scene, "--pty", "none", "--tcp", "127.0.0.1:0",
                                  "--http", "127.0.0.1:0"],
                                 env={"XDG_RUNTIME_DIR": folder, "PATH": "/usr/bin:/bin"}, stdout=subprocess.PIPE)
        try:
            ready = json.loads(scipd.stdout.readline())
            before = state(ready["control"])
            address, _, port = ready["http"].rpartition(":")
            for told in attack(browser, (address, int(port))):
                assert not successes(told), told
            after = state(ready["control"])
            assert after == before, (before, after)
        finally:
            scipd.terminate()
            assert scipd.wait(timeout=PATIENCE_S) == 0


def main():
    program, scene = (str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:])
    browser = shutil.which("chromium-headless-shell") or shutil.which("chromium")
    if not browser:
        print("skipped: there is no chromium-headless-shell; `tools/install test` installs it")
        return SKIPPED
    check_that_the_attacks_are_real(browser)
    check_that_scipd_refuses_them(browser, program, scene)
    return 0


if __name__ == "__main__":
    sys.exit(main())
