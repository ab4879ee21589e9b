# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# A robot that drives while its scans are fresh and nothing is near: it hears /scan and tells /cmd_vel. Not run with
# ROS 2 where this was written, which has none: only its rule, speed_of().
import math

FRESH_S = 0.5
NEAR_M = 0.5
SPEED_MPS = 0.2


def speed_of(ranges, age_s):
    """`age_s`: how long ago the latest scan came."""
    seen = [r for r in ranges if math.isfinite(r) and r > 0.02]
    return SPEED_MPS if age_s < FRESH_S and seen and min(seen) > NEAR_M else 0.0


def main():
    import rclpy
    from geometry_msgs.msg import Twist
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import LaserScan

    class StoppingRobot(Node):
        def __init__(self):
            super().__init__("stopping_robot")
            self.ranges, self.came = [], self.get_clock().now()
            self.create_subscription(LaserScan, "scan", self.hear, qos_profile_sensor_data)
            self.velocity = self.create_publisher(Twist, "cmd_vel", 10)
            self.create_timer(0.05, self.tell)

        def hear(self, scan):
            self.ranges, self.came = scan.ranges, self.get_clock().now()

        def tell(self):
            velocity = Twist()
            velocity.linear.x = speed_of(self.ranges, (self.get_clock().now() - self.came).nanoseconds * 1e-9)
            self.velocity.publish(velocity)

    rclpy.init()
    rclpy.spin(StoppingRobot())


if __name__ == "__main__":
    main()
