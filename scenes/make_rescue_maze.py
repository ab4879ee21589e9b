#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Writes rescue_maze.sdf and rescue_maze_terrain.obj: a search-and-rescue arena.

    make_rescue_maze.py [FOLDER]        the folder of this script by default

The same bytes every time, on every machine: no library, no clock, its own little generator of chance. Metres. The
origin is the south-west corner of the arena, x is east, y is north; a cell is named by (column, row) from there.
"""
import math
import pathlib
import sys

CELL = 1.2  # the side of a cell: the panels of the arenas in use are 1.2 m long and as high
COLUMNS, ROWS = 12, 12
THICKNESS = 0.1
HEIGHT = 1.2
SHORT_OF = 0.01  # ends of walls stop so far inside the wall they meet: no two faces in one plane

START = {(0, 0), (1, 0), (0, 1), (1, 1)}  # one open square: the robot stands at (1, 1)
RAMPS = {(5, 4), (6, 4), (7, 4), (5, 5), (6, 5), (7, 5)}
STEP_FIELDS = {(3, 8), (9, 2), (8, 6)}
STAIRS = {(9, 9), (10, 9)}
TERRAIN = RAMPS | STEP_FIELDS | STAIRS
METAL_COLUMNS, RUBBER_ROWS = {4, 8}, {6}  # grid lines whose panels are not of wood

BARREL = (0.28, 0.88)  # radius, height
BARRELS = {(2, 4): "metal", (10, 5): "metal", (6, 2): "plastic"}
CRATES = [(8, 8, 0.3, 0.5), (5, 11, 0.1, 0.6), (10, 3, 1.1, 0.4), (7, 2, 0.7, 0.5), (11, 9, 0.2, 0.6), (6, 1, 1.3, 0.3)]


class Chance:
    """Numerical Recipes' 32-bit congruential generator: enough for a maze, and the same everywhere."""

    def __init__(self, seed):
        self.state = seed

    def below(self, n):
        self.state = (1664525 * self.state + 1013904223) % 2**32
        return (self.state >> 16) % n


def neighbours(cell):
    column, row = cell
    for other in ((column + 1, row), (column, row + 1), (column - 1, row), (column, row - 1)):
        if 0 <= other[0] < COLUMNS and 0 <= other[1] < ROWS:
            yield other


def passage(a, b):
    return (min(a, b), max(a, b))


def carve(chance):
    """The open passages between cells: a maze over the flat cells, with loops; terrain is open all over inside, about
    half of its outer edges too."""
    cells = [(c, r) for c in range(COLUMNS) for r in range(ROWS)]
    inner = [passage(a, b) for a in cells for b in neighbours(a) if a < b]
    opened = {p for p in inner if set(p) <= START or set(p) <= RAMPS or set(p) <= STAIRS}
    seen, trail = {(1, 1)} | START | TERRAIN, [(1, 1)]
    while trail:
        fresh = [n for n in neighbours(trail[-1]) if n not in seen]
        if not fresh:
            trail.pop()
            continue
        step = fresh[chance.below(len(fresh))]
        opened.add(passage(trail[-1], step))
        seen.add(step)
        trail.append(step)
    for p in inner:
        flat = not set(p) & TERRAIN
        if p not in opened and chance.below(5 if flat else 2) == 0:
            opened.add(p)
    return opened


def wall_runs(opened):
    """Closed passages as few long walls: (along x?, fixed grid line, first, last), in cells."""
    runs = []
    for along_x, lines, length in ((True, ROWS, COLUMNS), (False, COLUMNS, ROWS)):
        for line in range(1, lines):
            begin = None
            for i in range(length + 1):
                ends = ((i, line - 1), (i, line)) if along_x else ((line - 1, i), (line, i))
                closed = i < length and passage(*ends) not in opened
                if closed and begin is None:
                    begin = i
                if not closed and begin is not None:
                    runs.append((along_x, line, begin, i))
                    begin = None
    return runs


def number(value):
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def visual(name, pose, material, shape):
    place = " ".join(number(v) for v in pose)
    return (f'<visual name="{name}"><pose>{place}</pose><scipd:material>{material}</scipd:material>'
            f"<geometry>{shape}</geometry></visual>")


def box(name, centre, size, material, yaw=0.0):
    sides = " ".join(number(v) for v in size)
    return visual(name, (*centre, 0, 0, yaw), material, f"<box><size>{sides}</size></box>")


def cylinder(name, centre, radius, length, material):
    shape = f"<cylinder><radius>{number(radius)}</radius><length>{number(length)}</length></cylinder>"
    return visual(name, (*centre, 0, 0, 0), material, shape)


