# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
import pathlib
import subprocess
import sys

ROBOT = pathlib.Path(__file__).with_name("robot.py")


def test_it_stops_for_a_dead_scanner(scipd):
    daemon = scipd()
    command = [sys.executable, ROBOT, daemon.host, str(daemon.port)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as robot:
        try:
            daemon.wire.wait_for("MD")
            assert robot.stdout.readline() == "drive\n"
            daemon.fault("stall", seconds=1)
            assert robot.stdout.readline() == "stop\n"
            assert robot.stdout.readline() == "drive\n"
        finally:
            robot.kill()
