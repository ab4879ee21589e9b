# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What hostile and careless clients do. A deed is an endless generator: it yields the number of bytes of each thing that
# it did, or None when it only waits, and may be ended at any yield. scipd may do anything to a connection: after an
# OSError the deed begins anew. `scipd` is the one of scipd.py, and `rng` makes all random choices. Nothing here waits
# longer than PATIENCE_S.
import contextlib
import json
import os
import select
import socket
import struct
import time

import wire
from misfortunes import faults  # this one and the next are deeds as well
from variants import reload, stderr

PATIENCE_S = 2.0
REQUESTS = [b"VV", b"PP", b"II", b"BM", b"QT", b"RS", b"TM0", b"TM1", b"TM2", b"GD0000108001", b"MD0000108000000",
            b"ME0000108000000", b"GS0044072501", b"MD0044072501000", b"%ST", b"SS115200", b"CR00", b"HS1", b"SCIP2.0",
            b"RB", b"DB10"]
LONG_ANSWERS = ["/status", "/sensors", "/scene", "/sensors/good/ust/truth", "/sensors/driven/ust/truth"]
PATHS = LONG_ANSWERS + ["/sensors/%zz/x", "/robots/victim/pose", "/stream", "/poses", "/" + "x" * 2000,
                         "/scene/models/%00/pose"]
POSES = [b"x", b"{", b"{}", b"[" * 200, b'{"robot":"nobody","xyz":[0,0,0]}', b'{"robot":"victim","xyz":[0,0]}',
         b"\0\xff\xfe", b'{"robot":"victim","xyz":[1e999,0,0]}', b'{"robot":"victim","t":-1e300,"xyz":[0,0,0]}',
         b'{"robot":' + b'"' * 500]


@contextlib.contextmanager
def connected(where, receive_buffer=0, patience_s=PATIENCE_S):
    with socket.socket() as client:
        client.settimeout(patience_s)
        if receive_buffer:
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        client.connect(where)
        yield client


def reset(client):
    client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    client.close()


def junk(rng):
    request = rng.choice(REQUESTS)
    return rng.choice([
        lambda: rng.randbytes(rng.randrange(1, 4096)),
        lambda: request[:rng.randrange(len(request))],
        lambda: request + b"\n",
        lambda: request + b";" + rng.randbytes(20) + b"\n",
        lambda: b"\0" * rng.randrange(1, 100) + request + b"\r\n",
        lambda: b"A" * rng.randrange(1, 65536),
        lambda: bytes(rng.randrange(32, 127) for _ in range(rng.randrange(1, 30))) + b"\n",
    ])()


def victim(scipd, rng):
    return scipd.tcp(rng.choice(["victim/ust", "victim/utm"]))


def garbage(scipd, rng):
    """Random bytes and half lines to the scanners' ports, closed cleanly or with a reset."""
    while True:
        with connected(victim(scipd, rng)) as client:
            for _ in range(rng.randrange(1, 20)):
                data = junk(rng)
                client.sendall(data)
                yield len(data)
                time.sleep(rng.random() * 0.01)
            if rng.random() < 0.5:
                reset(client)


def ttys(scipd, rng):
    """The same to the scanners' ttys."""
    while True:
        descriptor = wire.open_tty(scipd.tty(rng.choice(["victim/urg", "victim/utm"])))
        try:
            for _ in range(rng.randrange(1, 20)):
                with contextlib.suppress(BlockingIOError):
                    yield os.write(descriptor, junk(rng))
                time.sleep(rng.random() * 0.01)
        finally:
            os.close(descriptor)


def flood(scipd, rng):
    """Requests as fast as scipd takes them, without reading the answers."""
    while True:
        with connected(victim(scipd, rng), receive_buffer=4096) as client:
            requests = b"\n".join(rng.choice(REQUESTS) for _ in range(2000)) + b"\n"
            client.setblocking(False)
            end = time.monotonic() + 0.5
            while time.monotonic() < end:
                with contextlib.suppress(BlockingIOError):
                    yield client.send(requests)
                time.sleep(0.002)


