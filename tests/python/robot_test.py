# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# A robot is put somewhere and drives, on the wall clock.
import math
import time

import pytest

from scipd import Pose, Scipd, ScipdError, Trajectory


@pytest.fixture
def daemon(scipd, room):
    return scipd(world=room, accuracy="ideal")


def test_a_pose_is_three_or_six_numbers(daemon):
    robot = daemon.robot()
    robot.pose = (1, 0.5, math.pi / 2)
    assert tuple(robot.pose) == pytest.approx((1, 0.5, 0, 0, 0, math.pi / 2))
    assert daemon.scan().at(0) == 1.5
    robot.pose = (0, 0, 0.1, 0.01, 0.02, -0.3)
    assert tuple(robot.pose) == pytest.approx((0, 0, 0.1, 0.01, 0.02, -0.3))
    there = robot.pose
    robot.pose = (1, 1, 0)
    robot.pose = there
    assert robot.pose.yaw == pytest.approx(-0.3)
    for wrong in [(1, 2), (1, 2, math.nan), (1, 2, 3, 4)]:
        with pytest.raises(ValueError, match=r"a pose is \(x, y, yaw\)"):
            robot.pose = wrong


def test_degrees_are_warned_of(daemon, recwarn):
    for pose in [(1, 0.5, math.pi), (0, 0, 0, 0, 0, 7.853981), (0, 0, 6.2)]:
        daemon.robot().pose = pose
    assert not recwarn.list
    with pytest.warns(UserWarning, match=r"^90 looks like degrees, .* radians; did you mean 1\.5708\?") as warned:
        daemon.robot().pose = (1, 0.5, 90)
    assert warned[0].filename == __file__, "the line of the test"
    with pytest.warns(UserWarning, match="looks like degrees"):
        daemon.scene.move("box", (1, 1, 0, 0, 0, -45))
    with pytest.warns(UserWarning, match="looks like degrees") as warned:
        Trajectory.of([(0, (0, 0, 0)), (1, (0, 0, 180))])
    assert warned[0].filename == __file__


def test_it_drives_between_poses_that_are_far_apart(daemon):
    begin = time.monotonic()
    drive = daemon.robot().pose.play([(0, (-1, 0, 0)), (2, (1, 0, 0))], speed=2)
    time.sleep(0.5)
    assert not drive.done
    assert -0.5 < daemon.robot().pose.x < 0.5 or time.monotonic() - begin > 0.75
    drive.wait()
    assert drive.done
    assert daemon.scan().at(0) == 2.0


def test_a_drive_is_stopped_by_hand_or_by_a_pose(daemon):
    robot = daemon.robot()
    drive = robot.play([(0, (-1, 0, 0)), (60, (1, 0, 0))])
    drive.stop()
    assert drive.done
    drive = robot.play([(0, (-1, 0, 0)), (60, (1, 0, 0))])
    robot.pose = (0, 1, 0)
    assert drive.done
    time.sleep(0.2)
    assert robot.pose.y == pytest.approx(1)


def test_a_file_is_played_from_the_start(scipd, scenes, room):
    daemon = scipd(world=room, poses=scenes / "square_room.tum")
    first = daemon.robot().pose.yaw
    time.sleep(0.5)
    assert daemon.robot().pose.yaw != first


def test_pairs_are_played_from_the_start():
    with Scipd(poses=[(0, (4, 9, 0)), (0.2, (4.1, 9, 0))]) as daemon:
        time.sleep(0.4)
        assert daemon.robot().pose.x == pytest.approx(4.1)


# From here on: values, without a daemon.


def test_a_trajectory_is_read_from_tum(tmp_path):
    file = tmp_path / "drive.tum"
    file.write_text("# t x y z qx qy qz qw\n10 0 0 0 0 0 0 1\n10 5 5 5 0 0 0 1\n12 2 0 0 0 0 1 0\n")
    drive = Trajectory.of(file)
    assert drive.seconds == 2
    assert tuple(drive.at(1)) == pytest.approx((1, 0, 0, 0, 0, math.pi / 2))
    assert drive.at(-1).x == 0 and drive.at(9).x == 2
    file.write_text("10 0 0 0 0 0 0 1\n11 1 2\n")
    with pytest.raises(ScipdError, match="drive.tum:2: is no line of TUM"):
        Trajectory.of(file)
    file.write_text("# nothing\n")
    with pytest.raises(ScipdError, match="holds no pose"):
        Trajectory.of(file)
    with pytest.raises(ValueError, match="must grow"):
        Trajectory.of([(0, (0, 0, 0)), (0, (1, 0, 0))])


@pytest.mark.parametrize("rpy", [(0, 0, 0), (0.1, -0.2, 3), (-1, 1.2, -2), (3, 0.5, 0.1)])
def test_angles_come_back(rpy):
    assert Pose.of((1, 2, 3, *rpy)).rpy == pytest.approx(rpy)
