#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
What `scipcat proxy` hands on, records and tells: against a scanner of this test that answers with anything, over TCP
and ttys. proxy_test.py SCIPCAT
"""
import contextlib
import fcntl
import itertools
import json
import os
import pathlib
import pty
import random
import select
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import tty

SCIPCAT = sys.argv[1]
PATIENCE_S = 60
# A sanitizer keeps what is freed. The presets of their tests set one of these.
SANITIZED = "ASAN_OPTIONS" in os.environ or "TSAN_OPTIONS" in os.environ
# What the specifications of SCIP 1.1, 2.0 and 2.2 have, and what no scanner knows.
REQUESTS = [
    b"\n", b"\r\n", b"SCIP2.0\n", b"V\n", b"L1\n", b"G00076801\n", b"S019200abcdefg\n", b"VV\n", b"PP;name\n", b"II\r",
    b"BM\n", b"QT\n", b"RS\n", b"RT\n", b"RB\n", b"TM0\n", b"TM1;x\n", b"TM2\n", b"SS019200\n", b"CR10\n", b"HS1\n",
    b"DB40\n", b"GD0000108001\n", b"GS0000108002\n", b"GE0000108000\n", b"HD0000108000\n", b"HE0000108000\n",
    b"GF0000108000\n", b"GG0000108000\n", b"MD0000108001000\n", b"MS0044072503002;a b\n", b"ME0000108000100\n",
    b"ND0000108000000\n", b"NE0000108000000\n", b"MF0000108000000\n", b"MG0000108000000\n", b"%MD0000108000000\n",
    b"%ME0000108000000\n", b"%ST\n", b"%SL\n", b"%TM1\n", b"$IP192168000010255255255000192168000001\n", b"DO\n",
    bytes(range(256)), b"\0" * 7, b"no line end"]


class Scanner:
    """Takes one client after the other, keeps what each said, and says what the test wants."""

    def __init__(self):
        self.heard = []  # of each client
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.client = None
        self.target = "tcp://127.0.0.1:%d" % self.listener.getsockname()[1]
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self):
        with contextlib.suppress(OSError):
            while True:
                client, _ = self.listener.accept()
                client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                self.heard.append(b"")
                self.client = client
                with contextlib.suppress(OSError):
                    while more := client.recv(65536):
                        self.heard[-1] += more
                client.close()
                self.client = None

    def say(self, data):
        self.client.sendall(data)

    def close(self):
        with contextlib.suppress(OSError):
            self.listener.shutdown(socket.SHUT_RDWR)
        self.listener.close()
        if client := self.client:
            with contextlib.suppress(OSError):
                client.shutdown(socket.SHUT_RDWR)


class TtyScanner:
    """The same behind a tty."""

    def __init__(self):
        self.heard = [b""]
        self.master, self.slave = pty.openpty()
        tty.setraw(self.slave)
        self.target = os.ttyname(self.slave)
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self):
        with contextlib.suppress(OSError):
            while more := os.read(self.master, 65536):
                self.heard[-1] += more

    def say(self, data):
        while data:
            data = data[os.write(self.master, data):]

    def close(self):
        os.close(self.slave)


class Driver:
    def __init__(self, place):
        self.got = b""
        if place.startswith("/"):
            self.descriptor = os.open(place, os.O_RDWR | os.O_NOCTTY)
        else:
            host, port = place.rsplit(":", 1)
            self.socket = socket.create_connection((host, int(port)), timeout=PATIENCE_S)
            self.descriptor = self.socket.detach()
            os.set_blocking(self.descriptor, True)

    def say(self, data):
        while data:
            data = data[os.write(self.descriptor, data):]

    def read(self, seconds=PATIENCE_S):
        """False: the scanner is gone."""
        assert select.select([self.descriptor], [], [], seconds)[0], f"nothing came after {self.got[-100:]!r}"
        try:
            more = os.read(self.descriptor, 65536)
        except OSError:  # a tty that hangs up
            more = b""
        self.got += more
        return bool(more)

    def read_bytes(self, count):
        while len(self.got) < count:
            assert self.read(), f"the end after {len(self.got)} of {count} bytes"
        return self.got

    def close(self):
        os.close(self.descriptor)


class Proxy:
    def __init__(self, target, *words, door="--listen"):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="scipd-proxy-"))
        where = "127.0.0.1:0" if door == "--listen" else str(self.folder / "tty")
        self.errors = open(self.folder / "stderr", "w")
        self.process = subprocess.Popen([SCIPCAT, "proxy", target, door, where, "--json", *map(str, words)],
                                        stdout=subprocess.PIPE, stderr=self.errors, text=True)
        line = self.process.stdout.readline()
        assert line, self.said()
        ready = json.loads(line)
        assert list(ready) == ["ready", "listen"] and ready["ready"] is True, ready
        self.place = ready["listen"]
        assert self.place == where or door == "--listen", ready

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end(signal.SIGKILL)
        self.errors.close()
        shutil.rmtree(self.folder)

    def said(self):
        return (self.folder / "stderr").read_text()

    def end(self, how=signal.SIGINT):
        """The exit code, and the rest of standard output."""
        if self.process.poll() is None:
            self.process.send_signal(how)
        out, _ = self.process.communicate(timeout=PATIENCE_S)
        return self.process.returncode, out

    def memory_kib(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.split("VmRSS:")[1].split()[0])


def wait_for(condition, what):
    end = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.01)


def info(file):
    done = subprocess.run([SCIPCAT, "info", file, "--json"], capture_output=True, text=True, timeout=PATIENCE_S)
    assert done.returncode == 0, done
    return json.loads(done.stdout)


def in_pieces(chance, data):
    while data:
        size = chance.choice([1, 2, 5, 64, 700, 5000])
        yield data[:size]
        data = data[size:]


def hands_on_every_byte():
    """All requests one way and all byte values the other, in any pieces, over both kinds of links on either side."""
    for make, door in itertools.product([Scanner, TtyScanner], ["--listen", "--pty"]):
        chance = random.Random(f"{make} {door}")
        answers = chance.randbytes(200_000)
        scanner = make()
        with Proxy(scanner.target, door=door) as proxy:
            driver = Driver(proxy.place)
            wait_for(lambda: "the scanner is there" in proxy.said(), proxy.said)
            wait_for(lambda: make is TtyScanner or scanner.client, "no client")
            said = threading.Thread(target=lambda: [scanner.say(piece) for piece in in_pieces(chance, answers)])
            said.start()
            requests = REQUESTS * 20
            for request in requests:
                driver.say(request)
            assert driver.read_bytes(len(answers)) == answers, f"other bytes by {make} and {door}"
            said.join()
            wanted = b"".join(requests)
            wait_for(lambda: len(scanner.heard[-1]) >= len(wanted), f"{len(scanner.heard[-1])} bytes of {len(wanted)}")
            assert scanner.heard[-1] == wanted, f"other requests by {make} and {door}"
            driver.close()
            assert proxy.end() == (0, ""), proxy.said()
        scanner.close()


def serves_one_driver_at_a_time():
    scanner = Scanner()
    with Proxy(scanner.target) as proxy:
        first, second = Driver(proxy.place), Driver(proxy.place)
        first.say(b"VV\n")
        second.say(b"PP\n")
        wait_for(lambda: scanner.heard == [b"VV\n"], scanner.heard)
        scanner.say(b"for the first")
        assert first.read_bytes(13) == b"for the first"
        first.close()
        wait_for(lambda: scanner.heard == [b"VV\n", b"PP\n"], scanner.heard)
        scanner.say(b"for the second")
        assert second.read_bytes(14) == b"for the second"
        second.close()
    scanner.close()


def outlives_the_scanner():
    """What it has said before it goes reaches the driver. Who comes meanwhile is turned away, as is who was there."""
    scanner = Scanner()
    target = scanner.target
    with Proxy(target) as proxy:
        driver = Driver(proxy.place)
        wait_for(lambda: scanner.client, "no client")
        scanner.say(b"x" * 300_000)
        scanner.close()
        while driver.read():
            pass
        assert driver.got == b"x" * 300_000, len(driver.got)
        driver.close()
        late = Driver(proxy.place)
        assert not late.read()
        late.close()
        assert "the scanner is gone: cannot connect" in proxy.said(), proxy.said()
        back = Scanner.__new__(Scanner)
        back.heard, back.client = [], None
        back.listener = socket.create_server(("127.0.0.1", int(target.rsplit(":", 1)[1])))
        threading.Thread(target=back._serve, daemon=True).start()
        again = Driver(proxy.place)
        again.say(b"VV\n")
        wait_for(lambda: back.heard == [b"VV\n"], proxy.said)
        again.close()
        back.close()


def summed(line):
    return line + bytes([(sum(line) & 0x3F) + 0x30])


def follows_the_rate_of_the_line():
    """What the scanner has agreed to holds behind its answer, in whatever pieces it comes, and nothing else does."""
    scanner = TtyScanner()

    def rate():
        """TCGETS2: four words of flags, 20 bytes, and both rates, some of which POSIX has no name for."""
        return struct.unpack("36x2I", fcntl.ioctl(scanner.slave, 0x802C542A, bytes(44)))[1]

    with Proxy(scanner.target, "--baud", "115200", door="--pty") as proxy:
        driver = Driver(proxy.place)
        wait_for(lambda: "the scanner is there" in proxy.said(), proxy.said)
        for request, answers, wanted in [
                (b"SS019200\n", [b"SS01", b"9200\n", b"00P", b"\n", b"\n"], 19200),
                (b"SS999999\n", [b"SS999999\n02R\n\n"], 19200),
                (b"SS019200\n", [b"SS019200\n03S\n\n"], 19200),
                (b"S0384000000000\n", [b"S0384000000000\n0\n\n"], 38400),
                (b"SS500000;x\n", [b"SS115200\n00P\n\n", b"SS500000;x\n00P\n\n"], 500000)]:
            driver.say(request)
            wait_for(lambda: scanner.heard[-1].endswith(request), scanner.heard)
            before = rate()
            for piece in answers[:-1]:
                scanner.say(piece)
                driver.got = b""
                driver.read_bytes(len(piece))
                assert rate() == before, (request, piece)
            scanner.say(answers[-1])
            wait_for(lambda: rate() == wanted, f"{request}: {rate()}")
        driver.close()
    scanner.close()


def scan(stamp, steps=1081):
    """A message of MD, as the specification has it: SCIP 2.0, C-42-03320B, p. 9."""
    encoded = bytes([(stamp >> shift & 0x3F) + 0x30 for shift in (18, 12, 6, 0)])
    data = b"".join(bytes([(1000 + i >> shift & 0x3F) + 0x30 for shift in (12, 6, 0)]) for i in range(steps))
    lines = [data[i:i + 64] for i in range(0, len(data), 64)]
    last = b"%04d" % (steps - 1)
    return b"\n".join([b"MD0000" + last + b"01000", summed(b"99"), summed(encoded), *map(summed, lines), b"", b""])


def records_what_goes_by():
    """Ctrl-C loses nothing, and a kill no more than the last second."""
    for how, least in [(signal.SIGINT, 60), (signal.SIGKILL, 10)]:
        scanner = Scanner()
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "day.mcap"
            with Proxy(scanner.target, "-o", file) as proxy:
                driver = Driver(proxy.place)
                driver.say(b"MD0000108001000\n")
                wait_for(lambda: scanner.heard == [b"MD0000108001000\n"], scanner.heard)
                for stamp in range(60):
                    scanner.say(scan(25 * stamp))
                    time.sleep(0.05)
                driver.read_bytes(60 * len(scan(0)))
                code, _ = proxy.end(how)
                assert code == (0 if how == signal.SIGINT else -signal.SIGKILL), proxy.said()
                driver.close()
            told = info(file)
            assert least <= told["scans"] <= 60 and told["steps"] == 1081, told
            assert (told["scans"] == 60) == (how == signal.SIGINT), told
        scanner.close()


def records_scans_in_other_formats():
    """A CSV has rows of one length: where the driver asks for other steps it ends, and the driver is served on."""
    scanner = Scanner()
    with tempfile.TemporaryDirectory() as folder:
        for ending in ("ubh", "csv", "jsonl"):
            file = pathlib.Path(folder) / f"day.{ending}"
            with Proxy(scanner.target, "-o", file) as proxy:
                driver = Driver(proxy.place)
                wait_for(lambda: scanner.client, "no client")
                said = scan(0) + scan(25) + scan(50, 700)
                scanner.say(said)
                driver.read_bytes(len(said))
                driver.close()
                code, _ = proxy.end()
                assert code == (1 if ending == "csv" else 0), (code, proxy.said())
                assert ("the same columns" in proxy.said()) == (ending == "csv"), proxy.said()
            told = info(file)
            assert told["format"] == ending and told["scans"] == (2 if ending == "csv" else 3), told
    scanner.close()


def records_as_much_as_goes_by():
    """A minute of scans in a moment: none is lost, however the bytes come in pieces."""
    scanner = Scanner()
    scans = [scan(25 * stamp) for stamp in range(2400)]
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "minute.mcap"
        with Proxy(scanner.target, "-o", file) as proxy:
            driver = Driver(proxy.place)
            wait_for(lambda: scanner.client, "no client")
            said = threading.Thread(target=scanner.say, args=[b"".join(scans)])
            said.start()
            assert driver.read_bytes(sum(map(len, scans))) == b"".join(scans)
            said.join()
            driver.close()
            assert proxy.end()[0] == 0, proxy.said()
        told = info(file)
        assert told["scans"] == 2400 and abs(told["seconds"] - 2399 * 0.025) < 0.001 and not told["gaps"], told
    scanner.close()


def needs_no_more_memory_with_time():
    """About twenty minutes of a UST-10LX, for a driver that reads and for one that does not."""
    scanner = Scanner()
    minute = b"".join(scan(25 * stamp) for stamp in range(2400))
    with Proxy(scanner.target) as proxy:
        driver = Driver(proxy.place)
        wait_for(lambda: scanner.client, "no client")
        sizes = []
        for _ in range(20):
            said = threading.Thread(target=scanner.say, args=[minute])
            said.start()
            driver.got = b""
            driver.read_bytes(len(minute))
            said.join()
            sizes.append(proxy.memory_kib())
        assert SANITIZED or max(sizes[5:]) - sizes[4] < 2048, sizes

        def say_too_much():
            with contextlib.suppress(OSError):
                scanner.say(minute * 8)

        said = threading.Thread(target=say_too_much, daemon=True)
        said.start()
        time.sleep(1)
        assert said.is_alive(), "somebody took 60 MB that nobody reads"
        assert SANITIZED or proxy.memory_kib() - sizes[-1] < 4096, (sizes, proxy.memory_kib())
        driver.close()
    scanner.close()


def refuses_what_it_cannot_do():
    def refused(*words):
        done = subprocess.run([SCIPCAT, "proxy", *words], capture_output=True, text=True, timeout=PATIENCE_S)
        assert done.returncode == 2 and done.stdout == "", done
        return done.stderr

    target, door = "tcp://127.0.0.1:1", ["--listen", "127.0.0.1:0"]
    assert "--listen ADDR:PORT or --pty LINK" in refused(target)
    assert "--listen and --pty do not go together: give one of both" in refused(target, *door, "--pty", "/tmp/x")
    assert "must be" in refused(target, "--listen", "somewhere")
    assert ".mcap" in refused(target, *door, "-o", "a.txt")
    assert "did you mean corrupt? These do: corrupt, lose" in refused(target, *door, "--fault", "corupt")
    assert "'reboot' touches neither bytes nor messages. These do" in refused(target, *door, "--fault", "reboot")
    assert "ms" in refused(target, *door, "--fault", "delay")
    assert "no KEY=VALUE" in refused(target, *door, "--fault", "delay,50")
    assert "only an emulated scanner boots" in refused(target, *door, "--fault", "cut,boot=true")
    assert "needs s" in refused(target, *door, "--fault", "cut,for.scans=3")
    assert "no scanner" in refused(target, *door, "--twin", "nothing")
    taken = socket.create_server(("127.0.0.1", 0))
    assert "in use" in refused(target, "--listen", "127.0.0.1:%d" % taken.getsockname()[1])


for test in (hands_on_every_byte, serves_one_driver_at_a_time, follows_the_rate_of_the_line, outlives_the_scanner,
             records_what_goes_by, records_scans_in_other_formats, records_as_much_as_goes_by,
             needs_no_more_memory_with_time, refuses_what_it_cannot_do):
    begun = time.monotonic()
    test()
    print(f"{test.__name__}: {time.monotonic() - begun:.1f} s", flush=True)
