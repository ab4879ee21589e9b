#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""What scipcat finds in recordings that others have written: foreign_recordings_test.py SCIPCAT"""
import json
import pathlib
import random
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

    def info(self, path):
        done = subprocess.run([SCIPCAT, "info", "--json", str(path)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

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
        self.assertRegex(self.refused(self.path("a.bag", whole)), r"a\.bag: byte \d+: the chunk is no sound bzip2")

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


if __name__ == "__main__":
    unittest.main()
