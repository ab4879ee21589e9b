#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Writes rescue_maze.tum, square_room.tum and corridor.tum: drives of a robot through the worlds of the same names.

    make_trajectories.py [FOLDER]       the folder of this script by default

Lines are `t x y z qx qy qz qw`, seconds and metres. The robot drives straight and turns on the spot.
"""
import math
import pathlib
import sys

sys.dont_write_bytecode = True
import make_rescue_maze as maze  # noqa: E402

TURN_RATE = math.radians(90)  # per second


class Drive:
    def __init__(self, comment, x, y, speed, rate_hz):
        self.lines = [f"# {comment}", "# t x y z qx qy qz qw"]
        self.x, self.y, self.yaw = x, y, 0.0
        self.speed, self.rate_hz, self.tick = speed, rate_hz, 0
        self.note()

    def note(self):
        half = self.yaw / 2
        self.lines.append(f"{self.tick / self.rate_hz:.3f} {self.x:.4f} {self.y:.4f} 0 "
                          f"0 0 {math.sin(half):.7f} {math.cos(half):.7f}")
        self.tick += 1

    def turn(self, angle):
        steps = math.ceil(abs(angle) / TURN_RATE * self.rate_hz - 1e-9)
        first = self.yaw
        for step in range(1, steps + 1):
            self.yaw = first + angle * step / steps
            self.note()

    def go(self, x, y):
        """Turns the shorter way, then drives."""
        heading = math.atan2(y - self.y, x - self.x)
        self.turn(math.remainder(heading - self.yaw, 2 * math.pi))
        steps = math.ceil(math.hypot(x - self.x, y - self.y) / self.speed * self.rate_hz - 1e-9)
        x0, y0 = self.x, self.y
        for step in range(1, steps + 1):
            self.x, self.y = x0 + (x - x0) * step / steps, y0 + (y - y0) * step / steps
            self.note()

    def text(self):
        return "\n".join(self.lines) + "\n"


def through_the_maze():
    _, _, opened = maze.build()
    drive = Drive("Through the maze, from the start to the north-west corner.", 1.0, 1.0, 0.6, 20)
    corners = [maze.centre_of(cell) for cell in maze.way(opened, (1, 1), (1, 11))]
    drive.go(corners[0][0], 1.0)
    for n, corner in enumerate(corners):
        along = corners[n - 1:n + 2]
        straight = len(along) == 3 and (len({x for x, _ in along}) == 1 or len({y for _, y in along}) == 1)
        if not straight:  # a robot does not stop in the middle of a straight
            drive.go(*corner)
    return drive.text()


def round_and_round():
    drive = Drive("Two turns to the left on the spot at 90 degrees a second.", 0.0, 0.0, 1.0, 50)
    drive.turn(4 * math.pi)
    return drive.text()


def along_the_corridor():
    drive = Drive("Along the corridor at 1 m/s, back a bit, round the cart.", 1.0, 0.0, 1.0, 20)
    for x, y in ((19.0, 0.0), (20.5, -0.5), (23.0, -0.5), (24.5, 0.0), (28.5, 0.0), (26.0, 0.0)):
        drive.go(x, y)
    return drive.text()


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent
    for name, text in (("rescue_maze", through_the_maze()), ("square_room", round_and_round()),
                       ("corridor", along_the_corridor())):
        (folder / f"{name}.tum").write_text(text, newline="\n")


if __name__ == "__main__":
    main()