def deaf(scipd, rng):
    """Clients that ask for streams and never read, on TCP and on a tty."""
    while True:
        with connected(victim(scipd, rng), receive_buffer=4096) as client:
            client.sendall(b"MD0000108000000\n")
            descriptor = wire.open_tty(scipd.tty("victim/urg"))
            try:
                yield os.write(descriptor, b"MD0044072501000\n") + 16
                yield from rest(1.0)
            finally:
                os.close(descriptor)


def resets(scipd, rng):
    """Connections that are reset at once, also to the ports of good clients and of the control API."""
    places = [scipd.tcp(name) for name in ("victim/ust", "victim/utm", "good/ust", "driven/ust")] + [scipd.http]
    while True:
        data = rng.choice([b"", b"V", b"GET /stat"])
        # Connections that wait behind a good client fill its queue. Then nothing answers.
        with contextlib.suppress(TimeoutError), connected(rng.choice(places), patience_s=0.02) as client:
            client.sendall(data)
            reset(client)
        yield len(data)
        time.sleep(0.003)


def streams(scipd, rng):
    """25 clients of /stream that never read. They come at different times, so they leave different messages unread."""
    with contextlib.ExitStack() as clients:
        for _ in range(25):
            client = clients.enter_context(connected(scipd.http, receive_buffer=4096))
            request = wire.http_request(scipd.http, "GET", "/stream", fields=wire.UPGRADE)
            client.sendall(request)
            yield len(request)
            yield from rest(rng.choice([0.1, 2.0]))
        while True:
            yield from rest(1.0)


def answers(scipd, rng):
    """Many requests at once without reading the answers. Only one picture a second, because each takes long."""
    while True:
        with contextlib.ExitStack() as clients:
            for i in range(20):
                client = clients.enter_context(connected(scipd.http, receive_buffer=4096))
                paths = ["/sensors/victim/tof/reading"] if i == 0 else rng.choices(LONG_ANSWERS, k=20)
                requests = b"".join(wire.http_request(scipd.http, "GET", path) for path in paths)
                client.sendall(requests)
                yield len(requests)
            yield from rest(1.0)


def http(scipd, rng):
    """Requests that are not HTTP, or only nearly."""
    while True:
        with connected(scipd.http) as client:
            data = rng.choice([
                lambda: rng.randbytes(rng.randrange(1, 4096)),
                lambda: (f"{rng.choice(['GET', 'PATCH', 'BREW', 'PUT'])} {rng.choice(PATHS)} "
                         f"HTTP/{rng.choice(['1.1', '1.0', '9'])}\r\n\r\n").encode(),
                lambda: wire.http_request(scipd.http, "PUT", "/robots/victim/pose", rng.randbytes(200)),
                lambda: wire.http_request(scipd.http, "POST", "/scene/models", b"ffff\r\nxx",
                                          fields="Transfer-Encoding: chunked\r\n"),
                lambda: wire.http_request(scipd.http, "GET", "/poses", fields=wire.UPGRADE) + rng.randbytes(2000),
                lambda: wire.http_request(scipd.http, "GET", "/stream", fields=wire.UPGRADE)[:-rng.randrange(1, 100)],
            ])()
            client.sendall(data)
            if rng.random() < 0.5:
                client.settimeout(0.05)
                with contextlib.suppress(TimeoutError):
                    client.recv(65536)
            yield len(data)
            time.sleep(0.003)


def headers(scipd, rng):
    """Headers that come byte by byte and never end."""
    while True:
        with contextlib.ExitStack() as clients:
            slow = [clients.enter_context(connected(scipd.http)) for _ in range(20)]
            for byte in wire.http_request(scipd.http, "GET", "/status")[:-2]:
                for client in slow:
                    client.sendall(bytes([byte]))
                yield len(slow)
                time.sleep(0.01)
            with connected(scipd.http) as client, contextlib.suppress(OSError):
                for _ in range(100):
                    client.sendall(b"X-Filler: " + b"x" * 10000 + b"\r\n")
                    yield 10012


