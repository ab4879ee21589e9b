# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Recordings as others write them, made of bytes by the formats' public descriptions alone."""
import bz2
import itertools
import sqlite3
import struct
import zlib

BEGIN_S = 1_700_000_000


def ros1_scan(stamp_ns, ranges, intensities=(), fan_rad=(-1.5, 0.25), limits_m=(0.02, 30)):
    """sensor_msgs/LaserScan as ROS 1 serializes it. A fan is its first angle and the one between two ranges."""
    frame = b"laser"
    head = struct.pack("<III", 1, stamp_ns // 10**9, stamp_ns % 10**9) + struct.pack("<I", len(frame)) + frame
    first, step = fan_rad
    return head + struct.pack("<7f", first, first + (len(ranges) - 1) * step, step, 0, 0.025, *limits_m) \
        + struct.pack(f"<I{len(ranges)}f", len(ranges), *ranges) \
        + struct.pack(f"<I{len(intensities)}f", len(intensities), *intensities)


def cdr_scan(stamp_ns, ranges, intensities=(), order="<"):
    """The same in CDR, as ROS 2 does; `order` tells which end comes first."""
    frame = b"laser\0"
    body = struct.pack(order + "iI", stamp_ns // 10**9, stamp_ns % 10**9) + struct.pack(order + "I", len(frame)) + frame
    body += bytes(-len(body) % 4)
    body += struct.pack(order + "7f", -1.5, 1.5, 0.25, 0, 0.025, 0.02, 30)
    body += struct.pack(f"{order}I{len(ranges)}f", len(ranges), *ranges)
    body += struct.pack(f"{order}I{len(intensities)}f", len(intensities), *intensities)
    return (b"\0\1\0\0" if order == "<" else b"\0\0\0\0") + body


def cdr_multi_echo(stamp_ns, steps):
    """sensor_msgs/MultiEchoLaserScan: the ranges of each step."""
    frame = b"laser\0"
    body = struct.pack("<iI", stamp_ns // 10**9, stamp_ns % 10**9) + struct.pack("<I", len(frame)) + frame
    body += bytes(-len(body) % 4) + struct.pack("<7f", -1.5, 1.5, 0.25, 0, 0.025, 0.02, 30)
    body += struct.pack("<I", len(steps))
    for ranges in steps:
        body += struct.pack(f"<I{len(ranges)}f", len(ranges), *ranges)
    return b"\0\1\0\0" + body + struct.pack("<I", 0)


def bag_record(fields, data):
    head = b"".join(struct.pack("<I", len(name) + 1 + len(value)) + name.encode() + b"=" + value
                    for name, value in fields.items())
    return struct.pack("<I", len(head)) + head + struct.pack("<I", len(data)) + data


def bag(chunks, pack="none"):
    """A bag of ROS 1 without its index, as a recorder that was killed leaves it. A chunk is a list of
    (topic, type, time in ns, message)."""
    known = {}
    text = b"#ROSBAG V2.0\n" + bag_record(
        {"op": b"\x03", "index_pos": bytes(8), "conn_count": bytes(4), "chunk_count": bytes(4)}, b" " * 4027)
    for chunk in chunks:
        data = b""
        for topic, kind, time, message in chunk:
            if topic not in known:
                known[topic] = len(known)
                about = b"".join(struct.pack("<I", len(field)) + field
                                 for field in (b"topic=" + topic.encode(), b"type=" + kind.encode()))
                data += bag_record({"op": b"\x07", "conn": struct.pack("<I", known[topic]),
                                    "topic": topic.encode()}, about)
            data += bag_record({"op": b"\x02", "conn": struct.pack("<I", known[topic]),
                                "time": struct.pack("<II", time // 10**9, time % 10**9)}, message)
        packed = bz2.compress(data) if pack == "bz2" else data
        text += bag_record({"op": b"\x05", "compression": pack.encode(), "size": struct.pack("<I", len(data))}, packed)
    return text


def db3(path, topics, messages, index=True, wal=False):
    """A bag of rosbag2: topics (name, type), messages (index of the topic, time in ns, bytes)."""
    with sqlite3.connect(path) as database:
        if wal:
            database.execute("PRAGMA journal_mode=WAL")
        database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
                         "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
        database.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
                         "timestamp INTEGER NOT NULL, data BLOB NOT NULL)")
        if index:
            database.execute("CREATE INDEX timestamp_idx ON messages (timestamp ASC)")
        for number, (name, kind) in enumerate(topics, 1):
            database.execute("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')", (number, name, kind))
        for topic, time, data in messages:
            database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", (topic + 1, time, data))
    database.close()


def metadata(parts):
    """The metadata.yaml of rosbag2, as far as it names files."""
    return "rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths:\n" \
        + "".join(f"    - {part}\n" for part in parts)


def stored_zstd(data):
    """A frame of Zstandard (RFC 8878) whose blocks are not packed."""
    text = b"\x28\xb5\x2f\xfd\xa0" + struct.pack("<I", len(data))
    for begin in range(0, len(data), 1 << 17):
        piece = data[begin:begin + (1 << 17)]
        last = begin + len(piece) == len(data)
        text += struct.pack("<I", last | len(piece) << 3)[:3] + piece
    return text


def mcap_record(opcode, content):
    return struct.pack("<BQ", opcode, len(content)) + content


def mcap_text(text):
    return struct.pack("<I", len(text)) + text.encode()


def mcap(chunks):
    """An MCAP file of ROS 2 without a summary: its chunks are lists of (time in ns, message of /scan). The first one
    that is written describes the channel."""
    text = b"\x89MCAP0\r\n" + mcap_record(1, mcap_text("ros2") + mcap_text("a test"))
    about = mcap_record(3, struct.pack("<H", 1) + mcap_text("sensor_msgs/msg/LaserScan") + mcap_text("ros2msg") +
                        bytes(4))
    about += mcap_record(4, struct.pack("<HH", 7, 1) + mcap_text("/scan") + mcap_text("cdr") + bytes(4))
    for chunk in chunks:
        records = about + b"".join(mcap_record(5, struct.pack("<HIQQ", 7, 0, time, time) + message)
                                   for time, message in chunk)
        times = [time for time, _ in chunk]
        text += mcap_record(6, struct.pack("<QQQI", min(times), max(times), len(records), zlib.crc32(records))
                            + bytes(4) + struct.pack("<Q", len(records)) + records)
        about = b""
    return text + mcap_record(15, bytes(4)) + mcap_record(2, bytes(20)) + b"\x89MCAP0\r\n"


def summed(line):
    return line + chr((sum(line.encode()) & 0x3F) + 0x30)


def encoded(value, width):
    return "".join(chr((value >> 6 * i & 0x3F) + 0x30) for i in reversed(range(width)))


def scip_talk(scans):
    """A conversation of a client with a scanner of five steps: (to the scanner?, bytes) each."""
    def answer(request, *lines):
        return "\n".join([request, summed("00"), *lines]) + "\n\n"

    def entries(*texts):
        return [text + ";" + summed(text)[-1] for text in texts]

    yield True, b"VV\n"
    yield False, answer("VV", *entries("VEND:Maker", "PROD:Scanner", "FIRM:1.0", "PROT:SCIP 2.0", "SERI:A1")).encode()
    yield True, b"PP\n"
    yield False, answer("PP", *entries("MODL:UST-10LX", "DMIN:20", "DMAX:30000", "ARES:1440", "AMIN:0", "AMAX:1080",
                                       "AFRT:540", "SCAN:2400")).encode()
    yield True, b"MD0538054201000\n"
    yield False, answer("MD0538054201000").encode()
    for number, ranges in enumerate(scans):
        data = "".join(encoded(mm, 3) for mm in ranges)
        yield False, "\n".join(["MD0538054201000", summed("99"), summed(encoded(1000 + 25 * number, 4)),
                                summed(data), "", ""]).encode()


class Network:
    """Packets of one TCP connection between a client and a scanner, over Ethernet and IPv4."""
    CLIENT, SCANNER = (b"\x0a\0\0\2", 50000), (b"\x0a\0\0\1", 10940)

    def __init__(self):
        self.packets = []
        self.sequence = {True: 100, False: 0xFFFFFF00}  # wraps soon
        self.times = itertools.count(0, 1_000_000)

    def packet(self, to_scanner, payload, flags=0x18, sequence=None):
        source, target = (self.CLIENT, self.SCANNER) if to_scanner else (self.SCANNER, self.CLIENT)
        number = self.sequence[to_scanner] if sequence is None else sequence
        tcp = struct.pack(">HHIIBBHHH", source[1], target[1], number & 0xFFFFFFFF, 0, 0x50, flags, 0, 0, 0) + payload
        ip = struct.pack(">BBHHHBBH", 0x45, 0, 20 + len(tcp), 0, 0x4000, 64, 6, 0) + source[0] + target[0] + tcp
        frame = bytes(12) + b"\x08\0" + ip
        self.packets.append((next(self.times), frame + bytes(max(0, 60 - len(frame)))))

    def open(self):
        self.packet(True, b"", 0x02, self.sequence[True] - 1)
        self.packet(False, b"", 0x12, self.sequence[False] - 1)

    def send(self, to_scanner, data, piece=1000):
        for begin in range(0, len(data), piece):
            self.packet(to_scanner, data[begin:begin + piece])
            self.sequence[to_scanner] += len(data[begin:begin + piece])


def pcap(packets):
    head = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 1)
    return head + b"".join(
        struct.pack("<IIII", BEGIN_S + time // 10**9, time % 10**9 // 1000, len(frame), len(frame)) + frame
        for time, frame in packets)


def pcapng(packets):
    def block(kind, body):
        body += bytes(-len(body) % 4)
        size = 12 + len(body)
        return struct.pack("<II", kind, size) + body + struct.pack("<I", size)

    text = block(0x0A0D0D0A, struct.pack("<IHHq", 0x1A2B3C4D, 1, 0, -1))
    text += block(1, struct.pack("<HHI", 1, 0, 65535))
    for time, frame in packets:
        us = BEGIN_S * 10**6 + time // 1000
        text += block(6, struct.pack("<IIIII", 0, us >> 32, us & 0xFFFFFFFF, len(frame), len(frame)) + frame)
    return text
