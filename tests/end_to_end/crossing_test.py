# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Each kind of fault, in a closed room and in an open world, at scanners of each accuracy that cast or play a recording,
# at a camera and at a ranger, is read by every route and tool that reads a measurement. All answer, the answers agree,
# and scipd lives. Kinds come from GET /faults/kinds with the examples of docs/faults.md, accuracies, formats and routes
# from docs/openapi.yaml: a new one joins on its own.
# crossing_test.py SCIPD SCIPCAT SCIPCTL SOURCES [KIND..]
import collections
import contextlib
import json
import pathlib
import re
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import yaml

from fault_lab import PATIENCE_S, Control, Lab, wait_for
from wire import PING, PONG, UPGRADE, text_frame

sys.path.append(str(pathlib.Path(__file__).parents[1] / "docs"))
from faults import examples_of  # noqa: E402

TURNS_S = 0.3  # time for two scans of 25 ms under a fault; some faults let no scan pass
TOOL_S = 1.5  # most time for a tool whose scan a fault may hold back
# Scans of kinds in these layers go to clients as without a fault, so that tools must succeed.
SOUND_LAYERS = {"scans", "world"}
HOLDS_BACK = {"skip", "repeat", "reorder", "late"}
STARING = {"camera": {"camera": {"columns": 8, "rows": 6, "fov_deg": [40, 30], "rate_hz": 25, "range_m": [0.1, 7.5]}},
           "ranger": {"ranger": {"cone_deg": 30, "beams": 61, "rate_hz": 20, "range_m": [0.02, 4.0]}}}
