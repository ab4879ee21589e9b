# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# The map of a world and what a scanner in it sends agree: every scan ends in occupied cells. A map needs no running
# scipd, and a world that goes out as glTF comes in again.
# floor_map_test.py SCIPD SCIPCTL SCIPCAT SCENES
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

PATIENCE_S = 60
POSE = (5.1, 3.3, 0.4)
HEIGHT_M = 0.25
OCCUPIED, UNKNOWN = 0, 205


def run(*words, exit_code=0):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert done.returncode == exit_code, (words, done.returncode, done.stdout, done.stderr)
    return done.stdout if exit_code == 0 else done.stderr


class Map:
    def __init__(self, yaml):
        text = yaml.read_text()
        self.resolution_m = float(re.search(r"resolution: (.*)", text)[1])
        self.origin_m = [float(n) for n in re.search(r"origin: \[(.*)\]", text)[1].split(",")]
        head, size, most, pixels = (yaml.parent / re.search(r"image: '(.*)'", text)[1]).read_bytes().split(b"\n", 3)
        assert (head, most) == (b"P5", b"255")
        self.columns, self.rows = map(int, size.split())
        assert len(pixels) == self.columns * self.rows
        self.pixels = pixels

    def at(self, x_m, y_m):
        column = math.floor((x_m - self.origin_m[0]) / self.resolution_m)
        row = math.floor((y_m - self.origin_m[1]) / self.resolution_m)
        return self.pixels[(self.rows - 1 - row) * self.columns + column]

    def ends_at(self, x_m, y_m):
        """Walls begin at the border of cells that is next to their faces."""
        beside = (-self.resolution_m, 0, self.resolution_m)
        return OCCUPIED in (self.at(x_m + x, y_m + y) for x in beside for y in beside)


def ends(scan):
    """In the world."""
    x_m, y_m, yaw_rad = POSE
    for step, range_mm in enumerate(scan["distances_mm"]):
        if not 100 < range_mm < 30000:
            continue
        angle_rad = yaw_rad + math.radians(-135.0 + 0.25 * step)
        yield x_m + range_mm / 1000 * math.cos(angle_rad), y_m + range_mm / 1000 * math.sin(angle_rad)


def main():
    scipd, scipctl, scipcat, scenes = map(pathlib.Path, sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        options = ["--scene", scenes / "rescue_maze.sdf", "--pose", ",".join(map(str, POSE))]
        control = folder / "control"
        daemon = subprocess.Popen(
            [scipd, *options, "--mount", f"0,0,{HEIGHT_M},0,0,0", "--tcp", "127.0.0.1:0", "--pty", "none", "--accuracy",
             "ideal", "--control", control], stdout=subprocess.PIPE, env={**os.environ, "XDG_RUNTIME_DIR": str(folder)})
        try:
            tcp = json.loads(daemon.stdout.readline())["sensors"][0]["tcp"]
            scan_file = folder / "scan.jsonl"
            run(scipcat, "record", f"tcp://{tcp}", "-o", scan_file, "-n", 1)
            run(scipctl, "--control", control, "scene", "map", "-o", folder / "live.yaml", "--z", HEIGHT_M)
            run(scipctl, "--control", control, "scene", "export", "-o", folder / "world.glb")
            told = run(scipctl, "--control", control, "scene", "map", "-o", folder / "x.yaml", "--z", 50, exit_code=1)
            assert "nothing is at z = 50 m" in told, told
        finally:
            daemon.terminate()
            daemon.wait(PATIENCE_S)
            daemon.stdout.close()
        live = Map(folder / "live.yaml")
        met = list(ends(json.loads(scan_file.read_text().splitlines()[0])))
        assert len(met) > 500, len(met)
        assert all(live.ends_at(*point) for point in met)
        assert live.pixels.count(UNKNOWN) > 0

        told = run(scipd, *options, "--map", folder / "still.yaml", "--map-z", HEIGHT_M)
        assert told.startswith(str(folder / "still.yaml")), told
        # The world is the same, and so are its maps.
        assert (folder / "still.pgm").read_bytes() == (folder / "live.pgm").read_bytes()
        assert (folder / "still.yaml").read_text().replace("still", "live") == (folder / "live.yaml").read_text()
        assert "go with --map" in run(scipd, *options, "--map-z", 1, exit_code=2)
        assert "needs --map-z" in run(scipd, *options, "--map", folder / "y.yaml", exit_code=2)
        assert "no errors" in run(scipd, "--check", folder / "world.glb")
    print(f"{len(met)} beams end where the map is occupied")


main()
