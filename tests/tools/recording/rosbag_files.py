#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Has ROS itself write bags, packed in each way: rosbag_files.py FOLDER. Ends with 77 where there is no rosbag."""
import pathlib
import sys

try:
    import rosbag
    import rospy
    from sensor_msgs.msg import LaserScan
except ImportError:
    sys.exit(77)


def scan(number):
    message = LaserScan(angle_min=-1.5, angle_max=1.5, angle_increment=0.01, range_min=0.1, range_max=30,
                        ranges=[1.0 + number] * 301, intensities=[5.0] * 301)
    message.header.stamp = rospy.Time(1_700_000_000, number * 5_000_000)
    return message


for pack in ("none", "bz2", "lz4"):
    path = pathlib.Path(sys.argv[1], f"{pack}.bag")
    with rosbag.Bag(str(path), "w", compression=pack, chunk_threshold=20_000) as bag:
        for number in range(100):
            bag.write("/front/scan", scan(number), rospy.Time(1_700_000_000, number))