def bodies(scipd, rng):
    """Bodies that are too large, or do not come."""
    while True:
        path = rng.choice(["/scene", "/scene/models", "/robots/victim/pose"])
        length = rng.choice([1 << 20, 100 << 20, 1 << 63])
        with connected(scipd.http) as client, contextlib.suppress(OSError):
            head = wire.http_request(scipd.http, "PUT", path, fields=f"Content-Length: {length}\r\n" + wire.JSON)
            client.sendall(head)
            for _ in range(rng.randrange(32)):
                client.sendall(bytes(65536))
                yield 65536
        yield from rest(0.02)


def deep(scipd, rng):
    """JSON that is nested as deep as the size of a body allows."""
    while True:
        depth = rng.choice([1000, 100_000, 250_000])
        text = rng.choice([b"[" * depth + b"]" * depth, b"[" * 2 * depth, b'{"xyz":' + b"[" * 2 * depth,
                           b'{"a":' * (depth // 3)])
        method, path = rng.choice([("PUT", "/scene"), ("POST", "/scene/models"), ("PUT", "/robots/victim/pose")])
        with connected(scipd.http) as client:
            client.sendall(wire.http_request(scipd.http, method, path, text))
            yield len(text)
            client.recv(65536)
        time.sleep(0.02)


def junk_poses(scipd, rng):
    """Messages with a megabyte of lines that are no poses, to the WebSocket /poses. Some clients read the answers."""
    while True:
        with connected(scipd.http) as client:
            client.sendall(wire.http_request(scipd.http, "GET", "/poses", fields=wire.UPGRADE))
            client.recv(65536)
            line = rng.choice(POSES + [b"x"] * 10) + b"\n"
            message = line * (1_000_000 // len(line))
            client.sendall(wire.text_frame(message))
            yield len(message)
            end = time.monotonic() + rng.choice([0.0, 1.0])
            while time.monotonic() < end and select.select([client], [], [], 0.1)[0] and client.recv(1 << 20):
                yield None


def udp(scipd, rng):
    """Datagrams that are no poses, in bursts of 500."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
        client.connect(("127.0.0.1", scipd.udp["victim"]))
        client.setblocking(False)
        while True:
            data = rng.choice(POSES + [b"x\n" * 5000, rng.randbytes(1000)])
            for _ in range(500 if len(data) < 5000 else 20):
                with contextlib.suppress(BlockingIOError, ConnectionRefusedError):
                    client.send(data)
            yield 500 * len(data) if len(data) < 5000 else 20 * len(data)
            time.sleep(0.02)


def abandon(scipd, rng):
    """Requests to load worlds, from clients that leave at once."""
    while True:
        with connected(scipd.http) as client:
            request = wire.http_request(scipd.http, "PUT", "/scene", {"file": f"{scipd.scenes}/rescue_maze.sdf"})
            client.sendall(request)
            if rng.random() < 0.5:
                reset(client)
        yield len(request)
        time.sleep(0.01)


def scenes(scipd, rng):
    """Loads worlds, and adds, moves and removes models, and waits for each answer."""
    sdf = ("<model name='m'><link name='l'><visual name='v'><geometry><sphere><radius>0.1</radius></sphere></geometry>"
           "</visual></link></model>")
    with connected(scipd.http) as client:
        while True:
            world = rng.choice(["square_room", "corridor", "rescue_maze"])
            requests = [("PUT", "/scene", {"file": f"{scipd.scenes}/{world}.sdf"})]
            for i in range(rng.randrange(10)):
                requests.append(("POST", "/scene/models", {"name": f"m{i}", "sdf": sdf, "replace": rng.random() < 0.5}))
                requests += [("PUT", f"/scene/models/m{i}/pose", {"xyz": [rng.random(), rng.random(), 0.3]})
                             for _ in range(5)]
                requests.append(("DELETE", f"/scene/models/m{rng.randrange(10)}", None))
            for method, path, body in requests:
                request = wire.http_request(scipd.http, method, path, body)
                client.sendall(request)
                yield len(request)
                if not client.recv(65536):
                    raise ConnectionResetError


def rest(seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        time.sleep(0.05)
        yield None


DEEDS = {deed.__name__: deed for deed in (
    garbage, ttys, flood, deaf, resets, streams, answers, http, headers, bodies, deep, junk_poses, udp, abandon, scenes,
    reload, stderr, faults)}
