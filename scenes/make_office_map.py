#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Writes office_map.yaml and office_map.pgm: a storey of an office as map_server of ROS saves one.

    make_office_map.py [FOLDER]         the folder of this script by default

The same bytes every time. Metres; the origin is the inner south-west corner, x is east, y is north. A corridor runs
from west to east between three rooms on either side.
"""
import pathlib
import sys

CELL = 0.05
EAST, NORTH = 15.0, 9.0  # the inner sides of the outer walls
WALL, MARGIN = 0.2, 0.5  # around the walls nothing is known
EDGE = WALL + MARGIN

OCCUPIED, UNKNOWN, FREE = 0, 205, 254

# x, y of two corners each
WALLS = [(0, 3.6, EAST, 3.8), (0, 5.2, EAST, 5.4)] + [
    (x, low, x + WALL, high) for x in (5.0, 10.0) for low, high in ((0, 3.6), (5.4, NORTH))]
DOORS = [(x, 3.6, x + 0.9, 3.8) for x in (2.0, 7.0, 12.0)] + [(x, 5.2, x + 0.9, 5.4) for x in (1.5, 7.5, 11.0)]
FURNITURE = [(0.0, 6.5, 0.8, 8.1), (3.4, 8.2, 5.0, 9.0), (6.6, 8.0, 8.6, 8.8), (13.0, 6.0, 13.8, 7.6),
             (1.2, 0.4, 2.8, 1.2), (4.4, 1.0, 5.0, 3.0), (6.5, 1.3, 8.5, 2.1), (12.0, 0.0, 14.0, 0.6),
             (14.4, 3.8, 15.0, 4.1)]
PILLARS = [(8.8, 6.4, 0.25), (11.5, 1.8, 0.25)]  # x, y, radius

YAML = f"""\
# A storey of an office, 15 m by 9 m, as map_server of ROS 1 and nav2 read it. The origin of W is the inner south-west
# corner; a robot may start at x 1, y 4.5 in the corridor, where walls are 1 m behind it and 0.7 m to either side.
# Written by make_office_map.py.
image: office_map.pgm
resolution: {CELL}
origin: [{-EDGE}, {-EDGE}, 0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""


def pixel(x, y):
    def within(boxes):
        return any(left < x < right and low < y < high for left, low, right, high in boxes)

    if not within([(-WALL, -WALL, EAST + WALL, NORTH + WALL)]):
        return UNKNOWN
    if not within([(0, 0, EAST, NORTH)]) or within(WALLS) and not within(DOORS):
        return OCCUPIED
    is_pillar = any((x - east) ** 2 + (y - north) ** 2 < radius**2 for east, north, radius in PILLARS)
    return OCCUPIED if is_pillar or within(FURNITURE) else FREE


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent
    columns, rows = round((EAST + 2 * EDGE) / CELL), round((NORTH + 2 * EDGE) / CELL)
    picture = bytearray(f"P5\n{columns} {rows}\n255\n".encode())
    for row in reversed(range(rows)):  # from the top
        picture += bytes(pixel((column + 0.5) * CELL - EDGE, (row + 0.5) * CELL - EDGE) for column in range(columns))
    (folder / "office_map.pgm").write_bytes(picture)
    (folder / "office_map.yaml").write_text(YAML, newline="\n")


if __name__ == "__main__":
    main()
