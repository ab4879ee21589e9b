#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
MCAP against the reader and writer of its makers, @mcap/core of npm: mcap_core_test.py SCIPD SCIPCAT SOURCES. Skipped
(77) where they are not; `tools/install test` fetches them into build/npm.
"""
import itertools
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SCIPD, SCIPCAT = sys.argv[1:3]
SOURCES = pathlib.Path(sys.argv[3])
PACKAGES = SOURCES / "build/npm"
del sys.argv[1:]


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(f"{command} ended with {done.returncode}: {done.stderr}")
    return done.stdout


class McapCore(unittest.TestCase):
    def setUp(self):
        # Node looks for packages in the folders above a module.
        folder = tempfile.TemporaryDirectory(dir=PACKAGES, prefix="run-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.script = self.folder / "mcap_core.mjs"
        shutil.copy(SOURCES / "tests/tools/recording/mcap_core.js", self.script)

    def record(self, *options):
        file = self.folder / "room.mcap"
        command = [SCIPD, "--tcp", "127.0.0.1:0", "--pty", "none", "--control", self.folder / "control.sock"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as scipd:
            try:
                tcp = json.loads(scipd.stdout.readline())["sensors"][0]["tcp"]
                run(SCIPCAT, "record", "tcp://" + tcp, "-o", file, "-n", 60, *options)
            finally:
                scipd.terminate()
        return file

    def test_reads_what_scipcat_writes(self):
        for pack in ("zstd", "lz4", "none"):
            found = json.loads(run("node", self.script, "read", self.record("--compression", pack)))
            self.assertRegex(found["library"], r"^scipcat \d")
            self.assertTrue(found["done"])
            self.assertGreater(len(found["chunks"]), 1)
            self.assertEqual(set(found["chunks"]), {"" if pack == "none" else pack})

            topics = found["topics"]
            self.assertEqual(topics["/scan"], 60)
            self.assertGreater(topics["/wire/to_scanner"], 5)
            self.assertEqual(found["statistics"]["messageCount"], sum(topics.values()))
            self.assertEqual(found["records"]["Message"], sum(topics.values()))
            self.assertEqual(found["records"]["ChunkIndex"], len(found["chunks"]))
            self.assertEqual(found["summaryOffsets"], 5)
            self.check_channels(found)
            self.check_scan(json.loads(found["first"]["/scan"]))
            (metadata,) = found["metadata"]
            self.assertEqual((metadata["name"], metadata["entries"]["model"]), ("scip", "UST-10LX"))
            self.assertEqual(metadata["entries"]["PP.ARES"], "1440")
            self.assertIn("VV.SERI", metadata["entries"])
            self.assertIn("II.STAT", metadata["entries"])

    def check_channels(self, found):
        channels = {channel.pop("topic"): channel for channel in found["channels"]}
        self.assertEqual(set(channels), {"/scan", "/wire/to_scanner", "/wire/from_scanner"})
        self.assertEqual(channels["/wire/from_scanner"]["messageEncoding"], "scip")
        scan = channels["/scan"]
        self.assertEqual((scan["messageEncoding"], scan["schema"], scan["schemaEncoding"]),
                         ("json", "foxglove.LaserScan", "jsonschema"))
        self.schema = json.loads(scan["schemaData"])

    def check_scan(self, scan):
        self.assertEqual(len(scan["ranges"]), 1081)
        self.assertAlmostEqual(scan["start_angle"], -2.35619449)
        self.assertAlmostEqual(scan["end_angle"], 2.35619449)
        for mm, range_m in zip(scan["distances_mm"], scan["ranges"]):
            self.assertEqual(range_m, mm / 1000 if 20 <= mm <= 30000 else 0)
        self.assertLessEqual(set(scan), set(self.schema["properties"]))
        try:
            import jsonschema
        except ImportError:
            return
        jsonschema.validate(scan, self.schema)

    def test_writes_what_scipcat_reads(self):
        # In order, neighbours in each other's place, halves, and both.
        for pack, order in itertools.product(("zstd", "none", "no-chunks"), (0, 1, 16, 31)):
            file = self.folder / "ros2.mcap"
            run("node", self.script, "write", file, pack, order)
            info = json.loads(run(SCIPCAT, "info", "--json", file))
            self.assertEqual((info["format"], info["scans"], info["steps"]), ("mcap", 32, 3))
            self.assertAlmostEqual(info["seconds"], 31 * 0.025)
            self.assertEqual((info["gaps"], info["times"]), ([], {"stamped": 32, "logged": 0}))
            self.assertEqual([stream["name"] for stream in info["streams"]], ["/scan"])
            (warning,) = info["warnings"]
            self.assertRegex(warning, r"/odom \(nav_msgs/msg/Odometry\)$")


if not shutil.which("node") or not (PACKAGES / "node_modules/@mcap/core").is_dir():
    print("skipped: there is no node, or no @mcap/core in build/npm; tools/install test fetches it")
    sys.exit(77)
unittest.main()
