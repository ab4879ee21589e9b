# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Holds docs/configuration.md against `scipd --check`: configuration.py SCIPD SOURCES
#
# Each section has a row for every key that scipd knows there, whose example has no fault. For each row
# wrong_values.yaml has a wrong value with the message that it gets. scipd itself says which keys it knows: that is what
# it answers to one that it does not.
import concurrent.futures
import pathlib
import re
import subprocess
import sys
import tempfile

import yaml

SCANNER = {"model": "UST-10LX", "tcp": "127.0.0.1:0"}
BOTH_LINKS = "model: URG-04LX, tcp: '127.0.0.1:0', pty: auto"
CAMERA = {"columns": "8", "rows": "6", "fov_deg": "[40, 30]", "rate_hz": "25", "range_m": "[0.1, 7.5]"}
RANGER = {"cone_deg": "30", "beams": "61", "rate_hz": "20", "range_m": "[0.02, 4]"}
ROBOTS = "{rescue: {sensors: {front: {model: UST-10LX, tcp: '127.0.0.1:0'}}}}"
ROOM = "scene: scenes/square_room.sdf"
LIDAR = "scene: tests/sim/loaders/worlds/lidar.sdf"


def with_root(text):
    return f"{{{ROOM}, {text}, robots: {ROBOTS}}}"


def with_sensor(text, scene=ROOM):
    return f"{{{scene}, robots: {{rescue: {{sensors: {{front: {{{text}}}}}}}}}}}"


# For each section a document with a hole, and what is there besides unless a row gives it.
SECTIONS = {
    "root": ("{@}", {"scene": "scenes/square_room.sdf", "robots": ROBOTS}),
    "control": (with_root("control: {@}"), {}),
    "http": (with_root("http: {@}"), {"listen": "127.0.0.1:0"}),
    "fleet": (with_root("fleet: {@}"), {"broker": "mqtts://127.0.0.1", "world": "hall"}),
    "map": (with_root("map: {@}"), {}),
    "media": (with_root("media: [{@}]"), {"kind": "custom", "extinction_per_m": "0.1"}),
    "limits": (with_root("limits: {@}"), {}),
    "robots.NAME": (f"{{{ROOM}, robots: {{rescue: {{@}}}}}}", {"sensors": "{front: {model: UST-10LX, pty: auto}}"}),
    "robots.NAME.poses": (f"{{{ROOM}, robots: {{rescue: {{poses: {{@}}, "
                          f"sensors: {{front: {{model: UST-10LX, pty: auto}}}}}}}}}}", {}),
    "robots.NAME.sensors.NAME": (with_sensor("@"), SCANNER),
    "robots.NAME.sensors.NAME.mount": (with_sensor("model: UST-10LX, pty: auto, mount: {@}", LIDAR), {}),
    "robots.NAME.sensors.NAME.depth": (with_sensor("model: UST-10LX, pty: auto, depth: {@}"), {}),
    "robots.NAME.sensors.NAME.clock": (with_sensor("model: UST-10LX, pty: auto, clock: {@}"), {}),
    "robots.NAME.sensors.NAME.replay": (with_sensor("model: UST-10LX, pty: auto, replay: {@}"), {}),
    "robots.NAME.sensors.NAME.link": (with_sensor(f"{BOTH_LINKS}, link: {{@}}"), {}),
    "robots.NAME.sensors.NAME.camera": (with_sensor("camera: {@}"), CAMERA),
    "robots.NAME.sensors.NAME.ranger": (with_sensor("ranger: {@}"), RANGER),
    "models.NAME": (with_root("models: {MINE: {@}}"), {}),
    "profile": (with_sensor("model: URG-04LX, pty: auto, profile: {@}"), {}),
}
PATHS = {"root": "", "profile": "robots.rescue.sensors.front.profile"}
# A row with one of these is whole: it needs nothing besides.
WHOLE = {"camera", "ranger", "kind"}
# What a build says that lacks an optional part.
WITHOUT = "this scipd was built without"
UNKNOWN = "a_key_that_nobody_could_ever_have_meant: 1"


def path_of(section):
    names = iter(["rescue", "front"] if section.startswith("robots") else ["MINE"])
    return PATHS.get(section, re.sub("NAME", lambda _: next(names), section))


def code_of(cell):
    span = re.search(r"(`+) ?(.+?) ?\1(?!`)", cell)
    return span.group(2) if span else ""


def rows_of(page):
    """(section, key, example)"""
    section, rows = None, []
    for line in page.read_text().splitlines():
        if line.startswith("## "):
            section = line[3:].strip("`") if line.startswith("## `") else None
        elif section and line.startswith("| `"):
            cells = line.strip("| ").split(" | ")
            rows.append((section, code_of(cells[0]), code_of(cells[-1])))
    return rows


