# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# The good clients, which must miss nothing whatever the hostile ones do. They share one loop in one thread. The soak
# also measures how late that loop is and how long scipd waits for a core, so that it does not blame scipd for a busy
# machine.
import asyncio
import collections
import dataclasses
import json
import math
import os
import time

import wire

CLOCK_MASK = 0xFFFFFF  # 24 bits
MODEL = ("<model name='m'><static>true</static><link name='l'><visual name='v'><geometry><box>"
         "<size>0.1 0.1 0.1</size></box></geometry></visual></link></model>")
CROOKED_MS = 2.0  # a stamp that is this far off its period is crooked; the mirror and whole ms explain less


class Machine:
    """How late this loop is woken, and how long scipd's threads had run and waited at each of the last beats."""
    BEAT_S = 0.005

    def __init__(self, scipd):
        self.scipd = scipd
        self.due_s = self.beat_s = time.monotonic()
        self.overshoot_s = 0.0  # how late the last beat came
        self.times = collections.deque([(self.beat_s, *scipd.times_s())], maxlen=20_000)

    async def run(self):
        while True:
            self.due_s = time.monotonic() + self.BEAT_S
            await asyncio.sleep(self.BEAT_S)
            self.beat_s = time.monotonic()
            self.overshoot_s = self.beat_s - self.due_s
            self.times.append((self.beat_s, *self.scipd.times_s()))

    def times_since_s(self, when_s):
        """How long scipd's first thread has run since the last beat before that time, and how long it has waited for a
        core. An answer may also need all threads of scans, which wait side by side."""
        ran_s, waited_s = self.scipd.times_s()
        _, then_ran_s, then_waited_s = next((beat for beat in reversed(self.times) if beat[0] <= when_s), self.times[0])
        waits_s = {thread: now_s - then_waited_s.get(thread, now_s) for thread, now_s in waited_s.items()}
        of_first_s = waits_s.pop(str(self.scipd.pid), 0.0)
        return ran_s - then_ran_s, of_first_s + max(waits_s.values(), default=0.0)

    def late_s(self):
        """How late this loop handles an event at this moment."""
        now_s = time.monotonic()
        woken_with_the_beat = now_s - self.beat_s < 0.2 * self.BEAT_S
        return self.overshoot_s if woken_with_the_beat else max(0.0, now_s - self.due_s)


@dataclasses.dataclass
class Answer:
    """An answer, in s: since when it counts, how long it took, how long scipd ran and waited for a core meanwhile, and
    how late this loop handled it."""
    since_s: float
    took_s: float
    ran_s: float
    waited_s: float
    late_s: float

    def machine_s(self):
        return self.waited_s + self.late_s

    def by_scipd_s(self):
        return max(0.0, self.took_s - self.machine_s())


class Stream(asyncio.Protocol):
    """Takes a scanner's scans and checks each of them. It calls `missing(n, since)` for each gap."""

    def __init__(self, name, request, points, period_ms, missing):
        self.name, self.request, self.points, self.period_ms = name, request, points, period_ms
        self.tell_missing = missing
        self.buffer = b""
        self.scans = self.missed = self.damaged = self.crooked = 0
        self.stamp_ms = None
        self.last_s = None
        self.silence_s = 0.0
        self.fault = None  # a description of the first fault

    def connection_made(self, transport):
        transport.write(self.request + b"\n")

    def connection_lost(self, error):
        self.fault = self.fault or f"the connection was closed ({error})"

    def data_received(self, data):
        *messages, self.buffer = (self.buffer + data).split(b"\n\n")
        for message in messages:
            self.take(message.split(b"\n"))

    def take(self, lines):
        if self.last_s is None and lines[:2] == [self.request, b"00P"]:
            self.last_s = time.monotonic()
            return
        data = b"".join(line[:-1] for line in lines[3:])
        whole = lines[:2] == [self.request, b"99b"] and len(data) == 3 * self.points
        if not whole or not all(map(wire.sum_is_right, lines[2:])):
            self.damaged += 1
            self.fault = self.fault or f"damaged: {lines[:3]}, {len(data)} characters of data"
            return
        self.take_scan(wire.decoded(lines[2][:4]), time.monotonic())

    def take_scan(self, stamp_ms, now_s):
        self.scans += 1
        if self.stamp_ms is not None:
            step_ms = stamp_ms - self.stamp_ms & CLOCK_MASK
            turns = round(step_ms / self.period_ms)
            if turns != 1:
                self.missed += max(turns - 1, 1)
                self.tell_missing(max(turns - 1, 1), self.last_s + self.period_ms / 1000)
            self.crooked += abs(step_ms - turns * self.period_ms) >= CROOKED_MS
            self.silence_s = max(self.silence_s, now_s - self.last_s)
        self.stamp_ms, self.last_s = stamp_ms, now_s


