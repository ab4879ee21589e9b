# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# For each check of `scipcat check` a scanner that breaks just this promise: the kind of scanner, and the fault.
import itertools
import re
import time

from wrong_scanner import (SCAN, Change, Chunk, Fault, Message, answers, answers_itself, decoded, encoded,
                           lacks_a_value, late, of_texts, raw_changed, says, stamped)

GD, MD = r"GD\d{10}", r"MD\d{13}"


def swapped(message):
    texts = list(message.texts().items())
    texts[1], texts[2] = texts[2], texts[1]
    return of_texts(message.echo, dict(texts))


def with_counter():
    count = itertools.count()

    def change(message):
        return of_texts(message.echo, {**message.texts(), "VEND": f"Vendor {next(count)}"})
    return Change("VV", change)


def wrong_sum(line):
    """Counts from the echo, which is 0."""
    def change(raw):
        lines = raw.split(b"\n")
        lines[line] = lines[line][:-1] + (b"1" if lines[line][-1:] == b"0" else b"0")
        return b"\n".join(lines)
    return change


def cut_at_32(message):
    message.set_data(message.data(), 32)


def first_value(value):
    def change(message):
        message.set_data(encoded(value, 3) + message.data()[3:])
    return change


def told(line):
    """Another line behind the status."""
    def change(message):
        message.lines = [line]
    return change


def at_count(digits):
    """Scans have another number that are still to come."""
    def change(message):
        message.echo = message.echo[:-2] + digits
    return Change(r"M.\d{13}", change, SCAN)


class OneMore(Fault):
    """A scan more comes behind the last one, or behind the reply to QT."""

    def __init__(self, behind):
        self.behind, self.scan = behind, b""

    def begin(self):
        self.scan = b""

    def message(self, raw):
        message = Message(raw)
        if message.status == SCAN:
            self.scan = raw
        if self.behind == "QT" and message.echo == "QT":
            return raw + self.scan
        return raw + raw if self.behind == "count" and message.status == SCAN and message.echo.endswith("00") else raw


class WithoutSkipping(Fault):
    """Takes every interval for 0, and says that it does not."""

    def __init__(self):
        self.interval = "0"

    def chunk(self, data):
        def zero(request):
            self.interval = request[2].decode()
            return request[1] + b"0" + request[3]
        return re.sub(rb"(MD\d{10})(\d)(\d\d)", zero, data)

    def message(self, raw):
        return re.sub(rb"^(MD\d{10})\d", rb"\g<1>" + self.interval.encode(), raw)


class DeafInStream(Fault):
    """Passes over some requests while it streams."""

    def __init__(self, deaf_to, reply=b""):
        self.deaf_to, self.reply = deaf_to, reply
        self.streams = False

    def chunk(self, data):
        kept = []
        for line in data.split(b"\n"):
            if self.streams and re.fullmatch(self.deaf_to, line):
                self.wire.to_client(line + self.reply if self.reply else b"")
                continue
            self.streams = self.streams and line != b"QT" or line.startswith(b"MD")
            kept.append(line)
        return b"\n".join(kept)


class FarthestOfGroup(Fault):
    """A cluster of 16 has its farthest distance."""

    def chunk(self, data):
        self.grouped = re.search(rb"MD\d{8}16", data) is not None or b"MD" not in data and self.grouped
        return re.sub(rb"(MD\d{8})16", rb"\g<1>01", data)

    def begin(self):
        self.grouped = False

    def message(self, raw):
        message = Message(raw)
        if not self.grouped or not message.echo.startswith("MD"):
            return raw
        message.echo = message.echo[:10] + "16" + message.echo[12:]
        if message.status == SCAN:
            data = message.data()
            values = [data[i:i + 3] for i in range(0, len(data), 3)]
            message.set_data("".join(max(values[i:i + 16]) for i in range(0, len(values), 16)))
        return message.raw()


class SwitchesOn(Fault):
    """The laser goes on with a request that it refuses."""

    def chunk(self, data):
        return data.replace(b"MD9999999901000\n", b"BM\nMD9999999901000\n")

    def message(self, raw):
        return b"" if raw.startswith(b"BM\n") else raw


