# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Clients of the control API that do not read, or have said all they have to say: careless_clients_test.py SCIPD SCENE
import base64
import json
import os
import pathlib
import signal
import socket
import struct
import sys
import threading
import time

from fault_lab import Client, Control, Lab, wait_for

SENSORS = {"front": {"model": "UST-10LX", "tcp": "127.0.0.1:0"},
           "eye": {"camera": {"columns": 8, "rows": 6, "fov_deg": [60, 45], "rate_hz": 10, "range_m": [0.1, 5]}}}
PAGES = 40
UPGRADE = ("Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n")
BOX = ("<model name='m'><link name='l'><collision name='c'><geometry><box><size>0.1 0.1 0.1</size></box></geometry>"
       "</collision></link></model>")
# A hundred thousand triangles, far away: a change that takes a while.
MESH = base64.b64encode(bytes(80) + struct.pack("<I", 100_000) + b"".join(
    struct.pack("<12fH", 0, 0, 1, 50, i, 0, 51, i, 0, 50, i + 1, 0, 0) for i in range(100_000))).decode()
FAULTS = "/sensors/robot/front/faults"
# A sanitizer keeps what is freed. The presets of their tests set one of these.
SANITIZED = "ASAN_OPTIONS" in os.environ or "TSAN_OPTIONS" in os.environ


def resident_mb(process):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(next(line for line in status.splitlines() if line.startswith("VmRSS")).split()[1]) / 1024


def connect(lab, path=None):
    """To the Unix socket, where the kernel keeps little of what is not read, and upgrades to a WebSocket there."""
    client = socket.socket(socket.AF_UNIX)
    client.settimeout(60)
    client.connect(lab.ready["control"])
    if path:
        client.sendall(f"GET {path} HTTP/1.1\r\nHost: x\r\n{UPGRADE}\r\n".encode())
        head = b""
        while b"\r\n\r\n" not in head:
            head += client.recv(1)
        assert b" 101 " in head, head
    return client


def exactly(client, size):
    data = b""
    while len(data) < size:
        more = client.recv(size - len(data))
        assert more, "it was cut"
        data += more
    return data


def message(client):
    length = exactly(client, 2)[1] & 127
    if length > 125:
        length = int.from_bytes(exactly(client, 2 if length == 126 else 8), "big")
    return exactly(client, length)


def drain(client):
    try:
        while client.recv(65536):
            pass
    except OSError:
        pass


def told_of_faults(page, told):
    """Until the daemon ends."""
    try:
        while True:
            text = message(page)
            for event in json.loads(text).get("faults", ()):
                told.append((event, len(text)))
    except (OSError, AssertionError):
        pass


def check_deaf_pages(lab):
    """While twenty faults hit half of all bytes."""
    deaf = [connect(lab, "/view") for _ in range(PAGES)]
    told = []
    threading.Thread(target=told_of_faults, args=(connect(lab, "/view"), told), daemon=True).start()
    driver = Client(lab.address("front"))
    driver.ask("BM")
    driver.say("MD0000108000000")
    threading.Thread(target=drain, args=(driver.socket,), daemon=True).start()
    before_mb = resident_mb(lab.process)
    for _ in range(20):
        status, _ = lab.control.ask("POST", FAULTS, {"kind": "corrupt", "bytes": {"rate": 0.5}, "for": {"s": 600}})
        assert status == 201
    cut = []
    end = time.monotonic() + 60
    while len(cut) < PAGES and time.monotonic() < end:
        Control(lab.control.path).ask("GET", "/health")
        cut += [page for page in deaf if page not in cut and is_cut(page)]
        assert SANITIZED or resident_mb(lab.process) < before_mb + 100, f"{before_mb} MB before"
        time.sleep(0.2)
    assert len(cut) == PAGES, f"only {len(cut)} of the pages that read nothing are cut"
    acts = [(event, size) for event, size in told if event["bytes_n"] > 0]
    assert max(event["bytes_n"] for event, _ in acts) > 1000, "half of the bytes of a scan"
    assert max(size for _, size in told) < 40_000, "no list of these bytes"
    log = lab.log("front")
    event = acts[-1][0]
    entry = next((one for one in log if one["n"] == event["n"]), None)
    assert entry is None or len(entry["bytes"]) == event["bytes_n"], "the log has the list"


def is_cut(page):
    """Nothing is read to find out: what has come is not the end."""
    page.settimeout(0)
    try:
        page.send(b"\x8a\x80\0\0\0\0")  # a pong that nobody asked for
        return False
    except BlockingIOError:
        return False
    except OSError:
        return True


def request(lab, method, path, body, connection="keep-alive"):
    text = json.dumps(body) if body else ""
    return (f"{method} {path} HTTP/1.1\r\nHost: {lab.ready['http']}\r\nConnection: {connection}\r\n"
            f"Content-Type: application/json\r\nContent-Length: {len(text)}\r\n\r\n{text}").encode()


def check_half_closed(lab):
    """As `nc -N` does: each kind of late answer, with changes that wait for others in front."""
    first = connect(lab)
    for i in range(3):
        mesh = {"name": f"mesh{i}", "mesh_format": "stl", "mesh_data": MESH}
        first.sendall(request(lab, "POST", "/scene/models", mesh))
    asks = [("POST", "/scene/models", {"sdf": BOX})] * 6
    asks += [("GET", path, None) for path in ("/sensors/robot/front/truth", "/sensors/robot/eye/reading",
                                              "/scene/objects", "/status")]
    clients = []
    for method, path, body in asks:
        for client in (connect(lab), socket.create_connection(lab.ready["http"].rsplit(":", 1), 60)):
            if body:
                body = body | {"name": f"box{len(clients)}"}
            client.sendall(request(lab, method, path, body, "close"))
            client.shutdown(socket.SHUT_WR)
            clients.append((client, method, path))
    for client, method, path in clients:
        data = b""
        while more := client.recv(65536):
            data += more
        # Where that takes long, scipd asks whether anybody is still there.
        data = data.removeprefix(b"HTTP/1.1 102 Processing\r\n\r\n")
        assert data.startswith(b"HTTP/1.1 2"), (method, path, data[:300])


def main():
    scipd, scene = sys.argv[1:]
    with Lab(scipd, scene, sensors=SENSORS, lockstep=False, http="127.0.0.1:0") as lab:
        check_deaf_pages(lab)
        check_half_closed(lab)
        lab.process.send_signal(signal.SIGTERM)
        assert lab.process.wait(30) == 0  # in 5 s, where the machine has nothing else to do


main()