def stream_from_tty(path, stream):
    """Does what asyncio does for a socket."""
    descriptor = wire.open_tty(path)
    os.write(descriptor, stream.request + b"\n")

    def read():
        try:
            data = os.read(descriptor, 65536)
        except BlockingIOError:
            return
        except OSError as error:
            data = b""
            stream.connection_lost(error)
        if data:
            return stream.data_received(data)
        asyncio.get_running_loop().remove_reader(descriptor)
        stream.connection_lost(None)

    asyncio.get_running_loop().add_reader(descriptor, read)


class Http:
    """Makes one request after the other on a lasting connection."""

    def __init__(self, where):
        self.where = where
        self.reader = None

    async def ask(self, method, path, body=None):
        if self.reader is None:
            self.reader, self.writer = await asyncio.open_connection(*self.where)
        self.writer.write(wire.http_request(self.where, method, path, body))
        head = await self.reader.readuntil(b"\r\n\r\n")
        fields = dict(line.lower().split(": ", 1) for line in head.decode().split("\r\n")[1:] if line)
        length = int(fields.get("content-length", 0))
        return int(head.split()[1]), await self.reader.readexactly(length)


class StatusClient:
    """Asks ten times a second. If an answer delays the next requests, their time counts as well. It calls `answered`
    for each answer."""
    PERIOD_S = 0.1

    def __init__(self, scipd, machine, answered):
        self.scipd, self.machine, self.answered = scipd, machine, answered
        self.latest = {}
        self.unanswered = None  # since when

    async def run(self):
        http = Http(self.scipd.http)
        due = time.monotonic()
        while True:
            begin = min(due + self.PERIOD_S, time.monotonic())  # a delayed request counts from when it was due
            self.unanswered = begin
            status, body = await http.ask("GET", "/status")
            self.take_time()
            if status != 200:
                raise RuntimeError(f"/status: {status}")
            self.latest = json.loads(body)
            due = due + self.PERIOD_S
            await asyncio.sleep(max(0.0, due - time.monotonic()))

    def take_time(self):
        """Records an answer, or one that has not come yet."""
        if self.unanswered:
            begin, self.unanswered = self.unanswered, None
            took_s = time.monotonic() - begin
            self.answered(Answer(begin, took_s, *self.machine.times_since_s(begin), self.machine.late_s()))


def place_at(now_s):
    angle = 0.2 * now_s
    return [-1 + 0.3 * math.cos(angle), -1 + 0.3 * math.sin(angle), 0]