SCANNER = {"tcp": "127.0.0.1:0", "pty": "auto"}
MOUNT = {"mount": {"xyz": [0, 0, 0.3]}}
CLOSED, OPEN = "square_room.sdf", "corridor.sdf"
CAST, PLAYED = "UTM-30LX-EW", "UST-10LX"
STEPS = 1081
# Ranges, what is too near, what is too far, and codes.
RECORDING = "".join(json.dumps({
    "stamp_ms": 25 * i, "model": PLAYED, "first_step": 0, "intensities": [i] * STEPS,
    "distances_mm": [(1000 + i, 65533, 5, 29000, 65534)[step // 10 % 5] for step in range(STEPS)]}) + "\n"
    for i in range(8))
COLOURS = ["error", "material"]


class Messages(threading.Thread):
    """A WebSocket of the control API. Keeps the latest message by what `key` has of it, and how many came."""

    def __init__(self, path, target, key):
        super().__init__(daemon=True)
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(str(path))
        self.socket.sendall(f"GET {target} HTTP/1.1\r\nHost: localhost\r\n{UPGRADE}\r\n".encode())
        self.file = self.socket.makefile("rb")
        head = b""
        while not head.endswith(b"\r\n\r\n"):
            head += self.file.readline() or sys.exit(f"{target} is no WebSocket: {head!r}")
        assert b" 101 " in head.splitlines()[0], f"{target}: {head!r}"
        self.key = key
        self.counts, self.latest = collections.Counter(), {}
        self.start()

    def say(self, message):
        self.socket.sendall(text_frame(json.dumps(message).encode()))

    def run(self):
        with contextlib.suppress(OSError, ValueError, struct.error):
            while True:
                first, size = self.file.read(2)
                if size > 125:
                    size = int.from_bytes(self.file.read(2 if size == 126 else 8), "big")
                data = self.file.read(size)
                if first & 0x0F == PING:
                    self.socket.sendall(PONG)
                    continue
                name = self.key(data)
                if name:
                    self.latest[name] = data
                    self.counts[name] += 1


class Driver(threading.Thread):
    """Has a scanner stream to it, and begins anew whenever that ends."""

    def __init__(self, address):
        super().__init__(daemon=True)
        self.address = address
        self.start()

    def run(self):
        while True:
            with contextlib.suppress(OSError), socket.create_connection(self.address, 1.0) as link:
                link.settimeout(0.2)
                link.sendall(b"BM\nMD0000108000000\n")
                while link.recv(1 << 18):
                    time.sleep(0.01)
            time.sleep(0.05)


def name_in_json(data):
    found = re.search(rb'"sensor":"robot/([^"]+)"', data)
    return found.group(1).decode() if found else None


def name_of_scan(data):
    """Of /stream, which tells of faults as well."""
    return name_in_json(data) if b'"sent_mm"' in data or b'"range_m"' in data else None


def header_of_frame(data):
    return json.loads(data[12:12 + struct.unpack("<I", data[8:12])[0]])


def name_of_frame(data):
    return header_of_frame(data)["sensor"].split("/")[1] if data[:4] == b"SCV1" else None


def frame_is_whole(data):
    header = header_of_frame(data)
    sizes = {"f32": 4, "i32": 4, "u32": 4, "i16": 2, "u16": 2, "u8": 1}
    at = 12 + struct.unpack("<I", data[8:12])[0]
    for array in header["arrays"]:
        at = (at + 3) // 4 * 4 + sizes[array["type"]] * array["length"]
    assert abs(len(data) - at) < 4, f"a frame of {len(data)} bytes that has {at}"
    names = [array["name"] for array in header["arrays"]]
    assert "true_m" in names and "material" in names, names


def examples(control, sources):
    """A lasting fault of each kind, but for those that are over at once: (layer, fault)."""
    written = dict(examples_of(sources / "docs/faults.md"))
    for kind in control.ask("GET", "/faults/kinds")[1]:
        fault = {key: value for key, value in written[kind["kind"]].items() if key not in ("at", "until")}
        yield kind["layer"], fault | ({"for": {"s": 600}} if "for" in fault else {})


def sensor_routes(document):
    """The rest of each path below /sensors/{robot}/{sensor} that can be read."""
    prefix = "/sensors/{robot}/{sensor}"
    return [path[len(prefix):] for path, item in document["paths"].items()
            if path.startswith(prefix) and "get" in item]


class Crossing:
    def __init__(self, lab, programs, sources):
        self.lab, self.sources = lab, sources
        _, self.scipcat, self.scipctl = programs
        self.document = yaml.safe_load((sources / "docs/openapi.yaml").read_text())
        self.routes = sensor_routes(self.document)
        self.formats = parameter(self.document, "/sensors/{robot}/{sensor}/recording", "format")
        self.names = [sensor["name"].split("/")[1] for sensor in lab.ready["sensors"]]
        self.scanners = [name for name in self.names if name not in STARING]
        path = lab.ready["control"]
        self.stream = Messages(path, "/stream", name_of_scan)
        self.view = Messages(path, "/view", name_of_frame)
        self.view.say({"scans": {f"robot/{name}": {"true": True} for name in self.names}})
        self.wires = {name: Messages(path, f"/wire?sensor=robot/{name}", name_in_json) for name in self.scanners}
        self.drivers = [Driver(lab.address(name)) for name in self.scanners]
        self.pool = ThreadPoolExecutor(4)
        self.combinations = self.survivors = self.unmet = 0
        self.failures = []

    def ask(self, method, target, body=None):
        return Control(self.lab.ready["control"]).ask(method, target, body)

    def get(self, target):
        """The status and the body, which may be no JSON."""
        talk = Control(self.lab.ready["control"])
        talk.request("GET", target)
        answer = talk.getresponse()
        body = answer.read()
        talk.close()
        return answer.status, body

    def combine(self, place, check, *arguments):
        """One combination: the check of it holds, and scipd lives."""
        self.combinations += 1
        try:
            check(*arguments)
            assert self.lab.process.poll() is None, f"scipd has ended, {self.lab.process.poll()}"
            self.survivors += 1
        except (AssertionError, OSError, ValueError, KeyError, subprocess.TimeoutExpired) as error:
            self.failures.append(f"{place}: {type(error).__name__}: {str(error)[:300]}")
            if self.lab.process.poll() is not None:
                sys.exit(f"{place}: scipd has ended, {self.lab.process.poll()}")

    def load(self, world):
        status, answer = self.ask("PUT", "/scene", {"file": str(self.sources / "scenes" / world)})
        assert status == 200, answer

    def begin(self, fault):
        """The ids of the fault at all scanners. Cameras and rangers have none."""
        ids = {}
        for name in self.names:
            status, answer = self.ask("POST", f"/sensors/robot/{name}/faults", fault)
            assert status == (201 if name in self.scanners else 409), (fault, name, answer)
            ids[name] = answer.get("id", 1)
        return ids

    def wait(self, before):
        """Two scans of each sensor, where the fault lets them pass."""
        end = time.monotonic() + TURNS_S
        while time.monotonic() < end and any(self.stream.counts[name] < before[name] + 2 for name in self.names):
            time.sleep(0.01)

    def route(self, name, rest, fault_id):
        status, body = self.get(f"/sensors/robot/{name}{rest.replace('{fault}', str(fault_id))}")
        assert status in (200, 404, 409), (status, body[:200])
        if rest == "/truth":
            assert status == 200, (status, body[:200])
            self.check_truth(name, json.loads(body))
        if rest == "/reading":
            assert status == (200 if name in STARING else 404), (status, body[:200])

    def check_truth(self, name, truth):
        beams = len(truth["true_m"])
        for member, values in truth.items():
            if isinstance(values, list) and member not in ("poses", "echoes") and not member.startswith("sent_echoes"):
                assert len(values) == beams, f"{member} has {len(values)} elements, not {beams}"
        unmet = [i for i, true_m in enumerate(truth["true_m"]) if true_m is None]
        for member in ("object", "material", "incidence_rad", "bias_m"):
            assert all(truth[member][i] is None for i in unmet if member in truth), f"{member} of what nothing met"
        if name in STARING:
            return
        assert beams == STEPS and truth["accuracy"] == name.split("_")[1], truth["accuracy"]
        self.unmet += sum(truth["cause"][i] == "measured" for i in unmet)
        played = name.startswith("played")
        assert (truth["backend"] == "recording") == played, truth["backend"]
        assert not played or len(unmet) == beams, "a recording whose truth is known"
        streamed = json.loads(self.stream.latest[name])
        if streamed["scan"] == truth["scan"]:
            assert streamed["sent_mm"] == truth["sent_mm"], "the truth tells another scan than /stream"

    def recording(self, name, kind, taken):
        """Once the fault is over there are scans again."""
        status, body = taken.result(PATIENCE_S)
        assert status == 200 and body, (name, kind, status, body[:200])

    def streamed(self, messages, name, check):
        assert name in messages.latest, "no message yet"
        check(messages.latest[name])

    def everywhere(self, target):
        status, body = self.get(target)
        assert status == 200 and all(f"robot/{name}".encode() in body or b'"sensor"' not in body
                                     for name in self.names), (status, body[:200])

    def tool(self, words, must_succeed):
        """A tool that gets no scan says so; no tool dies of it."""
        try:
            done = subprocess.run([str(word) for word in words], capture_output=True, check=False,
                                  timeout=PATIENCE_S if must_succeed else TOOL_S)
        except subprocess.TimeoutExpired:
            assert not must_succeed, f"{words} does not end"
            return
        assert 0 <= done.returncode < 128, (words, done.returncode, done.stderr[-200:])
        assert done.returncode == 0 or not must_succeed, (words, done.returncode, done.stderr[-200:])

    def tools_of(self, name, must_succeed):
        control = ["--control", self.lab.ready["control"]]
        yield "scipctl truth", [self.scipctl, *control, "truth", f"robot/{name}"], True
        if name in self.scanners:
            for colour in COLOURS:
                words = [self.scipcat, "plot", self.lab.tty(name), "--color", colour, *control]
                yield f"scipcat plot --color {colour}", words, must_succeed

    def read_all(self, place, layer, kind, ids, number):
        for name in self.names:
            for rest in self.routes:
                if rest != "/recording":
                    self.combine((*place, name, rest), self.route, name, rest, ids[name])
            self.combine((*place, name, "/stream"), self.streamed, self.stream, name, json.loads)
            self.combine((*place, name, "/view"), self.streamed, self.view, name, frame_is_whole)
            if name in self.view.latest:  # the next frame, of what is measured from now on
                self.view.say({"ack": struct.unpack("<I", self.view.latest[name][4:8])[0]})
            if name in self.wires:
                self.combine((*place, name, "/wire"), self.streamed, self.wires[name], name, json.loads)
        for target in ("/metrics", "/status", "/sensors", "/scene/objects"):
            self.combine((*place, target), self.everywhere, target)
        sound = layer in SOUND_LAYERS and kind not in HOLDS_BACK
        # A tool is a process: not every sensor has all of them in both worlds.
        turn = number % (len(self.scanners) // 2)
        one_of_each = self.scanners[turn::len(self.scanners) // 2]
        chosen = (one_of_each if sound else []) if place[1] == CLOSED else (self.scanners if sound else one_of_each)
        chosen = [*chosen, *(STARING if number == 0 else [])]

        def use_tools(name):  # one after the other, as they share the tty
            for tool, words, must in self.tools_of(name, sound):
                self.combine((*place, name, tool), self.tool, words, must)

        for done in [self.pool.submit(use_tools, name) for name in chosen]:
            done.result()

    def cross(self, number, layer, fault):
        self.load(CLOSED)
        before = self.stream.counts.copy()
        ids = self.begin(fault)
        taken = {}
        for world in (CLOSED, OPEN):
            place = (fault["kind"], world)
            if world == OPEN:
                before = self.stream.counts.copy()
                self.load(world)
            self.wait(before)
            self.read_all(place, layer, fault["kind"], ids, number)
            # Four at once; the next kind has the other scanners.
            for i in range(2):
                name = self.scanners[(2 * number + i) % len(self.scanners)]
                kind = self.formats[(number + i) % len(self.formats)]
                target = f"/sensors/robot/{name}/recording?format={kind}&scans=2"
                taken[(*place, name, target)] = ThreadPoolExecutor(1).submit(self.get, target)
        for name in self.scanners:
            status, answer = self.ask("DELETE", f"/sensors/robot/{name}/faults")
            assert status == 204, answer
        for place, answer in taken.items():
            self.combine(place, self.recording, place[2], place[3], answer)


def parameter(document, path, name):
    item = document["paths"][path]
    return next(p["schema"]["enum"] for p in item["parameters"] if p.get("name") == name)


def main(*arguments):
    *programs, sources = (pathlib.Path(argument).resolve() for argument in arguments[:4])
    document = yaml.safe_load((sources / "docs/openapi.yaml").read_text())
    accuracies = document["components"]["schemas"]["Truth"]["properties"]["accuracy"]["enum"]
    sensors = {f"cast_{accuracy}": {**SCANNER, **MOUNT, "model": CAST, "accuracy": accuracy}
               for accuracy in accuracies}
    with contextlib.ExitStack() as stack:
        folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory()))
        (folder / "scans.jsonl").write_text(RECORDING)
        sensors |= {f"played_{accuracy}": {**SCANNER, "model": PLAYED, "accuracy": accuracy,
                                           "replay": {"file": str(folder / "scans.jsonl"), "loop": "on"}}
                    for accuracy in accuracies}
        sensors |= {name: {**MOUNT, **sensor} for name, sensor in STARING.items()}
        lab = stack.enter_context(Lab(str(programs[0]), sources / "scenes" / CLOSED, sensors=sensors,
                                      lockstep=False))
        crossing = Crossing(lab, programs, sources)
        wait_for(lambda: set(crossing.names) <= set(crossing.stream.latest) and
                 set(crossing.scanners) <= {n for n, w in crossing.wires.items() if w.latest}, "scans of all sensors")
        faults = [(layer, fault) for layer, fault in examples(lab.control, sources)
                  if not arguments[4:] or fault["kind"] in arguments[4:]]
        begin_s = time.monotonic()
        for number, (layer, fault) in enumerate(faults):
            crossing.cross(number, layer, fault)
        print("\n".join(crossing.failures))
        print(f"{len(faults)} kinds of faults x 2 worlds x {len(crossing.names)} sensors: {crossing.combinations} "
              f"combinations, {crossing.survivors} survivors, {crossing.unmet} readings of beams that met nothing, in "
              f"{time.monotonic() - begin_s:.0f} s")
        assert lab.process.poll() is None
    if crossing.failures:
        sys.exit(f"{len(crossing.failures)} combinations failed")
    assert crossing.unmet, "no fault has made a reading of a beam that met nothing"


if __name__ == "__main__":
    main(*sys.argv[1:])
