# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# The robot stops for a dead scanner, and drives on when it is back: `pytest test_stopping_robot.py` in a sourced
# workspace that has urg_node2. Put your robot in the place of stopping_robot.py. Not run where this was written, which
# has no ROS 2.
import contextlib
import pathlib
import subprocess
import sys
import time

import pytest

rclpy = pytest.importorskip("rclpy")
ROBOT = pathlib.Path(__file__).with_name("stopping_robot.py")


@contextlib.contextmanager
def running(*command):
    """A process that ends with its block."""
    process = subprocess.Popen([str(word) for word in command])
    try:
        yield
    finally:
        process.terminate()
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


@pytest.fixture
def speeds(monkeypatch):
    """A function that returns the latest speed of the robot, None if it has told none yet."""
    from geometry_msgs.msg import Twist
    monkeypatch.setenv("ROS_LOCALHOST_ONLY", "1")
    rclpy.init()
    node = rclpy.create_node("test_stopping_robot")
    heard = []
    node.create_subscription(Twist, "cmd_vel", lambda velocity: heard.append(velocity.linear.x), 10)

    def latest():
        rclpy.spin_once(node, timeout_sec=0.1)
        return heard[-1] if heard else None

    yield latest
    node.destroy_node()
    rclpy.shutdown()


def until(speeds, wanted, seconds):
    """How long it takes until the robot has this speed."""
    begin = time.monotonic()
    while speeds() != pytest.approx(wanted):
        assert time.monotonic() < begin + seconds, f"the robot does not go at {wanted} m/s"
    return time.monotonic() - begin


def test_it_stops_for_a_dead_scanner(scipd, speeds):
    daemon = scipd(world=None, model="UST-10LX")
    driver = ["ros2", "run", "urg_node2", "urg_node2_node", "--ros-args", "-p", f"ip_address:={daemon.host}",
              "-p", f"ip_port:={daemon.port}"]
    with running(*driver), running(sys.executable, ROBOT):
        for state in ("configure", "activate"):
            subprocess.run(["ros2", "lifecycle", "set", "/urg_node2", state], check=True, timeout=60)
        until(speeds, 0.2, 30)
        fault = daemon.fault("cut", how="silent", seconds=5)
        until(speeds, 0.0, 2)
        assert fault.state == "active"
        until(speeds, 0.2, 30)