def outer_walls():
    width, depth, t = COLUMNS * CELL, ROWS * CELL, THICKNESS
    z = HEIGHT / 2
    yield box("south", (width / 2, -t / 2, z), (width + 2 * t, t, HEIGHT), "wall")
    yield box("north", (width / 2, depth + t / 2, z), (width + 2 * t, t, HEIGHT), "wall")
    yield box("west", (-t / 2, depth / 2, z), (t, depth + t, HEIGHT), "wall")
    yield box("east", (width + t / 2, depth / 2, z), (t, depth + t, HEIGHT), "wall")


def inner_walls(opened):
    reach = THICKNESS / 2 - SHORT_OF
    for n, (along_x, line, first, last) in enumerate(wall_runs(opened)):
        material = "wood"
        if not along_x and line in METAL_COLUMNS:
            material = "metal"
        if along_x and line in RUBBER_ROWS:
            material = "rubber"
        middle, length = (first + last) / 2 * CELL, (last - first) * CELL + 2 * reach
        x, y = (middle, line * CELL) if along_x else (line * CELL, middle)
        # The ones along y are a little lower, for the same reason that ends stop short.
        height = HEIGHT if along_x else HEIGHT - SHORT_OF
        size = (length, THICKNESS, height) if along_x else (THICKNESS, length, height)
        yield box(f"panel_{n}", (x, y, height / 2), size, material)


class Obj:
    """Triangles and quads by material; a vertex is written once."""

    def __init__(self):
        self.index, self.vertices, self.faces = {}, [], {}

    def face(self, material, *corners):
        numbers = []
        for corner in corners:
            text = " ".join(number(v) for v in corner)
            if text not in self.index:
                self.vertices.append(text)
                self.index[text] = len(self.vertices)
            numbers.append(str(self.index[text]))
        self.faces.setdefault(material, []).append("f " + " ".join(numbers))

    def text(self):
        lines = ["# Terrain of the rescue maze: metres, z up, in the frame of the world. Made by make_rescue_maze.py;",
                 "# materials are names for scipd, there is no .mtl file."]
        lines += ["v " + v for v in self.vertices]
        for material in sorted(self.faces):
            lines += ["usemtl " + material] + self.faces[material]
        return "\n".join(lines) + "\n"


def block(obj, material, x0, y0, x1, y1, top):
    """A box on the floor without its underside."""
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    obj.face(material, *[(x, y, top) for x, y in corners])
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1]):
        obj.face(material, (ax, ay, 0), (bx, by, 0), (bx, by, top), (ax, ay, top))


def ramps(obj):
    """Crossing ramps of 15 degrees, each turned against its neighbours, so that a robot pitches and rolls all the way.
    They end clear of the walls around them."""
    gap = THICKNESS / 2 + SHORT_OF
    for column, row in sorted(RAMPS):
        x0, y0 = column * CELL + gap, row * CELL + gap
        x1, y1 = x0 + CELL - 2 * gap, y0 + CELL - 2 * gap
        top = (x1 - x0) * math.tan(math.radians(15))
        turn = (column + 2 * row) % 4  # which side is the high one
        high = {0: (1, 2), 1: (2, 3), 2: (3, 0), 3: (0, 1)}[turn]
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        tops = [(x, y, top if i in high else 0.0) for i, (x, y) in enumerate(corners)]
        obj.face("wood", *tops)
        for i in range(4):
            a, b = tops[i], tops[(i + 1) % 4]
            skirt = [(a[0], a[1], 0.0), (b[0], b[1], 0.0)]
            skirt += [p for p in (b, a) if p[2] > 0]
            if len(skirt) > 2:
                obj.face("wood", *skirt)


def stairs(obj):
    """Five steps of 0.2 m east-wards, the last one a landing."""
    x0, y0 = 9 * CELL + THICKNESS, 9 * CELL + THICKNESS
    y1, end = 10 * CELL - THICKNESS, 11 * CELL - THICKNESS
    for step in range(5):
        left = x0 + 0.3 * step
        block(obj, "metal", left, y0, end if step == 4 else left + 0.3, y1, 0.2 * (step + 1))


def step_fields(obj, chance):
    """Pallets of square posts of ten centimetres, nought to four high. A height field: neighbours share their sides."""
    count, side = 10, 0.1
    for column, row in sorted(STEP_FIELDS):
        x0, y0 = column * CELL + 0.1, row * CELL + 0.1
        level = {(i, j): 0.1 * (1 + chance.below(4)) for i in range(count) for j in range(count)}
        for (i, j), top in sorted(level.items()):
            x, y = x0 + i * side, y0 + j * side
            obj.face("wood", (x, y, top), (x + side, y, top), (x + side, y + side, top), (x, y + side, top))
        for i in range(count + 1):
            for j in range(count):
                for a, b, p, q in (((i - 1, j), (i, j), (i, j), (i, j + 1)), ((j, i - 1), (j, i), (j, i), (j + 1, i))):
                    low, high = sorted((level.get(a, 0.0), level.get(b, 0.0)))
                    if high - low < 0.05:
                        continue
                    (px, py), (qx, qy) = [(x0 + u * side, y0 + v * side) for u, v in (p, q)]
                    obj.face("wood", (px, py, low), (qx, qy, low), (qx, qy, high), (px, py, high))