def keys_of(text):
    return {key.value for key, _ in yaml.compose("{" + text + "}").value}


def packs_of(rows):
    """(section, examples that go together): a world takes longer to load than many keys to read."""
    packs = []
    for section, _, example in rows:
        keys = keys_of(example)
        for pack in packs:
            both = keys | pack[2]
            # The room is not written in xacro: its arguments are a warning, which strict refuses.
            alone = {"link", "sensor"} <= both or {"strict", "xacro"} <= both or both & WHOLE
            if pack[0] == section and not alone and not keys & pack[2]:
                pack[1] += ", " + example
                pack[2] |= keys
                break
        else:
            packs.append([section, example, keys])
    return [(section, text) for section, text, _ in packs]


class Checker:
    def __init__(self, scipd, folder):
        self.scipd = scipd
        self.folder = folder

    def check(self, name, section, row):
        """What `scipd --check` says of a document with this row."""
        document, base = SECTIONS[section]
        given = keys_of(row)
        besides = "".join(f", {key}: {text}" for key, text in base.items() if key not in given)
        if given & WHOLE:
            besides = ""
        file = self.folder / f"{name}.yaml"
        file.write_text(document.replace("@", row + besides) + "\n")
        done = subprocess.run([self.scipd, "--check", file.name], cwd=self.folder, capture_output=True, text=True,
                              timeout=60, check=False)
        return done.returncode, done.stdout + done.stderr

    def examples_fail(self, pack):
        section, text = pack
        code, said = self.check(f"right-{abs(hash(text))}", section, text)
        return f"{section}: of the examples {text}: {said}" if code != 0 and WITHOUT not in said else None

    def wrong_value_fails(self, row):
        section, key, wrong, message = row
        code, said = self.check(f"wrong-{section}-{key}", section, wrong)
        if WITHOUT in said:
            return None
        if code != 2 or not any(path_of(section) in fault and message in fault for fault in said.splitlines()):
            return f"{section}: the wrong value of {key} gets: {said}"
        return None

    def section_fails(self, section, documented):
        _, said = self.check(f"unknown-{section}", section, UNKNOWN)
        known = re.search(r"ever_have_meant: unknown key; known here are (.*)", said)
        if not known:
            return f"{section}: {said}"
        differ = set(known.group(1).split(", ")) ^ documented
        return f"{section}: documented or known, but not both: {', '.join(sorted(differ))}" if differ else None


def wrong_values(file):
    """(section, key, wrong value, message)"""
    return [(section, key, *row) for section, keys in yaml.safe_load(file.read_text()).items()
            for key, row in keys.items()]


def main():
    scipd, sources = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    rows = rows_of(sources / "docs/configuration.md")
    wrong = wrong_values(pathlib.Path(__file__).with_name("wrong_values.yaml"))
    differ = {row[:2] for row in rows} ^ {row[:2] for row in wrong}
    unpaired = [f"{section}: documented or in wrong_values.yaml, but not both: {key}" for section, key in differ]
    keys = {section: {row[1] for row in rows if row[0] == section} for section in SECTIONS}
    keys["models.NAME"] |= keys["profile"]
    with tempfile.TemporaryDirectory() as folder:
        checker = Checker(scipd, pathlib.Path(folder))
        for name in ("scenes", "tests"):
            (checker.folder / name).symlink_to(sources / name)
        for recording in ("lap.mcap", "drive.bag"):
            (checker.folder / recording).write_text("nothing reads it here")
        (checker.folder / "kitti.txt").write_text("1 0 0 0 0 1 0 0 0 0 1 0\n" * 2)
        (checker.folder / "bad_day.yaml").write_text("steps: [{sensor: '*', kind: reboot}]\n")
        (checker.folder / "stamps.txt").write_text("0\n1\n")
        (checker.folder / "stamps.txt").chmod(0o644)
        (checker.folder / "token").write_text("0123456789abcdef\n")
        (checker.folder / "token").chmod(0o600)
        (checker.folder / "user").write_text("east:a secret\n")
        (checker.folder / "user").chmod(0o600)
        (checker.folder / "authorities.pem").write_text("")
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            failures = list(pool.map(checker.examples_fail, packs_of(rows)))
            failures += pool.map(checker.wrong_value_fails, wrong)
            failures += pool.map(checker.section_fails, SECTIONS, (keys[section] for section in SECTIONS))
    failures = unpaired + [failure for failure in failures if failure]
    print("\n".join(failures))
    print(f"{len(rows)} rows, {len(failures)} failures")
    sys.exit(bool(failures))


main()