class DiesOf(Fault):
    """Says nothing any more once such bytes came."""

    def __init__(self, deadly):
        self.deadly = deadly

    def begin(self):
        self.dead = False

    def chunk(self, data):
        self.dead = self.dead or self.deadly(data)
        return b"" if self.dead else data


class OutOfOrder(Fault):
    """Of requests that come together, the first is answered last."""

    def chunk(self, data):
        lines = data.split(b"\n")
        return b"\n".join(lines[1:-1] + lines[:1] + lines[-1:]) if len(lines) > 2 and lines[0] else data


def drops_behind(first, dropped):
    """A request that comes in one piece with another is lost."""
    def change(data, _):
        lines = data.split(b"\n")
        if len(lines) > 2 and re.match(first, lines[0]):
            lines = [line for line in lines if not re.match(dropped, line)]
        return b"\n".join(lines)
    return Chunk(change)


def answers_empty_lines(data, wire):
    if data.strip(b"\r\n") == b"" and len(data) > 1:
        wire.to_client(b"\n0Ee\n\n")
    return data


class LeavesForNext(Fault):
    """The fault of one client is what another left: half a request, or a stream."""

    def __init__(self, kind):
        self.kind, self.half, self.scan = kind, b"", b""

    def begin(self):
        if self.kind == "stream" and self.scan:
            self.wire.to_client(self.scan + self.scan)
        self.scan = b""

    def chunk(self, data):
        if self.kind == "half":
            data, self.half = self.half + data, b""
            self.half = data if b"\n" not in data else b""
            return b"" if self.half else data
        return data

    def message(self, raw):
        self.scan = raw if Message(raw).status == SCAN else b"" if raw.startswith(b"QT\n") else self.scan
        return raw


class Gatekeeper(Fault):
    """How it treats those who knock."""

    def __init__(self, kind):
        self.kind, self.version, self.clients = kind, b"", 0

    def message(self, raw):
        self.version = raw if raw.startswith(b"VV\n00") else self.version
        return raw

    def accept(self, scanner, client):
        self.clients += 1
        if self.kind == "one only" and self.clients > 1 or self.kind == "every third" and self.clients % 3 == 0:
            time.sleep(0.02)
            return client.close()
        return scanner.serve_one(client, lambda: self.knocked(scanner))

    def knocked(self, scanner):
        """Somebody knocks while another is served."""
        if self.kind not in ("drops the first", "serves both"):
            return False
        try:
            scanner.listener.settimeout(0)
            other, _ = scanner.listener.accept()
        except (BlockingIOError, TimeoutError):
            return False
        finally:
            scanner.listener.settimeout(0.05)
        if self.kind == "serves both":
            other.sendall(self.version)
            self.other = other
            return False
        return True


class StaysUp(Fault):
    """Says that it reboots, and does not."""

    def begin(self):
        self.asked = 0

    def chunk(self, data):
        if data != b"RB\n":
            return data
        self.asked += 1
        self.wire.to_client(b"RB\n01Q\n\n" if self.asked % 2 else b"RB\n00P\n\n")
        return b""


class EveryFifth(Fault):
    """Leaves scans out, of all steps or of one."""

    def __init__(self, most_bytes=10**6, least_bytes=0):
        self.most, self.least, self.count = most_bytes, least_bytes, 0

    def message(self, raw):
        if Message(raw).status == SCAN and self.least <= len(raw) <= self.most:
            self.count += 1
            if self.count % 5 == 0:
                return b""
        return raw


class LateStart(Fault):
    """The first scan of a stream takes its time."""

    def message(self, raw):
        message = Message(raw)
        if raw.startswith(b"MD") and message.status == "00":
            self.begins = True
        elif message.status == SCAN and self.begins:
            self.begins = False
            time.sleep(0.6)
        return raw


class Glued(Fault):
    """The acknowledgement of a stream waits for its first scan."""

    def begin(self):
        self.held = b""

    def message(self, raw):
        if raw.startswith(b"MD") and Message(raw).status == "00":
            self.held = raw
            return b""
        held, self.held = self.held, b""
        return held + raw


def without_string(message):
    message.echo = message.echo.split(";")[0]


def other_id(message):
    message.echo = message.echo + "l"


