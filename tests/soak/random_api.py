# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Random requests to the control API, made from docs/openapi.yaml: most of them valid, some half-valid. Sensors boot,
# sleep, come, go and play recordings meanwhile, and scipd reloads: first on the wall clock, then in lockstep. Three
# clients beside it must miss nothing, no answer to a well-formed request may be a 5xx, and scipd must live.
# `tools/soak MINUTES --api --seed N` runs it. The same seed makes the same choices; which scan a request meets depends
# on the machine.
import argparse
import collections
import contextlib
import http.client
import itertools
import json
import os
import pathlib
import random
import select
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.parse

import yaml

import good
import wire

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests/docs"))
from faults import examples_of  # noqa: E402

PATIENCE_S = 60.0
HALF_VALID = 0.25  # share of the requests
RELOADS = 0.01
COMMANDS = 0.05  # share of the steps that send a SCIP command to a victim
COMMAND = ["VV", "PP", "BM", "QT", "RS", "RB\nRB", "%SL", "TM0\nTM2", "CR00", "MD0000108000003", "GD0000108000", "II"]
RECORDING_S = 1.0  # a recording that takes longer is withdrawn
SCENES = ["square_room.sdf", "corridor.sdf", "crossing.sdf", "materials.sdf"]
SDF = ("<model name='m'><link name='l'><visual name='v'><geometry><box><size>0.1 0.1 0.1</size></box></geometry>"
       "</visual></link></model>")
ODD = [None, True, -1, 0, 1, 2**31, 2**63, 2**64, -1e308, 1e308, 1e-308, 0.5, "", "x" * 300, "\u0000", "é", "../..",
       [], {}, [[]], [None] * 5, {"x": 1}]
# Scans of 25, 25 and 100 ms.
GOOD = {"tcp": {"model": "UST-10LX", "tcp": "127.0.0.1:0", "accuracy": "material"},
        "tty": {"model": "UTM-30LX", "pty": "random-good"},
        "streamed": {"model": "URG-04LX", "tcp": "127.0.0.1:0"}}
VICTIMS = {"ust": {"model": "UST-10LX", "tcp": "127.0.0.1:0"},
           "multi": {"model": "UTM-30LX-EW", "tcp": "127.0.0.1:0", "accuracy": "material", "power_up": "boot"},
           "urg": {"model": "URG-04LX", "tcp": "127.0.0.1:0", "pty": "auto"},
           "played": {"model": "UST-10LX", "tcp": "127.0.0.1:0", "replay": {"file": "scans.jsonl", "loop": "on"}},
           "ended": {"model": "UST-10LX", "tcp": "127.0.0.1:0", "replay": {"file": "scans.jsonl"}},
           "tof": {"camera": {"columns": 16, "rows": 12, "fov_deg": [60, 45], "rate_hz": 20, "range_m": [0.1, 7.5]}},
           "sonar": {"ranger": {"cone_deg": 30, "beams": 61, "rate_hz": 20, "range_m": [0.02, 4.0]}}}