class PoseSenders:
    """Sends a hundred poses a second for each of two robots: by WebSocket, which reports refusals, and by UDP. The
    robot on UDP must be where it was told to be."""
    PERIOD_S = 0.01
    STRAYED_M = 0.15  # it moves this far in two and a half seconds

    def __init__(self, scipd):
        self.scipd = scipd
        self.sent = self.refused = self.asked = self.strayed = 0
        self.fault = None

    async def send(self):
        datagrams, _ = await asyncio.get_running_loop().create_datagram_endpoint(
            asyncio.DatagramProtocol, remote_addr=("127.0.0.1", self.scipd.udp["driven"]))
        reader, writer = await asyncio.open_connection(*self.scipd.http)
        writer.write(wire.http_request(self.scipd.http, "GET", "/poses", fields=wire.UPGRADE))
        await reader.readuntil(b"\r\n\r\n")
        hearing = asyncio.ensure_future(self.hear(reader))
        due = time.monotonic()
        while not hearing.done():
            xyz = place_at(time.monotonic())
            datagrams.sendto(json.dumps({"robot": "driven", "xyz": xyz, "rpy": [0, 0, 0]}).encode())
            writer.write(wire.text_frame(json.dumps({"robot": "steered", "xyz": xyz, "rpy": [0, 0, 0]}).encode()))
            self.sent += 1
            due = max(due + self.PERIOD_S, time.monotonic() - 1.0)
            await asyncio.sleep(max(0.0, due - time.monotonic()))
        raise RuntimeError("the WebSocket /poses was closed")

    async def hear(self, reader):
        while data := await reader.read(65536):
            self.refused += data.count(b'"detail"')
            self.fault = self.fault or data[:300].decode(errors="replace")

    async def look(self):
        http = Http(self.scipd.http)
        while True:
            await asyncio.sleep(1.0)
            status, body = await http.ask("GET", "/robots/driven/pose")
            self.asked += 1
            if status != 200 or math.dist(json.loads(body)["xyz"], place_at(time.monotonic())) > self.STRAYED_M:
                self.strayed += 1
                self.fault = self.fault or f"driven is elsewhere: {body.decode()}, not {place_at(time.monotonic())}"


class Pictures:
    """Reads the pictures of a camera as they come, and notes how much later than a period after the one before the
    latest came. scipd measures its backends first, which holds a few up."""
    SETTLED_S = 5.0

    def __init__(self, scipd, machine, sensor, period_s):
        self.scipd, self.machine, self.sensor, self.period_s = scipd, machine, sensor, period_s
        self.count = 0
        self.late_s = 0.0
        self.settled_s = time.monotonic() + self.SETTLED_S
        self.last_s = None

    def take(self):
        now_s = time.monotonic()
        self.count += 1
        if self.last_s is not None and now_s > self.settled_s:
            self.late_s = max(self.late_s, now_s - self.last_s - self.period_s - self.machine.late_s())
        self.last_s = now_s

    async def run(self):
        reader, writer = await asyncio.open_connection(*self.scipd.http)
        writer.write(wire.http_request(self.scipd.http, "GET", f"/stream?sensor={self.sensor}", fields=wire.UPGRADE))
        await reader.readuntil(b"\r\n\r\n")
        while True:
            kind, length = await reader.readexactly(2)
            if kind & 0x0F == wire.PING:
                writer.write(wire.PONG)
            wide = {126: 2, 127: 8}.get(length, 0)
            if wide:
                length = int.from_bytes(await reader.readexactly(wide), "big")
            while length > 0:
                length -= len(await reader.read(min(length, 65536)))
            if kind & 0x0F != wire.PING:
                self.take()


class Editor:
    """Adds a model and removes it. If another world was loaded meanwhile, the model is already gone. It calls
    `answered(since, s)` for each change."""
    PERIOD_S = 2.0

    def __init__(self, scipd, answered):
        self.scipd, self.answered = scipd, answered
        self.unanswered = None  # since when

    async def run(self):
        http = Http(self.scipd.http)
        while True:
            body = {"name": "good", "sdf": MODEL, "pose": {"xyz": [2.5, 1.7, 0.1]}}
            await self.ask(http, "POST", "/scene/models", body, (201,))
            await self.ask(http, "DELETE", "/scene/models/good", None, (204, 404))
            await asyncio.sleep(self.PERIOD_S)

    async def ask(self, http, method, path, body, right):
        self.unanswered = time.monotonic()
        status, answer = await http.ask(method, path, body)
        self.take_time()
        if status not in right:
            raise RuntimeError(f"{method} {path}: {answer.decode()}")

    def take_time(self):
        if self.unanswered:
            begin, self.unanswered = self.unanswered, None
            self.answered(begin, time.monotonic() - begin)