def centre_of(cell):
    return ((cell[0] + 0.5) * CELL, (cell[1] + 0.5) * CELL)


def way(opened, *stops):
    """The cells on the shortest way over flat ground through all the stops."""
    full = [stops[0]]
    for goal in stops[1:]:
        came, queue = {full[-1]: None}, [full[-1]]
        while goal not in came:
            cell = queue.pop(0)
            for other in neighbours(cell):
                free = other not in TERRAIN and other not in BARRELS
                if free and other not in came and passage(cell, other) in opened:
                    came[other] = cell
                    queue.append(other)
        back = [goal]
        while came[back[-1]] is not None:
            back.append(came[back[-1]])
        full += back[-2::-1]
    return full


def model(name, comment, pose, static, visuals):
    head = [f"    <!-- {comment} -->", f'    <model name="{name}">']
    head += ["      <static>true</static>"] if static else []
    head += ["      <pose>" + " ".join(number(v) for v in pose) + "</pose>"] if any(pose) else []
    return head + ['      <link name="body">'] + ["        " + v for v in visuals] + ["      </link>", "    </model>"]


COMMENT = """  <!--
    A search-and-rescue arena in the manner of NIST's test arenas: a maze of 1.2 m cells (12 by 12) between panels of
    1.2 m, crossing ramps of 15 degrees, stairs, three step fields, barrels, crates and a person. Metres and radians; \
the origin is the south-west inner corner, x is east, y is north, z is up.

    Start: x 1, y 1, looking along +x, a scanner at a height of 0.25 to 0.30: nothing is nearer than 0.99 m.
    Models that move: barrel, door, person. Made by make_rescue_maze.py; change that instead.
  -->"""


def build():
    """The texts of both files, and the open passages for whoever plans a way through."""
    chance = Chance(20100)
    opened = carve(chance)
    obj = Obj()
    ramps(obj)
    stairs(obj)
    step_fields(obj, chance)

    width, depth = COLUMNS * CELL, ROWS * CELL
    floor = visual("floor", (width / 2, depth / 2, 0, 0, 0, 0), "concrete",
                   f"<plane><normal>0 0 1</normal><size>{number(width)} {number(depth)}</size></plane>")
    terrain = ('<visual name="terrain"><geometry><mesh><uri>rescue_maze_terrain.obj</uri></mesh></geometry></visual>')
    radius, height = BARREL
    barrels = [cylinder(f"barrel_{n}", (*centre_of(cell), height / 2), radius, height, material)
               for n, (cell, material) in enumerate(sorted(BARRELS.items()))]
    crates = [box(f"crate_{n}", (*centre_of((column, row)), side / 2), (side, side, side), "cardboard", yaw)
              for n, (column, row, yaw, side) in enumerate(CRATES)]
    person = [cylinder("legs", (0, 0, 0.42), 0.14, 0.84, "cloth"), cylinder("chest", (0, 0, 1.15), 0.2, 0.62, "cloth"),
              cylinder("head", (0, 0, 1.58), 0.1, 0.24, "skin")]

    lines = ['<?xml version="1.0"?>', '<sdf version="1.9" xmlns:scipd="urn:scipd:sdf">', COMMENT,
             '  <world name="rescue_maze">']
    lines += model("arena", "What stays where it is; the materials of the terrain are in its mesh.", (0,) * 6, True,
                   [floor, *outer_walls(), *inner_walls(opened), terrain, *barrels, *crates])
    lines += model("barrel", "Can be rolled away.", (*centre_of((11, 0)), 0, 0, 0, 0), False,
                   [cylinder("barrel", (0, 0, height / 2), radius, height, "plastic")])
    lines += model("door", "A door ajar; its hinge is the origin of the model.",
                   (11 * CELL + 0.15, 7 * CELL + 0.2, 0, 0, 0, 0.6), False,
                   [box("leaf", (0.4, 0, 0.6), (0.8, 0.04, 1.2), "wood")])
    lines += model("person", "Somebody to be found.", (*centre_of((11, 11)), 0, 0, 0, 0), False, person)
    lines += ["  </world>", "</sdf>"]
    return "\n".join(lines) + "\n", obj.text(), opened


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent
    world, terrain, _ = build()
    (folder / "rescue_maze.sdf").write_text(world, newline="\n")
    (folder / "rescue_maze_terrain.obj").write_text(terrain, newline="\n")


if __name__ == "__main__":
    main()