RECORDING = "".join(json.dumps({
    "stamp_ms": 25 * i, "model": "UST-10LX", "first_step": 0,
    "distances_mm": [(1000 + i, 65533, 5)[step // 10 % 3] for step in range(1081)]}) + "\n" for i in range(40))


def configuration(folder, seed, lockstep):
    mount = {"mount": {"xyz": [0, 0, 0.3]}}
    robots = {"good": {"sensors": {name: {**mount, **sensor} for name, sensor in GOOD.items()}},
              "victim": {"pose": {"xyz": [-1, 1, 0]},
                         "sensors": {name: {**mount, **sensor} for name, sensor in VICTIMS.items()}}}
    if lockstep:
        robots["good"]["poses"] = "drive.tum"
    return {"scene": str(ROOT / "scenes/square_room.sdf"), "seed": seed, "control": f"{folder}/control.sock",
            "clock": "poses" if lockstep else "wall", "robots": robots}


class Scipd:
    def __init__(self, program, seed, lockstep):
        self.folder = tempfile.TemporaryDirectory(prefix="scipd-random-")
        folder = pathlib.Path(self.folder.name)
        (folder / "scans.jsonl").write_text(RECORDING)
        (folder / "drive.tum").write_text("".join(f"{i / 2} {i % 40 * 0.02} 0 0 0 0 0 1\n" for i in range(40_000)))
        (folder / "rig.yaml").write_text(json.dumps(configuration(folder, seed, lockstep)))
        self.errors = open(folder / "stderr", "w+")
        self.process = subprocess.Popen([program, "--config", str(folder / "rig.yaml")], stdout=subprocess.PIPE,
                                        stderr=self.errors, env={**os.environ, "XDG_RUNTIME_DIR": str(folder)})
        line = self.process.stdout.readline()
        if not line:
            raise SystemExit("scipd does not start:\n" + (folder / "stderr").read_text())
        self.ready = json.loads(line)
        self.socket = self.ready["control"]

    def sensor(self, name):
        return next(sensor for sensor in self.ready["sensors"] if sensor["name"] == name)

    def tcp(self, name):
        host, port = self.sensor(name)["tcp"].rsplit(":", 1)
        return host, int(port)

    def last_words(self):
        return (pathlib.Path(self.folder.name) / "stderr").read_text(errors="replace")[-3000:]

    def end(self):
        self.process.terminate()
        try:
            return self.process.wait(PATIENCE_S)
        finally:
            self.process.kill()
            self.process.wait()
            self.errors.close()
            self.folder.cleanup()


class Control(http.client.HTTPConnection):
    def __init__(self, path, patience_s):
        super().__init__("localhost", timeout=patience_s)
        self.path = path

    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX)
        self.sock.settimeout(self.timeout)
        self.sock.connect(self.path)


class Beside(threading.Thread):
    """A client that must miss nothing. `read` gives more bytes of a stream of `take`."""

    def __init__(self, name, stream, read, over):
        super().__init__(daemon=True)
        self.name, self.stream, self.read, self.over = name, stream, read, over

    def run(self):
        try:
            while not self.over.is_set():
                data = self.read()
                if data == b"":
                    raise ConnectionError("the connection was closed")
                if data:
                    self.stream.data_received(data)
        except Exception as error:  # it is told at the end
            self.stream.fault = self.stream.fault or repr(error)


class Numbers:
    """The scans of /stream, whose numbers go up by one. A client that answers no ping is cut after five minutes."""

    def __init__(self, link):
        self.link = link
        self.scans = self.missed = self.damaged = 0
        self.last = self.fault = None
        self.buffer = b""

    def data_received(self, data):
        self.buffer += data
        while len(self.buffer) >= 2:
            size, begin = self.buffer[1], 2
            if size > 125:
                begin = 4 if size == 126 else 10
                size = int.from_bytes(self.buffer[2:begin], "big")
            if len(self.buffer) < begin + size or begin > len(self.buffer):
                return
            kind, message, self.buffer = self.buffer[0], self.buffer[begin:begin + size], self.buffer[begin + size:]
            if kind & 0x0F == 8:
                raise ConnectionError(f"/stream was closed: {message!r}")
            if kind & 0x0F == wire.PING:
                self.link.sendall(wire.PONG)
            if kind & 0x0F == 1:
                self.take(json.loads(message))

    def take(self, message):
        if "scan" not in message or "sent_mm" not in message:
            return
        self.scans += 1
        if self.last is not None and message["scan"] != self.last + 1:
            self.missed += 1
            self.fault = self.fault or f"scan {message['scan']} came after {self.last}"
        self.last = message["scan"]


def clients_beside(scipd, over):
    stream = good.Stream("good/tcp", b"MD0000108000000", 1081, 25.0, lambda scans, since: None)
    link = socket.create_connection(scipd.tcp("good/tcp"))
    link.sendall(stream.request + b"\n")
    yield Beside("tcp", stream, socket_reader(link), over)
    stream = good.Stream("good/tty", b"MD0000108000000", 1081, 25.0, lambda scans, since: None)
    tty = wire.open_tty(scipd.sensor("good/tty")["pty"])
    os.write(tty, stream.request + b"\n")
    yield Beside("tty", stream, lambda: os.read(tty, 65536) if select.select([tty], [], [], 0.1)[0] else None, over)
    link = socket.socket(socket.AF_UNIX)
    link.connect(scipd.socket)
    link.sendall(b"GET /stream?sensor=good/streamed HTTP/1.1\r\nHost: localhost\r\n" + wire.UPGRADE.encode() + b"\r\n")
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        head += link.recv(1)
    yield Beside("stream", Numbers(link), socket_reader(link), over)


def socket_reader(link):
    return lambda: link.recv(1 << 18) if select.select([link], [], [], 0.1)[0] else None


class Maker:
    """Values that a schema has, made at random."""

    def __init__(self, document, rng, known):
        self.document, self.rng, self.known = document, rng, known

    def resolved(self, schema):
        while "$ref" in schema:
            at = self.document
            for part in schema["$ref"][2:].split("/"):
                at = at[part.replace("~1", "/")]
            schema = at
        return schema

    def value(self, schema, name="", depth=0):
        schema, rng = self.resolved(schema), self.rng
        if self.known.get(name) and rng.random() < 0.85:
            return rng.choice(self.known[name])
        for one in ("oneOf", "anyOf"):
            if one in schema and "properties" not in schema:
                return self.value(rng.choice(schema[one]), name, depth)
        if "const" in schema:
            return schema["const"]
        if "enum" in schema:
            return rng.choice(schema["enum"])
        kind = schema.get("type", "object" if "properties" in schema else "string")
        if isinstance(kind, list):
            kind = rng.choice(kind)
        return getattr(self, "a_" + kind)(schema, depth)

    def a_object(self, schema, depth):
        wanted = set(schema.get("required", []))
        if "oneOf" in schema:
            wanted |= set(self.resolved(self.rng.choice(schema["oneOf"])).get("required", []))
        properties = schema.get("properties", {})
        alternatives = {name for one in schema.get("oneOf", []) for name in one.get("required", [])}
        made = {name: self.value(of, name, depth + 1) for name, of in properties.items()
                if name in wanted or name not in alternatives and self.rng.random() < 0.3}
        more = schema.get("additionalProperties")
        if isinstance(more, dict):
            made |= {name: self.value(more, "", depth + 1)
                     for name in self.rng.sample(self.known["sensor_name"], self.rng.randrange(3))}
        return made

    def a_array(self, schema, depth):
        least = schema.get("minItems", 0)
        most = min(schema.get("maxItems", least + 3), least + 6)
        return [self.value(schema.get("items", {}), "", depth + 1) for _ in range(self.rng.randint(least, most))]

    def a_number(self, schema, _):
        low = schema.get("minimum", schema.get("exclusiveMinimum", -10))
        high = schema.get("maximum", schema.get("exclusiveMaximum", low + 20))
        near = min(high, low + 5)
        return self.rng.choice([low, high, self.rng.uniform(low, near), self.rng.uniform(low, near),
                                round(self.rng.uniform(low, near), 2)])

    def a_integer(self, schema, _):
        low = schema.get("minimum", 0)
        high = schema.get("maximum", low + 2000)
        return self.rng.choice([low, high, self.rng.randint(low, high), self.rng.randint(low, min(high, low + 10))])

    def a_string(self, schema, _):
        return self.rng.choice(["a", "robot", "some name", "x" * self.rng.randrange(1, 40)])

    def a_boolean(self, *_):
        return self.rng.random() < 0.5

    def a_null(self, *_):
        return None

    def spoilt(self, value):
        """The value with one thing wrong, or at least odd, somewhere in it."""
        rng = self.rng
        if isinstance(value, dict) and value and rng.random() < 0.8:
            name = rng.choice(list(value))
            deed = rng.random()
            rest = {key: of for key, of in value.items() if key != name}
            if deed < 0.2:
                return rest
            if deed < 0.3:
                return {**value, rng.choice(["odd", name.upper(), ""]): rng.choice(ODD)}
            return {**rest, name: self.spoilt(value[name])}
        if isinstance(value, list) and value and rng.random() < 0.7:
            i = rng.randrange(len(value))
            return value[:i] + [self.spoilt(value[i])] * rng.choice([1, 1, 2]) + value[i + 1:]
        return rng.choice(ODD)


class Asker:
    def __init__(self, scipd, document, kinds, seed):
        self.scipd, self.document, self.rng = scipd, document, random.Random(seed)
        self.operations = [(method.upper(), path, item.get("parameters", []) + operation.get("parameters", []),
                            operation.get("requestBody"))
                           for path, item in document["paths"].items() for method, operation in item.items()
                           if method != "parameters"]
        names = [f"victim/{name}" for name in VICTIMS] + ["victim/new", "guest/new"]
        self.known = {
            "file": [str(ROOT / "scenes" / scene) for scene in SCENES] + ["square_room.sdf", "missing.sdf"],
            "sdf": [SDF, SDF.replace("box", "bax"), "<model"], "yaml": self.scenarios(kinds), "kind": [],
            "model": ["UST-10LX", "URG-04LX", "UTM-30LX-EW"], "tcp": ["127.0.0.1:0", "none"],
            "pty": ["auto", "none"], "name": ["a", "b", "guest/new", "victim/new", "victim/again"],
            "mesh_format": ["stl", "obj"], "mesh_data": ["AAAA", "c29saWQgYQplbmRzb2xpZCBhCg=="],
            "material": ["glass", "default", "steel"], "sensor_name": names,
            "until": ["RB", "QT"], "t": [0.0]}
        self.maker = Maker(document, self.rng, self.known)
        self.kinds = kinds
        self.counts = collections.Counter()  # by method, path and status
        self.did = collections.Counter()
        self.failures = []
        self.there = {"model": [], "mesh": []}  # in the world, some steps ago

    def scenarios(self, kinds):
        return [json.dumps({"steps": [{"sensor": f"victim/{name}", **fault, "for": {"s": 1}}]})
                for name, fault in itertools.product(("ust", "played"), kinds[::5])] + ["steps: []", "steps: [", ""]

    def segment(self, name):
        """Good sensors are read, and not changed."""
        robots = {"robot": ["victim"] * 8 + ["guest", "nobody"], "file": ["main.js", "style.css", "none"],
                  "sensor": [*VICTIMS, "new", "again", "nothing"], "fault": ["1", "2", "3", "7", "0", "x"],
                  "model": ["a", "b", "m::l", *self.there["model"]], "mesh": ["0", "x", *self.there["mesh"]]}
        return self.rng.choice(robots[name])

    def fault(self):
        fault = dict(self.rng.choice(self.kinds))
        return {**fault, "for": {"s": round(self.rng.uniform(0.05, 2.0), 2)}} if self.rng.random() < 0.8 else fault

    def request(self):
        method, path, parameters, body = self.rng.choice(self.operations)
        target, query = path, {}
        for parameter in map(self.maker.resolved, parameters):
            name = parameter["name"]
            if parameter["in"] == "path":
                value = self.segment(name)
                target = target.replace("{" + name + "}", urllib.parse.quote(value, safe=""))
            elif self.rng.random() < 0.6:
                value = self.maker.value(parameter["schema"], name)
                if name == "scans" and self.rng.random() < 0.8:
                    value = self.rng.randint(1, 5)
                if name == "sensor":
                    value = self.rng.choice(self.known["sensor_name"])
                query[name] = self.rng.choice(ODD) if self.rng.random() < HALF_VALID / 2 else value
        if method == "GET" and "{robot}/{sensor}" in path and self.rng.random() < 0.2:
            target = path.replace("{robot}", "good").replace("{sensor}", self.rng.choice(list(GOOD)))
            target = target.replace("{fault}", "1")
        if query:
            target += "?" + urllib.parse.urlencode(query)
        if body is None:
            return method, path, target, None
        schema = next(iter(body["content"].values()))["schema"]
        made = self.fault() if path.endswith("/faults") else self.maker.value(schema)
        if self.rng.random() < HALF_VALID:
            made = self.maker.spoilt(made)
        # `*` of a scenario, or the name of a good sensor, would have the good clients miss something.
        return method, path, target, json.dumps(made).replace("good/", "victim/").replace("*", "x")

    def ask(self, method, path, target, body):
        talk = Control(self.scipd.socket, RECORDING_S if path.endswith("/recording") else PATIENCE_S)
        try:
            talk.request(method, target, body, {"Content-Type": "application/json"} if body is not None else {})
            answer = talk.getresponse()
            text = answer.read()
        except socket.timeout:
            assert path.endswith("/recording"), f"{method} {target} {(body or '')[:500]}: no answer"
            self.counts[method, path, "withdrawn"] += 1
            return
        finally:
            talk.close()
        self.counts[method, path, answer.status] += 1
        if answer.status >= 500:
            self.failures.append(f"{method} {target} {(body or '')[:500]}: {answer.status} {text[:300]!r}")

    def talk(self, path, target):
        """A WebSocket: a few messages, valid and odd ones."""
        with socket.socket(socket.AF_UNIX) as link:
            link.settimeout(PATIENCE_S)
            link.connect(self.scipd.socket)
            link.sendall(f"GET {target} HTTP/1.1\r\nHost: localhost\r\n{wire.UPGRADE}\r\n".encode())
            status = int(link.recv(65536).split()[1])
            self.counts["WS", path, status] += 1
            if status >= 500:
                self.failures.append(f"WebSocket {target}: {status}")
            schemas = {"/view": "ViewRequest", "/poses": "PoseRequest"}
            for _ in range(self.rng.randrange(4)):
                message = self.maker.value({"$ref": "#/components/schemas/" + schemas.get(path, "PoseRequest")})
                if path == "/poses" and isinstance(message, dict):
                    message["robot"] = "victim"
                if self.rng.random() < HALF_VALID:
                    message = self.maker.spoilt(message)
                with contextlib.suppress(OSError):
                    link.sendall(wire.text_frame(json.dumps(message).replace("good", "victim").encode()))
                    if select.select([link], [], [], 0.05)[0]:
                        link.recv(1 << 18)

    def command(self):
        """A careless client of a victim: it boots, sleeps, streams or asks, and reads a little of it."""
        name = self.rng.choice([name for name, sensor in VICTIMS.items() if "tcp" in sensor])
        with contextlib.suppress(OSError), socket.create_connection(self.scipd.tcp(f"victim/{name}"), 1.0) as link:
            link.settimeout(0.1)
            link.sendall(self.rng.choice(COMMAND).encode() + b"\n")
            with contextlib.suppress(OSError):
                link.recv(65536)
        self.did["SCIP commands"] += 1

    def step(self):
        deed = self.rng.random()
        if deed < RELOADS:
            self.scipd.process.send_signal(signal.SIGHUP)
            self.did["reloads"] += 1
        elif deed < RELOADS + COMMANDS:
            self.command()
        else:
            method, path, target, body = self.request()
            if path in ("/stream", "/view", "/wire", "/poses") and self.rng.random() < 0.8:
                self.talk(path, target)
            else:
                self.ask(method, path, target, body)
        if self.did["steps"] % 20 == 0:
            self.look_around()
        self.did["steps"] += 1

    def look_around(self):
        for sensor in self.read("/sensors"):
            self.did["state " + str(sensor.get("state"))] += 1
        objects = self.read("/scene/objects")["objects"]
        self.there = {name: sorted({thing[name] for thing in objects}) for name in self.there}

    def read(self, target):
        with contextlib.closing(Control(self.scipd.socket, PATIENCE_S)) as talk:
            talk.request("GET", target)
            return json.loads(talk.getresponse().read())


def examples():
    """The example of each kind of fault, without its duration."""
    for _, fault in examples_of(ROOT / "docs/faults.md"):
        yield {key: value for key, value in fault.items() if key not in ("for", "until")}


def run(program, document, seed, seconds, lockstep, slow):
    scipd = Scipd(program, seed, lockstep)
    over = threading.Event()
    asker = Asker(scipd, document, list(examples()), seed)
    beside = list(clients_beside(scipd, over))
    for client in beside:
        client.start()
    end = time.monotonic() + seconds
    try:
        while time.monotonic() < end and scipd.process.poll() is None:
            asker.step()
    except (OSError, AssertionError, http.client.HTTPException) as error:
        asker.failures.append(f"step {asker.did['steps']}: {error!r}")
    time.sleep(0.5)
    over.set()
    for client in beside:
        client.join(PATIENCE_S)
    if scipd.process.poll() is not None:
        asker.failures.append(f"scipd has ended by itself at step {asker.did['steps']}, {scipd.process.poll()}: "
                              f"{scipd.last_words()}")
    elif exit_code := scipd.end():
        asker.failures.append(f"scipd ended with {exit_code}")
    for client in beside:
        stream = client.stream
        missed = stream.missed if lockstep or not slow else 0
        if missed or stream.damaged or stream.fault or not stream.scans:
            asker.failures.append(f"the client on {client.name} missed {stream.missed} scans of {stream.scans}, "
                                  f"{stream.damaged} damaged: {stream.fault}")
    tell("lockstep" if lockstep else "the wall clock", seed, asker, beside)
    return asker.failures


def tell(clock, seed, asker, beside):
    by_status = collections.Counter()
    succeeded = {}
    for (method, path, status), count in asker.counts.items():
        by_status[str(status)] += count
        succeeded[method, path] = succeeded.get((method, path), False) or status in (101, 200, 201, 204, 304)
    print(f"On {clock}, seed {seed}: {asker.did['steps']} steps; answers: "
          f"{', '.join(f'{count} x {status}' for status, count in sorted(by_status.items()))}; "
          f"{', '.join(f'{count} x {what}' for what, count in sorted(asker.did.items()) if what != 'steps')}")
    print("  beside it: " + ", ".join(f"{client.stream.scans} scans on {client.name}" for client in beside))
    never = sorted(" ".join(operation) for operation, done in succeeded.items() if not done)
    print(f"  {len(succeeded)} operations, {len(succeeded) - len(never)} succeeded at least once" +
          (f", not {', '.join(never)}" if never else ""))


def main():
    parser = argparse.ArgumentParser(prog="tools/soak --api", description="Random requests to the control API of scipd")
    parser.add_argument("minutes", nargs="?", type=float, default=10.0, help="how long; default: 10")
    parser.add_argument("--seed", type=int, default=1, help="seed of all choices; default: 1")
    parser.add_argument("--slow", action="store_true",
                        help="do not judge scans missed on the wall clock: for a scipd with sanitizers")
    parser.add_argument("--scipd", default=str(ROOT / "build/release/bin/scipd"), help="the program to test")
    said = parser.parse_args()
    document = yaml.safe_load((ROOT / "docs/openapi.yaml").read_text())
    failures = [failure for lockstep in (False, True)
                for failure in run(said.scipd, document, said.seed, said.minutes * 30.0, lockstep, said.slow)]
    for failure in failures[:50]:
        print("FAILED:", failure)
    return bool(failures)


if __name__ == "__main__":
    raise SystemExit(main())
