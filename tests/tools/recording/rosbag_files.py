#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
Has ROS itself write bags: packed in each way, out of order, and split. rosbag_files.py FOLDER. Ends with 77 where there
is no rosbag.
"""
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

# As a program that merges bags writes them: the second half first, and neighbours in each other's place.
with rosbag.Bag(str(pathlib.Path(sys.argv[1], "disordered.bag")), "w", chunk_threshold=20_000) as bag:
    for place in range(100):
        number = (place + 50) % 100 ^ 1
        bag.write("/front/scan", scan(number), scan(number).header.stamp)

for part in range(3):
    with rosbag.Bag(str(pathlib.Path(sys.argv[1], f"split_{part}.bag")), "w") as bag:
        for number in range(20 * part, 20 * part + 20):
            bag.write("/front/scan", scan(number), scan(number).header.stamp)