def spoilt_after(count):
    met = itertools.count()

    def change(raw):
        return wrong_sum(5)(raw) if next(met) == count else raw
    return change


def of_half_length(message):
    message.lines[0] = message.lines[0][:-1]


def stuck_at_wrap():
    seen = []

    def change(stamp, _):
        seen.append(stamp)
        return stamp if stamp >= max(seen) else max(seen)
    return change


PROMISES = {
    "1.1": ("scip1", raw_changed("V", lambda raw: raw[:raw.rindex(b"STAT")] + b"\n")),
    "1.2": ("scip1", raw_changed("G.*", lambda raw: raw[:-4] + b"\n\n")),
    "1.3": ("scip1", raw_changed("QT", lambda raw: raw.replace(b"E\n", b"0\n"))),
    "1.4": ("scip1", raw_changed("SCIP2.0", lambda raw: raw.replace(b"\n0\n", b"\n1\n"))),

    "2.0": ("ust", answers("GD.*", None, "0E")),
    "2.1": ("ust", Change("VV", swapped)),
    "2.2": ("ust", says("PP", "CCW", "1")),
    "2.3": ("ust", says("II", "SBPS", None)),
    "2.4": ("ust", says("PP", "DMIN", "70000")),
    "2.5": ("ust", says("II", "MODL", "UST-11LX")),
    "2.6": ("ust", says("II", "LASR", "OFF")),
    "2.7": ("ust", says("II", "TIME", "12345")),
    "2.8": ("ust", says("II", "STAT", "Trouble!!")),
    "2.9": ("ust", says("VV", "PROT", "SCIP 1.0")),
    "2.10": ("ust", says("VV", "SERI", "H 1!")),
    "2.11": ("ust", says("VV", "VEND", "V" * 70)),
    "2.12": ("ust", with_counter()),
    "2.13": ("ust", says("VV", "FIRM", "(2011)")),
    "2.14": ("ust", says("II", "MESM", "Ready")),

    "3.1": ("ust", raw_changed("QT", wrong_sum(1))),
    "3.2": ("ust", raw_changed("VV", wrong_sum(3))),
    "3.3": ("ust", raw_changed("PP", wrong_sum(3))),
    "3.4": ("ust", raw_changed("II", wrong_sum(3))),
    "3.5": ("ust", raw_changed(GD, wrong_sum(4), "00")),
    "3.6": ("ust", Change("VV", other_id)),
    "3.7": ("ust", Change(GD, cut_at_32, "00")),
    "3.8": ("ust", Change(GD, lambda message: message.lines.append(""), "00")),
    "3.9": ("ust", raw_changed("VV", lambda raw: raw.replace(b"\n", b"\r\n"))),
    "3.10": ("ust", Change("GD9999999901", told("0000"))),
    "3.11": ("ust", raw_changed("VV", lambda raw: raw + b"XX\n00P\n\n")),

    "4.1": ("ust", answers(GD, "10", "0E")),
    "4.2": ("ust", answers("BM", "00", "01")),
    "4.3": ("ust", answers("BM", "02", "00")),
    "4.4": ("ust", answers(GD, "00", "10")),
    "4.5": ("ust", answers("QT", "00", "02")),
    "4.6": ("ust", answers("BM", "00", "02", nth=2)),
    "4.7": ("ew", Change("%ST", told("003"), "00")),
    "4.8": ("ew", Change("%ST", told("000"), "00")),
    "4.9": ("ew", Change("%ST", told("003"), "00")),
    "4.10": ("ew", Change("%ST", told("000"), "00")),
    "4.11": ("ust", answers("TM0", "00", "01")),
    "4.12": ("ust", answers("TM0", "02", "00")),
    "4.13": ("ust", Change("TM1", of_half_length)),
    "4.14": ("ust", answers("TM2", "00", "02")),
    "4.15": ("ust", answers("TM2", "03", "00")),
    "4.16": ("urg", answers("TM1", "04", "00")),
    "4.17": ("ust", answers("TM3", "01", "00")),
    "4.18": ("ust", answers("BM", "00", "02", nth=2)),
    "4.19": ("urg", answers("VV", "0E", "00")),
    "4.20": ("urg", answers("PP", "0E", "00")),
    "4.21": ("urg", answers("BM", "0E", "00")),
    "4.22": ("urg", answers(GD, "0E", "00")),
    "4.23": ("urg", answers(MD, "0E", "00")),
    "4.24": ("urg", answers("QT", "0E", "00")),

    "5.1": ("ust", lacks_a_value(GD)),
    "5.2": ("urg", lacks_a_value(r"GS\d+", 2)),
    "5.3": ("ust", lacks_a_value(r"GE\d+")),
    "5.4": ("ew", lacks_a_value(r"HD\d+")),
    "5.5": ("ew", lacks_a_value(r"HE\d+")),
    "5.6": ("ust", lacks_a_value(GD)),
    "5.7": ("ust", lacks_a_value(GD)),
    "5.8": ("ust", answers("GD1080108001", "00", "04")),
    "5.9": ("ust", Change(GD, first_value(200000), "00")),
    "5.10": ("ust", stamped(GD, lambda stamp, count: 5000)),
    "5.11": ("io", lacks_a_value(r"GF\d+")),
    "5.12": ("io", lacks_a_value(r"GG\d+")),

    "6.1": ("ust", raw_changed(MD, lambda raw: raw.replace(b"00P", b"00"), "00")),
    "6.2": ("ust", at_count("00")),
    "6.3": ("ust", OneMore("count")),
    "6.4": ("ust", at_count("01")),
    "6.5": ("ust", answers("BM", "02", "00")),
    "6.6": ("ust", OneMore("QT")),
    "6.7": ("ust", WithoutSkipping()),
    "6.8": ("ust", WithoutSkipping()),
    "6.9": ("urg", lacks_a_value(r"MS\d+", 2)),
    "6.10": ("ust", lacks_a_value(r"ME\d+")),
    "6.11": ("ew", lacks_a_value(r"ND\d+")),
    "6.12": ("ew", lacks_a_value(r"NE\d+")),
    "6.13": ("io", lacks_a_value(r"MF\d+")),
    "6.14": ("io", lacks_a_value(r"MG\d+")),
    "6.15": ("ust", raw_changed(MD, spoilt_after(6), SCAN)),
    "6.16": ("ust", DeafInStream(rb"VV")),
    "6.17": ("ust", DeafInStream(rb"MD\d+", b"\n00P\n\n")),
    "6.18": ("ust", says("II", "LASR", "OFF")),
    "6.19": ("ust", Change(MD + ";.*", without_string, SCAN)),
    "6.20": ("ust", answers_itself(b"RS")),

    "7.1": ("ust", lacks_a_value(r"GD\d{8}00")),
    "7.2": ("ust", lacks_a_value(r"GD\d{8}02")),
    "7.3": ("ust", lacks_a_value(r"GD\d{8}04")),
    "7.4": ("ust", lacks_a_value(r"GD\d{8}99")),
    "7.5": ("ust", lacks_a_value(r"GD\d{8}10")),
    "7.6": ("ust", lacks_a_value(r"GE\d{8}04")),
    "7.7": ("ew", lacks_a_value(r"HD\d{8}04")),
    "7.8": ("ust", lacks_a_value(r"MD\d{8}03\d{3}")),
    "7.9": ("ust", FarthestOfGroup()),

    "8.1": ("ust", Change(GD, of_half_length, "00")),
    "8.2": ("ust", Change("TM1", of_half_length)),
    "8.3": ("ust", stamped("TM1", lambda time, count: 100000 - 10 * count)),
    "8.4": ("ust", stamped("TM1", lambda time, count: 2 * time)),
    "8.5": ("ust", stamped(MD, lambda stamp, count: stamp + 5000)),
    "8.6": ("ust", Change("II", lambda message: of_texts(
        message.echo, {**message.texts(), "TIME": encoded(decoded(message.texts()["TIME"]) + 5000, 4)}))),
    "8.7": ("ust", stamped(MD, lambda stamp, count: stamp + 19)),  # as if at step 1080
    "8.8": ("wrap", stamped(MD, stuck_at_wrap())),
    "8.9": ("ust", Change("TM1;.*", without_string)),
    "8.10": ("us", Change("%TM1", of_half_length)),
    "8.11": ("us", Change(r"%MD\d+", of_half_length, SCAN)),
    "8.12": ("us", Change(r"%ME\d+", of_half_length, SCAN)),
    "8.13": ("ust", answers_itself(b"RS")),

    "9.1": ("ust", answers("XX", "0F", "00")),
    "9.2": ("ust", answers("vv", "0F", "00")),
    "9.3": ("ust", answers("MD", "0C", "00")),
    "9.4": ("ust", answers("VV1", "0D", "00")),
    "9.5": ("ust", answers("MD.*", "01", "02")),
    "9.6": ("ust", answers("MD.*", "02", "01")),
    "9.7": ("ust", answers("MD.*", "03", "01")),
    "9.8": ("ust", answers("MD.*", "06", "01")),
    "9.9": ("ust", answers("MD.*", "07", "01")),
    "9.10": ("ust", answers("MD.*", "04", "00")),
    "9.11": ("ust", answers("MD.*", "05", "00")),
    "9.12": ("ust", answers("QT;.*", "0G", "00")),
    "9.13": ("ust", answers("QT;.*", "0H", "00")),
    "9.14": ("ust", answers("QT;.*", "00", "0G")),
    "9.15": ("ust", answers("GD", "10", "0C")),
    "9.16": ("ust", SwitchesOn()),
    "9.17": ("ust", DiesOf(lambda data: len(data) > 250)),
    "9.18": ("ust", DiesOf(lambda data: b"\x01" in data)),
    "9.19": ("ust", answers("SCIP2.0", "0F", "10")),
    "9.20": ("ust", answers("HD", "0F", "10")),

    "10.1": ("ust", raw_changed("VV", lambda raw: raw + raw)),
    "10.2": ("ust", Chunk(lambda data, wire: data.replace(b"\r", b""))),
    "10.3": ("ust", Chunk(lambda data, wire: data.replace(b"VV\r\n", b"VV\nVV\n"))),
    "10.4": ("ust", Chunk(answers_empty_lines)),
    "10.5": ("ust", Chunk(lambda data, wire: data if data.endswith(b"\n") else data + b"\n")),
    "10.6": ("ust", Chunk(lambda data, wire: data if data.endswith(b"\n") else data + b"\n")),

    "11.1": ("ust", OutOfOrder()),
    "11.2": ("ust", OutOfOrder()),
    "11.3": ("ust", drops_behind(rb"VV", rb"VV")),
    "11.4": ("ust", drops_behind(rb"MD", rb"VV")),
    "11.5": ("ust", drops_behind(rb"QT", rb"GD")),
    "11.6": ("ust", drops_behind(rb"MD", rb"QT")),

    "12.1": ("ust", Gatekeeper("drops the first")),
    "12.2": ("ust", Gatekeeper("serves both")),
    "12.3": ("ust", Gatekeeper("one only")),
    "12.4": ("ust", LeavesForNext("stream")),
    "12.5": ("ust", Gatekeeper("every third")),
    "12.6": ("ust", LeavesForNext("half")),

    "13.1": ("ust", stamped(MD, lambda stamp, count: stamp + 3 * count, SCAN)),
    "13.2": ("ust", EveryFifth(most_bytes=200)),
    "13.3": ("ust", EveryFifth(least_bytes=200)),
    "13.4": ("ust", late(MD, 0.04, SCAN)),
    "13.5": ("ust", late("QT", 0.2)),
    "13.6": ("ust", late("PP", 0.2)),
    "13.7": ("ust", late("TM1", 0.15)),
    "13.8": ("ust", late(GD, 0.6, "00")),
    "13.9": ("ust", LateStart()),
    "13.10": ("ust", Glued()),

    "14.1": ("ust", answers("RT", "00", "0L")),
    "14.2": ("urg", answers(r"SS\d+", "03", "00")),
    "14.3": ("urg", answers(r"SS\d+", "02", "00")),
    "14.4": ("urg", answers("CR02", "03", "00")),
    "14.5": ("urg", answers("HS1", "02", "00")),
    "14.6": ("urg", answers("DB10", "03", "00")),
    "14.7": ("ust", Change("%ST", told("000"), "00")),
    "14.8": ("ust", answers("RB", "01", "00")),
    "14.9": ("ust", StaysUp()),
}
