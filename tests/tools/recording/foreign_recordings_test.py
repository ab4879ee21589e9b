#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""What scipcat finds in recordings that others have written: foreign_recordings_test.py SCIPCAT"""
import json
import math
import pathlib
import random
import re
import resource
import struct
import subprocess
import sys
import tempfile
import unittest

import foreign_files as foreign

SCIPCAT = sys.argv.pop(1)
SCAN = "sensor_msgs/LaserScan"
NS = foreign.BEGIN_S * 10**9


class OfFiles(unittest.TestCase):
    """With a folder for them, and what scipcat says of one."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def path(self, name, data=None):
        if data is not None:
            (self.folder / name).write_bytes(data)
        return self.folder / name

    def info(self, *paths):
        done = subprocess.run([SCIPCAT, "info", "--json", *map(str, paths)], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def laser_db3(self, name, times, **how):
        path = self.path(name)
        foreign.db3(path, [("/scan", "sensor_msgs/msg/LaserScan")],
                    [(0, time, foreign.cdr_scan(time, [1, 2])) for time in times], **how)
        return path

    def refused(self, path):
        done = subprocess.run([SCIPCAT, "info", str(path)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2, done.stdout)
        return done.stderr


class Bags(OfFiles):
    def test_bags_of_ros_1(self):
        for pack in ("none", "bz2"):
            chunks = [[("/scan", SCAN, NS, foreign.ros1_scan(NS, [1, 2, 3], [7, 8, 9])),
                       ("/tf", "tf/tfMessage", NS, b"....")],
                      [("/scan", SCAN, NS, foreign.ros1_scan(NS + 25_000_000, [1, 2, 3], [7, 8, 9]))]]
            info = self.info(self.path("a.bag", foreign.bag(chunks, pack)))
            self.assertEqual((info["format"], info["scans"], info["steps"]), ("bag", 2, 3))
            self.assertEqual((info["intensities"], info["codes"], info["device"]["dmax_mm"]), (True, False, 30000))
            self.assertAlmostEqual(info["seconds"], 0.025)
            self.assertEqual([stream["name"] for stream in info["streams"]], ["/scan"])
            self.assertRegex(info["warnings"][0], r"left out, .*: /tf \(tf/tfMessage\)$")

    def test_a_bag_that_was_cut_off(self):
        chunks = [[("/scan", SCAN, NS, foreign.ros1_scan(NS + i, [1, 2, 3]))] for i in range(3)]
        whole = foreign.bag(chunks)
        beginning = len(foreign.bag([]))
        ends = [len(foreign.bag(chunks[:count])) for count in range(4)]
        for size in range(beginning, len(whole), 7):
            info = self.info(self.path("cut.bag", whole[:size]))
            self.assertEqual(info["scans"], sum(end <= size for end in ends[1:]))
            if size not in ends:
                self.assertIn("ends within the record at byte", info["warnings"][0])

    def test_a_bag_that_is_damaged(self):
        chunks = [[("/scan", SCAN, NS, foreign.ros1_scan(NS, [1, 2, 3]))]]
        whole = bytearray(foreign.bag(chunks, "bz2"))
        whole[-30] ^= 0xFF
        self.assertRegex(self.refused(self.path("a.bag", whole)),
                         r"a\.bag: byte \d+: the chunk of \d+ bytes is no sound bzip2")

    def test_bags_by_rosbag_itself(self):
        writer = pathlib.Path(__file__).with_name("rosbag_files.py")
        # Debian's modules are those of Debian's own Python.
        for python in (sys.executable, "/usr/bin/python3"):
            if subprocess.run([python, writer, self.folder], check=False).returncode == 0:
                break
        else:
            self.skipTest("there is no python3-rosbag")
        for pack in ("none", "bz2", "lz4"):
            info = self.info(self.path(f"{pack}.bag"))
            self.assertEqual((info["scans"], info["steps"], info["warnings"]), (100, 301, []))
            self.assertAlmostEqual(info["seconds"], 99 * 0.005)
        self.in_order(self.info(self.path("disordered.bag")), 100, 0.005)
        self.in_order(self.info(*(self.path(f"split_{part}.bag") for part in (0, 2, 1))), 60, 0.005)
        self.damaged_bags()

    def damaged_bags(self):
        """Of some scans in each chunk, and a record of an index behind it."""
        whole = self.path("bz2.bag").read_bytes()
        chunks = [found.start() for found in re.finditer(b"compression=bz2", whole)]
        changed = bytearray(whole)
        changed[chunks[2] + 200] ^= 0x7F
        info = self.info(self.path("a.bag", changed))
        (gap,) = info["gaps"]
        self.assertAlmostEqual(gap["seconds"], 0.005 * (101 - info["scans"]))
        self.assertIn(info["scans"], range(85, 98))
        self.assertRegex(info["warnings"][0],
                         r"a\.bag: byte \d+: the chunk of \d+ bytes is no sound bzip2; it is left out")

        # Some recorders of 2010 wrote wrong sizes into their indexes.
        changed = bytearray(whole)
        for size in self.sizes_of_indexes(whole):
            changed[size:size + 4] = struct.pack("<I", 4)
        self.assertNotEqual(changed, whole)
        info = self.info(self.path("b.bag", changed))
        self.assertEqual((info["scans"], info["warnings"]), (100, []))

    @staticmethod
    def sizes_of_indexes(bag):
        """Where the sizes of the records are that index a chunk."""
        byte = len(b"#ROSBAG V2.0\n")
        while byte < len(bag):
            (header,) = struct.unpack_from("<I", bag, byte)
            (data,) = struct.unpack_from("<I", bag, byte + 4 + header)
            if b"op=\4" in bag[byte + 4:byte + 4 + header]:
                yield byte + 4 + header
            byte += 8 + header + data

    def in_order(self, info, scans, period_s):
        self.assertEqual((info["scans"], info["warnings"], info["gaps"]), (scans, [], []))
        self.assertAlmostEqual(info["seconds"], (scans - 1) * period_s)

    def test_bags_of_ros_1_out_of_order(self):
        times = [NS + 10**8 * number for number in (4, 5, 7, 6, 0, 1, 3, 2, 9, 8)]
        messages = [("/scan", SCAN, time, foreign.ros1_scan(time, [1, 2, 3])) for time in times]
        # Without an index, and in one chunk and several.
        for chunks in ([messages], [messages[:4], messages[4:6], messages[6:]], [[one] for one in messages]):
            self.in_order(self.info(self.path("a.bag", foreign.bag(chunks))), 10, 0.1)

    def test_codes_in_metres(self):
        """What stands for no distance is one class; the codes of a URG are theirs again."""
        ranges = [1.5, 0.0, 0.001, math.nan, math.inf, 65.533, 0.006, 0.006, 0.019, 2.5]
        scans = [("/scan", SCAN, time, foreign.ros1_scan(time, ranges)) for time in (NS, NS + 10**8)]
        info = self.info(self.path("a.bag", foreign.bag([scans])))
        self.assertEqual(info["no_distance"], {"no distance": 0.5, "6": 0.2, "19": 0.1})
        self.assertTrue(info["codes"])
        text = subprocess.run([SCIPCAT, "info", str(self.path("a.bag"))], capture_output=True, text=True, check=True)
        self.assertIn("metres with the scanner's codes\n  codes       no distance: 50 %, 6: 20 %, 19: 10 %\n",
                      text.stdout)

    def test_what_a_replay_would_be(self):
        def replays_as(fan_rad, count, limits_m):
            scans = [("/scan", SCAN, NS + 25 * 10**6 * number,
                      foreign.ros1_scan(NS + 25 * 10**6 * number, [1] * count, fan_rad=fan_rad, limits_m=limits_m))
                     for number in (0, 1)]
            return self.info(self.path("a.bag", foreign.bag([scans])))["replays_as"]

        degree = math.pi / 180
        self.assertEqual(replays_as((-135 * degree, degree / 4), 1081, (0.02, 30)), {"model": "UST-10LX", "why": None})
        lds = replays_as((0, degree), 360, (0.12, 3.5))
        self.assertEqual(lds["model"], "recorded")
        self.assertRegex(lds["why"], r"^the nearest product, U[-\w]+, has .* deg instead of 0 to 359 deg")
        far = replays_as((-95 * degree, 0.5 * degree), 381, (0.05, 80))
        self.assertEqual(far["model"], "recorded")
        self.assertRegex(far["why"], r"m instead of 0\.05 to 80 m$")

    def test_equal_scans_with_stamps_of_their_own(self):
        """As those of a simulation without noise."""
        def bag(name, step_ns):
            messages = [("/scan", SCAN, NS + number, foreign.ros1_scan(NS + number * step_ns, [1, 2, 3] * 4))
                        for number in range(8)]
            return self.path(name, foreign.bag([messages + [("/tf", "tf/tfMessage", NS, b"....")]]))

        def compared(one, other):
            return subprocess.run([SCIPCAT, "compare", str(one), str(other), "--json"], capture_output=True, text=True,
                                  check=False)

        same = compared(bag("a.bag", 25 * 10**6), bag("b.bag", 25 * 10**6))
        self.assertRegex(same.stderr, r"(?m)^/.*/a\.bag: left out, .*: /tf \(tf/tfMessage\)$")
        sides = json.loads(same.stdout)
        self.assertEqual([(sides[side]["scans"], sides[side]["doubles"]) for side in "ab"], [(8, 0), (8, 0)])
        self.assertIn("b.bag has 1 scan; at least 4", compared(bag("a.bag", 25 * 10**6), bag("b.bag", 0)).stderr)

    def test_the_old_format_of_bags(self):
        told = self.refused(self.path("a.bag", b"#ROSRECORD V1.2\n" + bytes(100)))
        self.assertRegex(told, r"a\.bag: is a bag of ROS of the old format 1 .*: rosbag migrate")

    def test_mcap_out_of_order(self):
        scans = [(NS + 10**8 * number, foreign.cdr_scan(NS + 10**8 * number, [1, 2])) for number in range(30)]
        swapped = [scans[number ^ 1] for number in range(30)]
        for chunks in ([scans[10:20], scans[:10], scans[20:]], [swapped[10:], swapped[:10]], [scans[::2], scans[1::2]]):
            self.in_order(self.info(self.path("a.mcap", foreign.mcap(chunks))), 30, 0.1)

    def test_mcap_with_a_damaged_chunk(self):
        scans = [(NS + 10**8 * number, foreign.cdr_scan(NS + 10**8 * number, [1, 2])) for number in range(30)]
        whole = bytearray(foreign.mcap([scans[:10], scans[10:20], scans[20:]]))
        second = len(foreign.mcap([scans[:10]])) - (9 + 4 + 9 + 20 + 8)  # before DataEnd, Footer and magic
        whole[second + 200] ^= 1
        info = self.info(self.path("a.mcap", whole))
        self.assertEqual((info["scans"], [gap["after_scan"] for gap in info["gaps"]]), (20, [10]))
        self.assertRegex(info["warnings"][0],
                         rf"byte {second}: the chunk of \d+ bytes is damaged: its checksum is wrong")

    def test_bags_of_ros_2(self):
        path = self.path("a.db3")
        foreign.db3(path, [("/scan", "sensor_msgs/msg/LaserScan"), ("/odom", "nav_msgs/msg/Odometry"),
                           ("/most", "sensor_msgs/msg/MultiEchoLaserScan")],
                    [(0, NS, foreign.cdr_scan(NS, [1, 2])), (1, NS, b"x"),
                     (0, NS, foreign.cdr_scan(NS + 10**8, [1, 2], order=">")),
                     (2, NS, foreign.cdr_multi_echo(NS, [[1, 2], [], [3]]))])
        info = self.info(path)
        self.assertEqual(info["format"], "db3")
        self.assertEqual([(s["name"], s["scans"], s["steps"], s["echoes"]) for s in info["streams"]],
                         [("/scan", 2, 2, False), ("/most", 1, 3, True)])
        self.assertRegex(info["warnings"][0], r"/odom \(nav_msgs/msg/Odometry\)$")

    def test_a_database_of_others(self):
        path = self.path("a.db3")
        foreign.sqlite3.connect(path).execute("CREATE TABLE songs(name TEXT)").connection.close()
        self.assertIn("is no bag of rosbag2: no such table: topics", self.refused(path))

    def test_rows_out_of_order(self):
        times = [NS + 10**8 * number for number in (4, 5, 7, 6, 0, 1, 3, 2, 9, 8)]
        for index in (True, False):
            self.in_order(self.info(self.laser_db3(f"{index}.db3", times, index=index)), 10, 0.1)

    def test_times_of_scans_without_a_stamp(self):
        """The stamps are of a simulation's clock, and one is missing."""
        path = self.path("a.db3")
        foreign.db3(path, [("/scan", "sensor_msgs/msg/LaserScan")],
                    [(0, NS + 10**8 * number, foreign.cdr_scan(0 if number == 5 else (50 + number) * 10**8, [1, 2]))
                     for number in range(10)])
        info = self.info(path)
        self.in_order(info, 10, 0.1)
        self.assertEqual(info["times"], {"stamped": 9, "logged": 1})

    def test_what_goes_back_in_time_is_told(self):
        path = self.path("a.jsonl", b"".join(b'{"host_time_s": %d, "distances_mm": [1]}\n' % time
                                                  for time in (5, 6, 3, 4)))
        info = self.info(path)
        self.assertEqual((info["seconds"], info["times"]), (2, {"stamped": 0, "logged": 0}))
        self.assertRegex(info["warnings"][0], "the times of its scans go back 1 times, first at scan 3")

    def test_a_long_bag(self):
        path = self.laser_db3("a.db3", [NS])
        with foreign.sqlite3.connect(path) as database:
            database.execute("INSERT INTO topics VALUES(2, '/odom', 'nav_msgs/msg/Odometry', 'cdr', '')")
            database.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES(2, ?, 'x')",
                                 ((NS + number,) for number in range(2_000_000)))
            database.execute("INSERT INTO messages SELECT NULL, 1, ?, data FROM messages WHERE id = 1", (NS + 10**9,))
        database.close()
        self.assertEqual(self.info(path)["scans"], 2)

    def test_a_db3_that_was_cut_off(self):
        whole = self.laser_db3("a.db3", [NS + 10**8 * number for number in range(2000)]).read_bytes()
        info = self.info(self.path("cut.db3", whole[:len(whole) // 2]))
        self.assertTrue(500 < info["scans"] < 1500, info["scans"])
        self.assertAlmostEqual(info["seconds"], 0.1 * info["scans"], delta=5)  # a page was cut through
        self.assertIn(f"lacks {len(whole) - len(whole) // 2} bytes at its end", " ".join(info["warnings"]))

    def test_a_view_in_place_of_the_messages(self):
        path = self.laser_db3("a.db3", [])
        with foreign.sqlite3.connect(path) as database:
            database.executescript("DROP TABLE messages; CREATE VIEW messages AS WITH RECURSIVE rows(id) AS "
                                   "(SELECT 1 UNION ALL SELECT id + 1 FROM rows) "
                                   "SELECT id, 9 AS topic_id, 1 AS timestamp, '' AS data FROM rows")
        database.close()
        self.assertIn("is no bag of rosbag2: its messages are no plain table", self.refused(path))

    def test_write_ahead_logs(self):
        """What SQLite writes beside a file in WAL mode, if it may."""
        times = [NS + 10**8 * number for number in range(10)]
        path = self.laser_db3("a.db3", times, wal=True)
        writer = foreign.sqlite3.connect(path)
        writer.execute("INSERT INTO messages SELECT NULL, 1, timestamp + 1000000000, data FROM messages WHERE id = 1")
        writer.commit()
        killed = self.folder / "killed"
        killed.mkdir()
        for name in ("a.db3", "a.db3-wal"):
            (killed / name).write_bytes((self.folder / name).read_bytes())
        self.assertEqual(self.info(killed / "a.db3")["scans"], 11)
        self.assertEqual(self.info(path)["scans"], 11)  # while it is written
        writer.close()
        self.assertEqual(self.info(path)["scans"], 11)
        self.assertEqual([sorted(file.name for file in folder.glob("a*")) for folder in (self.folder, killed)],
                         [["a.db3"], ["a.db3", "a.db3-wal"]])

    def test_bags_in_a_folder(self):
        parts = []
        for part in range(12):
            times = [NS + 10**8 * (5 * part + number) for number in range(5)]
            parts.append(self.path(f"drive_{part}.mcap", foreign.mcap([[(time, foreign.cdr_scan(time, [1, 2]))
                                                                         for time in times]])))
        self.in_order(self.info(self.folder), 60, 0.1)
        self.in_order(self.info(*reversed(parts)), 60, 0.1)
        for part in parts[::2]:
            self.path(part.name + ".zstd", foreign.stored_zstd(part.read_bytes()))
            part.unlink()
        self.path("metadata.yaml", foreign.metadata(f"drive/{part.name}" for part in parts).encode())
        self.in_order(self.info(self.folder), 60, 0.1)
        parts[3].unlink()
        parts[5].write_bytes(b"")
        info = self.info(self.folder)
        self.assertEqual((info["scans"], [gap["after_scan"] for gap in info["gaps"]]), (50, [15, 20]))
        self.assertRegex(info["warnings"][0], r"drive_3\.mcap: there is no such file, but metadata\.yaml names it")
        self.assertRegex(info["warnings"][1], r"drive_5\.mcap: is empty")
        self.assertIn("drive_3.mcap: there is no such file",
                      self.refused(f"{self.folder / parts[1]}+{self.folder / parts[3]}"))

    def test_whole_files_and_messages_that_are_packed(self):
        path = self.path("a.db3")
        foreign.db3(path, [("/scan", "sensor_msgs/msg/LaserScan")],
                    [(0, NS + 10**8 * number, foreign.stored_zstd(foreign.cdr_scan(NS + 10**8 * number, [1, 2])))
                     for number in range(10)])
        self.in_order(self.info(path), 10, 0.1)
        self.in_order(self.info(self.path("a.db3.zstd", foreign.stored_zstd(path.read_bytes()))), 10, 0.1)
        self.assertIn("is zstd that was cut off",
                      self.refused(self.path("b.db3.zstd", foreign.stored_zstd(path.read_bytes())[:-9])))

    def test_a_message_that_is_damaged(self):
        path = self.path("a.db3")
        foreign.db3(path, [("/scan", "sensor_msgs/msg/LaserScan")], [(0, NS, foreign.cdr_scan(NS, [1, 2])[:-5])])
        self.assertIn("message 1: '/scan': the message ends before its last field", self.refused(path))


class Captures(OfFiles):
    SCANS = [[1000, 1, 65533, 7, 30000][:5] for _ in range(8)]

    def check(self, info, scans=8):
        self.assertEqual((info["format"], info["scans"], info["steps"], info["codes"]), ("pcap", scans, 5, True))
        self.assertEqual((info["device"]["model"], info["device"]["serial"]), ("UST-10LX", "A1"))
        self.assertEqual(info["streams"][0]["name"], "10.0.0.1:10940 with 10.0.0.2:50000")

    def talk(self, network, piece=1000):
        network.open()
        for to_scanner, data in foreign.scip_talk(self.SCANS):
            network.send(to_scanner, data, piece)

    def test_both_formats(self):
        network = foreign.Network()
        self.talk(network)
        self.check(self.info(self.path("a.pcap", foreign.pcap(network.packets))))
        self.check(self.info(self.path("a.pcapng", foreign.pcapng(network.packets))))

    def test_segments_that_come_twice_or_late(self):
        chance = random.Random(7)
        network = foreign.Network()
        self.talk(network, 11)
        head, rest = network.packets[:2], network.packets[2:]
        rest += chance.sample(rest, len(rest) // 3)
        late = sorted(enumerate(rest), key=lambda one: one[0] + chance.uniform(0, 6))
        self.check(self.info(self.path("a.pcap", foreign.pcap(head + [packet for _, packet in late]))))

    def test_segments_that_the_capture_lacks(self):
        network = foreign.Network()
        self.talk(network)
        del network.packets[-3]
        info = self.info(self.path("a.pcap", foreign.pcap(network.packets)))
        self.check(info, 7)
        self.assertIn("the capture lacks", info["warnings"][0])

    def test_a_conversation_in_scip_1(self):
        network = foreign.Network()
        network.open()
        network.send(True, b"V\nG00000501\n")
        network.send(False, b"V\n0\nVEND:Maker\nPROD:Scanner\nFIRM:2.1\nPROT:3\nSERI:B7\nSTAT:Good\n\n")
        # 20, 64, 4095, 0, 7 and 1000 mm in two characters each; the second is cut, the third is refused.
        network.send(False, b"G00000501\n0\n0D10oo0007?X\n\n")
        network.send(False, b"G00000501\n0\n0D10oo\n\nG00000501\nE\n\n")
        info = self.info(self.path("a.pcap", foreign.pcap(network.packets)))
        self.assertEqual((info["scans"], info["steps"], info["device"]["serial"], info["device"]["firmware"]),
                         (1, 6, "B7", "2.1"))

    def test_a_conversation_of_others(self):
        network = foreign.Network()
        network.open()
        network.send(True, b"GET / HTTP/1.1\r\n\r\n")
        network.send(False, b"HTTP/1.1 200 OK\r\n\r\nhello\n\n")
        info = self.info(self.path("a.pcap", foreign.pcap(network.packets)))
        self.assertEqual((info["scans"], info["streams"]), (0, []))

    def test_a_capture_that_was_cut_off(self):
        network = foreign.Network()
        self.talk(network)
        whole = foreign.pcap(network.packets)
        for size in range(24, len(whole), 13):
            self.assertLessEqual(self.info(self.path("a.pcap", whole[:size]))["scans"], 8)
        self.assertIn("is no capture of a network", self.refused(self.path("a.pcap", whole[:20])))


class Hostile(OfFiles):
    """Small files that would cost much: each is refused or read, and no part of it costs the square of another."""

    def bounded(self, *paths):
        """What scipcat says within a minute of a processor, and its status."""
        def bound():
            resource.setrlimit(resource.RLIMIT_CPU, (60, 60))
        done = subprocess.run([SCIPCAT, "info", "--json", *map(str, paths)], capture_output=True, text=True,
                              check=False, preexec_fn=bound)
        self.assertIn(done.returncode, (0, 2), done.stderr)
        return json.loads(done.stdout) if done.returncode == 0 else done.stderr

    def test_an_index_of_damaged_records(self):
        """Where the next chunk begins is looked up for each of them."""
        count = 100_000
        text = b"\x89MCAP0\r\n" + foreign.mcap_record(1, bytes(8))
        begin = len(text)
        text += (struct.pack("<BQ", 0, 1 << 40) + bytes(31)) * count + foreign.mcap_record(15, bytes(4))
        index = len(text)
        text += b"".join(foreign.mcap_record(8, struct.pack("<QQQ", NS, NS, begin + 40 * number) + bytes(44))
                         for number in range(count))
        text += foreign.mcap_record(2, struct.pack("<QQI", index, 0, 0)) + b"\x89MCAP0\r\n"
        self.assertIn(f"byte {begin}: the record here is damaged", self.bounded(self.path("a.mcap", text)))

    def test_blocks_that_make_much(self):
        """Frames of Zstandard that make 128 kB of four bytes."""
        block = struct.pack("<I", 1 << 1 | (1 << 17) << 3)[:3] + b"\0"
        frame = b"\x28\xb5\x2f\xfd\x00\x58" + block * 2000 + b"\1\0\0"
        chunk = foreign.mcap_record(6, struct.pack("<QQQI", NS, NS, 2000 << 17, 0) + foreign.mcap_text("zstd") +
                                    struct.pack("<Q", len(frame)) + frame)
        text = b"\x89MCAP0\r\n" + foreign.mcap_record(1, bytes(8))
        self.assertRegex(self.bounded(self.path("a.mcap", text + chunk * 500)),
                         r"byte 25: the chunk of \d+ bytes makes more than 67108864 bytes")

    def test_many_damaged_parts(self):
        path = self.laser_db3("a.db3", [NS])
        with foreign.sqlite3.connect(path) as database:
            database.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES(1, ?, 'x')",
                                 ((NS + number + 1,) for number in range(20_000)))
        database.close()
        info = self.bounded(path)
        self.assertEqual((info["scans"], len(info["warnings"])), (1, 21))
        self.assertEqual(info["warnings"][-1], "so many parts are damaged that the rest is not read")

    def test_many_streams(self):
        """Topics of an MCAP file, and connections of a capture, of which nobody speaks SCIP."""
        parts = [b"\x89MCAP0\r\n", foreign.mcap_record(1, bytes(8)), foreign.mcap_record(
            3, struct.pack("<H", 1) + foreign.mcap_text("sensor_msgs/msg/LaserScan") + bytes(8))]
        scan = foreign.cdr_scan(NS, [1])
        for number in range(1, 20_001):
            parts.append(foreign.mcap_record(4, struct.pack("<HH", number, 1) + foreign.mcap_text(f"/{number}") +
                                             foreign.mcap_text("cdr") + bytes(4)))
            parts.append(foreign.mcap_record(5, struct.pack("<HIQQ", number, 0, NS, NS) + scan))
        info = self.bounded(self.path("a.mcap", b"".join(parts)))
        self.assertEqual([stream["scans"] for stream in info["streams"]], [1] * 4096)
        self.assertIn("has more than 4096 topics of scans", info["warnings"][0])
        network = foreign.Network()
        for number in range(60_000):
            network.CLIENT = (struct.pack(">I", 0x0A000002 + number), 50000)
            network.packet(True, b"GET\n")
        info = self.bounded(self.path("a.pcap", foreign.pcap(network.packets)))
        self.assertEqual(info["streams"], [])
        self.assertIn("has more than 50000 TCP connections", info["warnings"][0])

    def test_folders_of_many_parts(self):
        self.laser_db3("d_0.db3", [NS])
        self.path("metadata.yaml", foreign.metadata(f"d_{part}.db3" for part in range(50_000)).encode())
        info = self.bounded(self.folder)
        self.assertEqual((info["scans"], len(info["warnings"])), (1, 21))
        self.path("metadata.yaml", b"a: &a [x, x]\nb: &b [*a, *a]\nrosbag2_bagfile_information:\n"
                                   b"  relative_file_paths: *b\n")
        self.assertEqual(self.bounded(self.folder)["scans"], 1)


if __name__ == "__main__":
    unittest.main()
