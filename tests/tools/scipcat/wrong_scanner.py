# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# A scanner that breaks one promise: it stands between a client and a scipd, and changes what passes. One client at a
# time, as a scanner has it.
import re
import select
import socket
import threading
import time

END = b"\n\n"
SCAN = "99"


def summed(text):
    return text + chr((sum(text.encode("latin-1")) & 0x3F) + 0x30)


def encoded(value, width):
    return "".join(chr((value >> 6 * i & 0x3F) + 0x30) for i in reversed(range(width)))


def decoded(text):
    value = 0
    for character in text:
        value = value << 6 | ord(character) - 0x30
    return value


class Message:
    """What a scanner sends, in parts that a fault may change; sums are made anew."""

    def __init__(self, raw):
        lines = raw.decode("latin-1").split("\n")[:-2]
        self.echo, self.status = lines[0], lines[1][:-1] if len(lines[1]) > 1 else lines[1]
        self.lines = [line[:-1] for line in lines[2:]]

    def raw(self):
        status = summed(self.status) if len(self.status) > 1 else self.status
        return "\n".join([self.echo, status, *map(summed, self.lines), "", ""]).encode("latin-1")

    # A scan: a stamp, then data cut into lines of 64.

    def data(self):
        return "".join(self.lines[1:])

    def set_data(self, data, width=64):
        self.lines[1:] = [data[i:i + width] for i in range(0, len(data), width)]

    # VV, PP and II: a line of KEY:VALUE; each, whose sum does not include the semicolon.

    def texts(self):
        return dict(line[:-1].split(":", 1) for line in self.lines)


def of_texts(echo, texts):
    lines = [f"{key}:{value};{summed(f'{key}:{value}')[-1]}" for key, value in texts.items()]
    return "\n".join([echo, summed("00"), *lines, "", ""]).encode("latin-1")


class Fault:
    """Does nothing. Others override what they need. `self.wire` is the conversation that it is in."""

    def begin(self):
        """Another client has come."""

    def chunk(self, data):
        """What the client has sent, in the pieces that came, on its way to the scanner."""
        return data

    def message(self, raw):
        """A whole message on its way to the client."""
        return raw


class Wire:
    """A client, the scanner behind, and the fault between them."""

    def __init__(self, client, scanner, fault):
        self.client, self.scanner, self.fault = client, scanner, fault
        self.unread = b""
        fault.wire = self
        fault.begin()

    def to_client(self, data):
        if data:
            self.client.sendall(data)

    def to_scanner(self, data):
        if data:
            self.scanner.sendall(data)

    def run(self, stopped, hurried=lambda: False):
        while not stopped.is_set() and not hurried():
            ready, _, _ = select.select([self.client, self.scanner], [], [], 0.05)
            if self.client in ready:
                data = self.client.recv(65536)
                if not data:
                    return
                self.to_scanner(self.fault.chunk(data))
            if self.scanner in ready:
                data = self.scanner.recv(65536)
                if not data:
                    return
                self.unread += data
                while END in self.unread:
                    raw, self.unread = self.unread.split(END, 1)
                    self.to_client(self.fault.message(raw + END))


class WrongScanner:
    """Listens at `target` as long as the block that uses it lasts."""

    def __init__(self, address, fault):
        self.address, self.fault = address, fault
        self.listener = socket.create_server(("127.0.0.1", 0), backlog=5)
        self.listener.settimeout(0.05)
        self.target = f"tcp://127.0.0.1:{self.listener.getsockname()[1]}"
        self.stopped = threading.Event()
        self.thread = threading.Thread(target=self.serve)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.stopped.set()
        self.thread.join()
        self.listener.close()

    def serve(self):
        accept = getattr(self.fault, "accept", self.serve_one)
        while not self.stopped.is_set():
            try:
                client, _ = self.listener.accept()
            except TimeoutError:
                continue
            client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            accept(self, client) if accept != self.serve_one else self.serve_one(client)

    def serve_one(self, client, hurried=lambda: False):
        with client, socket.create_connection(self.address) as scanner:
            scanner.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            try:
                Wire(client, scanner, self.fault).run(self.stopped, hurried)
            except OSError:
                pass  # one of them has hung up


# Faults of one message. `echo` is a regular expression of all of it.

class Change(Fault):
    """Hands the messages with such an echo, and such a status, to a function that returns bytes, or changes them."""

    def __init__(self, echo, change, status=None, nth=None):
        self.echo, self.change, self.status, self.nth = re.compile(echo), change, status, nth
        self.met = 0

    def begin(self):
        self.met = 0

    def message(self, raw):
        message = Message(raw)
        if not self.echo.fullmatch(message.echo) or self.status not in (None, message.status):
            return raw
        self.met += 1
        if self.nth not in (None, self.met):
            return raw
        changed = self.change(message)
        return message.raw() if changed is None else changed


def answers(echo, status, other, nth=None):
    """Another status, without data; in place of any where `status` is None."""
    def change(message):
        message.status, message.lines = other, []
    return Change(echo, change, status, nth)


def says(request, key, value):
    """Another text in VV, PP or II; None: the line is missing."""
    def change(message):
        texts = message.texts()
        texts[key] = value
        return of_texts(message.echo, {name: text for name, text in texts.items() if text is not None})
    return Change(request, change)


def lacks_a_value(echo, width=3):
    """The last value of each scan is missing."""
    def change(message):
        if message.status in ("00", SCAN) and len(message.lines) > 1:
            io = 1 if re.match("[GM][FG]", message.echo) else 0
            head, data = message.lines[:1 + io], "".join(message.lines[1 + io:])[:-width]
            message.lines = head + [data[i:i + 64] for i in range(0, len(data), 64)]
    return Change(echo, change)


def stamped(echo, change_stamp, status=None):
    """The stamp, or the time of TM1, is a function of what it was and of how many came before."""
    count = iter(range(10**9))

    def change(message):
        if message.lines and message.status in ("00", SCAN):
            width = len(message.lines[0])
            message.lines[0] = encoded(change_stamp(decoded(message.lines[0]), next(count)) % 2**24, width)
    return Change(echo, change, status)


def late(echo, seconds, status=None, nth=None):
    def change(message):
        time.sleep(seconds)
        return message.raw()
    return Change(echo, change, status, nth)


def raw_changed(echo, function, status=None, nth=None):
    """The bytes of such a message are handed to a function."""
    return Change(echo, lambda message: function(message.raw()), status, nth)


class Chunk(Fault):
    """Hands what the client sends to a function of these bytes and of the wire."""

    def __init__(self, change):
        self.change = change

    def chunk(self, data):
        return self.change(data, self.wire)


def answers_itself(request, reply=None):
    """Says that it has carried a request out, and has not."""
    def change(data, wire):
        lines = data.split(b"\n")
        if request in lines:
            wire.to_client(reply or request + b"\n00P\n\n")
            lines.remove(request)
        return b"\n".join(lines)
    return Chunk(change)
