# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Compares docs/openapi.yaml with a running scipd. Both have the same paths and methods, every documented answer occurs,
# and each fits its schema. openapi_test.py SCIPD DOCUMENT SCENE
import http.client
import json
import pathlib
import re
import socket
import subprocess
import sys
import tempfile

import jsonschema
import yaml

from fault_lab import Control

SDF = ("<model name='m'><link name='l'><visual name='v'><geometry><box><size>0.1 0.1 0.1</size></box></geometry>"
       "</visual></link></model>")
LIDAR = ("<model name='l'><link name='l'><sensor name='s' type='gpu_lidar'><lidar><scan><horizontal>"
         "<samples>9</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>"
         "<range><min>0.1</min><max>inf</max></range></lidar></sensor>"
         "<visual name='v'><geometry><box><size>0.1 0.1 0.1</size></box></geometry></visual></link></model>")
RIG = """
scene: SCENE
control: control.sock
http: {listen: 127.0.0.1:0, token_file: token}
limits: {added_models: 2}
robots:
  robot:
    sensors:
      scanner: {model: UST-10LX, pty: tty}
      multi: {model: UTM-30LX-EW, tcp: "127.0.0.1:0", accuracy: material}
      tof:
        camera: {columns: 8, rows: 6, fov_deg: [40, 30], rate_hz: 25, range_m: [0.1, 7.5]}
        mount: {xyz: [0, 0, 0.3]}
      sonar: {ranger: {cone_deg: 30, beams: 61, rate_hz: 20, range_m: [0.02, 4.0]}, mount: {xyz: [0, 0, 0.5]}}
      played: {model: UST-10LX, tcp: "127.0.0.1:0", replay: {file: scans.jsonl, loop: on}}
"""
SCANS = "".join(json.dumps({"stamp_ms": 25 * i, "first_step": 0, "distances_mm": [1000 + i] * 1081}) + "\n"
                for i in range(8))
TRUTH = "/sensors/{robot}/{sensor}/truth"
RECORDING = "/sensors/{robot}/{sensor}/recording"
READING = "/sensors/{robot}/{sensor}/reading"
REPLAY = "/sensors/{robot}/{sensor}/replay"
POSE = "/scene/models/{model}/pose"
MATERIAL = "/scene/models/{model}/material"
MEDIA = "/scene/media"
FAULTS = "/sensors/{robot}/{sensor}/faults"
FAULT = FAULTS + "/{fault}"
LOG = FAULTS + "/log"
SCANNER = "/sensors/robot/scanner/faults"
STEPS = "steps:\n- {sensor: robot/scanner, kind: reboot}\n- {sensor: \"*\", kind: stall, for: {scans: 1000}}\n"
FOG_AND_STEAM = [{"kind": "fog", "visibility_m": 20, "box": {"from": [0, 0, 0], "to": [2, 2, 3]}},
                 {"kind": "custom", "name": "steam", "extinction_per_m": 0.5, "returns_per_m": 2, "brightness": 0.2}]
# In this order: method, path in the document, path of the request, body, status.
EXCHANGES = [
    ("GET", "/", "/", None, 200),
    ("GET", "/", "/", None, 304),
    ("GET", "/favicon.ico", "/favicon.ico", None, 200),
    ("GET", "/page/{file}", "/page/main.js", None, 200),
    ("GET", "/page/{file}", "/page/other.js", None, 404),
    ("GET", "/status", "/status", None, 200),
    ("GET", "/health", "/health", None, 200),
    ("GET", "/metrics", "/metrics", None, 200),
    ("GET", "/sensors", "/sensors", None, 200),
    ("GET", "/sensors/{robot}/{sensor}", "/sensors/robot/scanner", None, 200),
    ("GET", "/sensors/{robot}/{sensor}", "/sensors/robot/other", None, 404),
    ("PATCH", "/sensors/{robot}/{sensor}", "/sensors/robot/multi", {"noise": 2, "bias": "none"}, 200),
    ("PATCH", "/sensors/{robot}/{sensor}", "/sensors/robot/multi", {"bias": [{"range_m": 1, "bias_m": 0.01}]}, 200),
    ("PATCH", "/sensors/{robot}/{sensor}", "/sensors/robot/multi", {"accuracy": "best"}, 400),
    ("PATCH", "/sensors/{robot}/{sensor}", "/sensors/robot/other", {"noise": 2}, 404),
    ("PATCH", "/sensors/{robot}/{sensor}", "/sensors/robot/tof", {"noise": 2}, 409),
    ("PATCH", "/sensors/{robot}/{sensor}", "/sensors/robot/played", {"noise": 2}, 409),
    ("GET", "/sensors/models", "/sensors/models", None, 200),
    ("POST", "/sensors", "/sensors", {"name": "other/rear", "model": "URG-04LX", "pty": "auto",
                                      "pose": {"xyz": [1, 0, 0]}, "mount": {"rpy": [0, 0, 3]}}, 201),
    ("POST", "/sensors", "/sensors", {"name": "robot/rear", "model": "URG-05LX", "pty": "auto"}, 400),
    ("POST", "/sensors", "/sensors", {"name": "robot/rear", "model": "URG-04LX", "pty": "/tmp/tty"}, 403),
    ("POST", "/sensors", "/sensors", {"name": "robot/multi", "model": "URG-04LX", "pty": "auto"}, 409),
    ("DELETE", "/sensors/{robot}/{sensor}", "/sensors/other/rear", None, 204),
    ("DELETE", "/sensors/{robot}/{sensor}", "/sensors/other/rear", None, 404),
    ("GET", READING, "/sensors/robot/tof/reading", None, 200),
    ("GET", READING, "/sensors/robot/sonar/reading", None, 200),
    ("GET", READING, "/sensors/robot/scanner/reading", None, 404),
    ("GET", REPLAY, "/sensors/robot/played/replay", None, 200),
    ("GET", REPLAY, "/sensors/robot/scanner/replay", None, 409),
    ("GET", REPLAY, "/sensors/robot/other/replay", None, 404),
    ("PATCH", REPLAY, "/sensors/robot/played/replay", {"at_s": 0.1, "paused": True, "speed": 2}, 200),
    ("PATCH", REPLAY, "/sensors/robot/played/replay", {"step": 3}, 200),
    ("PATCH", REPLAY, "/sensors/robot/played/replay", {"step": 0}, 400),
    ("PATCH", REPLAY, "/sensors/robot/tof/replay", {"step": 3}, 409),
    ("PATCH", REPLAY, "/sensors/robot/other/replay", {"step": 3}, 404),
    ("GET", RECORDING, "/sensors/robot/scanner/recording?scans=1", None, 200),
    ("GET", RECORDING, "/sensors/robot/scanner/recording?scans=0", None, 400),
    ("GET", RECORDING, "/sensors/robot/other/recording", None, 404),
    ("GET", RECORDING, "/sensors/robot/tof/recording", None, 409),
    ("GET", TRUTH, "/sensors/robot/scanner/truth", None, 200),
    ("GET", TRUTH, "/sensors/robot/multi/truth", None, 200),
    ("GET", TRUTH, "/sensors/robot/tof/truth", None, 200),
    ("GET", TRUTH, "/sensors/robot/sonar/truth", None, 200),
    ("GET", TRUTH, "/sensors/robot/scanner/truth?scan=x", None, 400),
    ("GET", TRUTH, "/sensors/robot/scanner/truth?scan=-5", None, 404),
    ("GET", "/faults/kinds", "/faults/kinds", None, 200),
    ("POST", FAULTS, SCANNER, {"kind": "stall", "for": {"s": 0.01}}, 201),
    ("POST", FAULTS, SCANNER, {"kind": "corrupt", "bytes": {"rate": 0.01}, "at": {"scan": 0}, "seed": 4}, 201),
    ("POST", FAULTS, SCANNER, {"kind": "reboot", "at": {"request": "MD", "nth": 2}}, 201),
    ("POST", FAULTS, SCANNER, {"kind": "dance"}, 400),
    ("POST", FAULTS, "/sensors/robot/other/faults", {"kind": "stall"}, 404),
    ("POST", FAULTS, "/sensors/robot/tof/faults", {"kind": "stall"}, 409),
    ("GET", FAULTS, SCANNER, None, 200),
    ("GET", FAULTS, "/sensors/robot/other/faults", None, 404),
    ("GET", FAULTS, "/sensors/robot/sonar/faults", None, 409),
    ("GET", FAULT, SCANNER + "/3", None, 200),
    ("GET", FAULT, SCANNER + "/99", None, 404),
    ("GET", FAULT, "/sensors/robot/sonar/faults/1", None, 409),
    ("GET", LOG, SCANNER + "/log", None, 200),
    ("GET", LOG, SCANNER + "/log?since=1", None, 200),
    ("GET", LOG, SCANNER + "/log?since=x", None, 400),
    ("GET", LOG, "/sensors/robot/other/faults/log", None, 404),
    ("GET", LOG, "/sensors/robot/sonar/faults/log", None, 409),
    ("DELETE", FAULT, SCANNER + "/3", None, 204),
    ("DELETE", FAULT, SCANNER + "/3", None, 404),
    ("DELETE", FAULT, "/sensors/robot/sonar/faults/1", None, 409),
    ("DELETE", FAULTS, SCANNER, None, 204),
    ("DELETE", FAULTS, "/sensors/robot/other/faults", None, 404),
    ("DELETE", FAULTS, "/sensors/robot/sonar/faults", None, 409),
    ("GET", "/scenario", "/scenario", None, 404),
    ("PUT", "/scenario", "/scenario", {"name": "faults.yaml", "yaml": STEPS}, 200),
    ("GET", "/scenario", "/scenario", None, 200),
    ("PUT", "/scenario", "/scenario", {"name": "faults.yaml", "yaml": STEPS.replace("stall", "dance")}, 400),
    ("DELETE", "/scenario", "/scenario", None, 204),
    ("GET", "/robots/{robot}/pose", "/robots/robot/pose", None, 200),
    ("GET", "/robots/{robot}/pose", "/robots/other/pose", None, 404),
    ("PUT", "/robots/{robot}/pose", "/robots/robot/pose", {"xyz": [0.5, 0, 0], "rpy": [0, 0, 1], "t": 5}, 204),
    ("PUT", "/robots/{robot}/pose", "/robots/robot/pose", {"xyz": [0.5, 0, 0], "t": 5}, 409),
    ("PUT", "/robots/{robot}/pose", "/robots/robot/pose", {"xyz": 1}, 400),
    ("PUT", "/robots/{robot}/pose", "/robots/other/pose", {"xyz": [0, 0, 0]}, 404),
    ("GET", "/scene", "/scene", None, 200),
    ("GET", "/scene/objects", "/scene/objects", None, 200),
    ("GET", "/scene/sdf", "/scene/sdf", None, 200),
    ("GET", "/configuration", "/configuration", None, 200),
    ("GET", "/scene/meshes/{mesh}", "/scene/meshes/MESH", None, 200),
    ("GET", "/scene/meshes/{mesh}", "/scene/meshes/0123456789abcdef", None, 404),
    ("POST", "/scene/models", "/scene/models",
     {"name": "m", "sdf": SDF, "pose": {"xyz": [1, 0, 0], "q": [0, 0, 0, 1]}}, 201),
    ("POST", "/scene/models", "/scene/models", {"name": "m", "sdf": SDF}, 409),
    ("POST", "/scene/models", "/scene/models", {"name": "m", "sdf": SDF, "replace": True}, 201),
    ("POST", "/scene/models", "/scene/models", {"name": "m", "sdf": SDF, "replace": True, "static": False}, 201),
    ("POST", "/scene/models", "/scene/models", {"name": "n"}, 400),
    ("POST", "/scene/models", "/scene/models", {"name": "n", "file": "no such file"}, 400),
    ("POST", "/scene/models", "/scene/models", {"name": "n", "file": "/etc/hostname"}, 403),
    ("POST", "/scene/models", "/scene/models", {"name": "lidar", "sdf": LIDAR}, 201),
    ("POST", "/scene/models", "/scene/models", {"name": "n", "sdf": SDF}, 413),
    ("GET", "/scene", "/scene", None, 200),
    ("GET", POSE, "/scene/models/m/pose", None, 200),
    ("GET", POSE, "/scene/models/n/pose", None, 404),
    ("PUT", POSE, "/scene/models/m/pose", {"xyz": [2, 0, 0], "q": [0, 0, 0, 1], "t": 7}, 204),
    ("PUT", POSE, "/scene/models/m/pose", {"xyz": [2, 0, 0], "t": 7}, 409),
    ("PUT", POSE, "/scene/models/m/pose", {"xyz": [2]}, 400),
    ("PUT", POSE, "/scene/models/n/pose", {"xyz": [2, 0, 0]}, 404),
    ("PUT", MATERIAL, "/scene/models/m/material", {"material": "concrete"}, 200),
    ("PUT", MATERIAL, "/scene/models/m/material", {}, 400),
    ("PUT", MATERIAL, "/scene/models/n/material", {"material": "concrete"}, 404),
    ("DELETE", "/scene/models/{model}", "/scene/models/m", None, 204),
    ("DELETE", "/scene/models/{model}", "/scene/models/m", None, 404),
    ("GET", MEDIA, MEDIA, None, 200),
    ("PUT", MEDIA, MEDIA, FOG_AND_STEAM, 200),
    ("GET", MEDIA, MEDIA, None, 200),
    ("PUT", MEDIA, MEDIA, [{"kind": "fog"}], 400),
    ("DELETE", MEDIA, MEDIA, None, 204),
    ("PUT", "/scene", "/scene", {"file": "SCENE"}, 200),
    ("PUT", "/scene", "/scene", {"file": "no such file"}, 400),
    ("PUT", "/scene", "/scene", {"file": "/etc/hostname"}, 403),
    ("GET", "/poses", "/poses", None, 426),
    ("GET", "/stream", "/stream", None, 426),
    ("GET", "/view", "/view", None, 426),
    ("GET", "/wire", "/wire?sensor=robot/multi", None, 426),
    ("GET", "/poses", "/poses", None, 101),
    ("GET", "/stream", "/stream", None, 101),
    ("GET", "/view", "/view", None, 101),
    ("GET", "/wire", "/wire?sensor=robot/multi", None, 101),
    *[("DELETE", "/sensors/{robot}/{sensor}", "/sensors/robot/" + name, None, 204)
      for name in ["multi", "tof", "sonar", "played"]],
    ("DELETE", "/sensors/{robot}/{sensor}", "/sensors/robot/scanner", None, 409),
]
# Over TCP: the answer of the document, its status, and the header fields of the request, which has a body.
TOKEN = "0123456789abcdef"
REFUSALS = [
    ("Unauthorized", 401, {"Authorization": "Bearer " + "x" * 16}),
    ("Forbidden", 403, {"Host": "evil.example"}),
    ("Forbidden", 403, {"Origin": "http://evil.example"}),
    ("NotJson", 415, {"Content-Type": "text/plain"}),
]
METHODS = ["GET", "PUT", "POST", "DELETE", "PATCH"]
UPGRADE = {"Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
           "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ=="}


def ask(path, method, target, body=None, headers=None):
    connection = Control(path)
    connection.request(method, target, None if body is None else json.dumps(body), headers or {})
    answer = connection.getresponse()
    content = b"" if answer.status == 101 else answer.read()
    return answer, content


class Document:
    def __init__(self, file):
        self.root = yaml.safe_load(pathlib.Path(file).read_text())

    def follow(self, node):
        while "$ref" in node:
            target = self.root
            for key in node["$ref"].removeprefix("#/").split("/"):
                target = target[key]
            node = target
        return node

    def operations(self):
        return {(method.upper(), path): operation for path, item in self.root["paths"].items()
                for method, operation in item.items() if method.upper() in METHODS}

    def check(self, schema, value):
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.validate(value, {**schema, "components": self.root["components"]},
                            cls=jsonschema.Draft202012Validator)


def message(connection):
    """The text of one message. A server does not mask its frames."""
    def read(count):
        data = b""
        while len(data) < count:
            data += connection.recv(count - len(data))
        return data
    text = b""
    while True:
        first, length = read(2)
        if length >= 126:
            length = int.from_bytes(read(2 if length == 126 else 8), "big")
        text += read(length)
        if first & 0x80:
            return text


def connect(path, target):
    connection = socket.socket(socket.AF_UNIX)
    connection.settimeout(60)
    connection.connect(path)
    lines = [f"GET {target} HTTP/1.1", "Host: localhost"]
    lines += [f"{key}: {value}" for key, value in UPGRADE.items()]
    connection.sendall("\r\n".join(lines + ["", ""]).encode())
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        head += connection.recv(1)
    assert b" 101 " in head.splitlines()[0], head
    return connection


def subscribe(path, sensor):
    return connect(path, "/stream?sensor=robot/" + sensor)


def say(connection, said):
    """With the mask 0, which leaves the bytes as they are."""
    text = json.dumps(said).encode()
    assert len(text) < 126, text
    connection.sendall(bytes([0x81, 0x80 | len(text), 0, 0, 0, 0]) + text)


def check_view(document, path, sensors):
    for sensor in sensors:
        connection = connect(path, "/view")
        wanted = {"scans": {"robot/" + sensor: {"true": True}}}
        document.check({"$ref": "#/components/schemas/ViewRequest"}, wanted)
        say(connection, wanted)
        assert set(json.loads(message(connection))) == {"scene"}
        document.check({"$ref": "#/components/schemas/ViewPoses"}, json.loads(message(connection)))
        frame = message(connection)
        assert frame[:4] == b"SCV1", frame[:100]
        header = json.loads(frame[12:12 + int.from_bytes(frame[8:12], "little")])
        document.check({"$ref": "#/components/schemas/ViewFrame"}, header)
        known = document.root["components"]["schemas"]["ViewFrame"]["properties"]
        assert set(header) <= set(known), set(header) - set(known)
        for array in header["arrays"]:
            assert f"`{array['name']}` ({array['type']}" in known["arrays"]["description"], array


def check_wire(document, path, tcp):
    connection = connect(path, "/wire?sensor=robot/multi")
    host, _, port = tcp.rpartition(":")
    with socket.create_connection((host, int(port)), 60) as driver:
        driver.sendall(b"VV\nGD0000001000\n")
        said = [json.loads(message(connection)) for _ in range(4)]
    for one in said:
        document.check({"$ref": "#/components/schemas/WireMessage"}, one)
    assert [(one["from"], one["line"], one["status"]) for one in said] == [
        ("client", "VV", None), ("client", "GD0000001000", None),
        ("scanner", "VV", "00"), ("scanner", "GD0000001000", "10")], said
    assert "BM" in said[3]["explains"], said


def check_stream(document, path, sensor, schema):
    connection = subscribe(path, sensor)
    document.check({"$ref": "#/components/schemas/" + schema}, json.loads(message(connection)))


def check_fault_stream(document, path):
    connection = subscribe(path, "scanner")
    answer, content = ask(path, "POST", SCANNER, {"kind": "stall", "for": {"s": 0.01}})
    assert answer.status == 201, content
    while "fault" not in (said := json.loads(message(connection))):
        pass
    document.check({"$ref": "#/components/schemas/StreamFault"}, said)
    log = json.loads(ask(path, "GET", SCANNER + "/log")[1])
    document.check({"$ref": "#/components/schemas/FaultLog"}, log)
    entry = log["entries"][said["fault"]["n"] - 1]
    counts = {key + "_n": len(entry.pop(key)) for key in ("bytes", "steps")}
    assert said["fault"] == {"sensor": "robot/scanner", **entry, **counts}, (said, entry)
    answer, content = ask(path, "DELETE", SCANNER)
    assert answer.status == 204, content


def check_paths(document, path):
    answer, content = ask(path, "GET", "/no/such/path")
    problem = json.loads(content)
    document.check({"$ref": "#/components/schemas/Problem"}, problem)
    served = set(re.findall(r"/[^ ,;]*", problem["detail"].split("there are ")[1]))
    assert served == set(document.root["paths"]), served ^ set(document.root["paths"])
    for template in served:
        documented = {method for method, where in document.operations() if where == template}
        for method in set(METHODS) - documented:
            answer, content = ask(path, method, re.sub(r"{\w+}", "x", template))
            assert answer.status == 405, (method, template, answer.status)
            assert set(answer.headers["Allow"].split(", ")) == documented, (template, answer.headers["Allow"])


def check_exchanges(document, path, scene):
    unseen = {(method, where, int(status)) for (method, where), operation in document.operations().items()
              for status in operation["responses"]}
    for method, template, target, body, status in EXCHANGES:
        operation = document.operations()[(method, template)]
        body = {"file": scene} if body == {"file": "SCENE"} else body
        if target.endswith("/MESH"):
            target = target.replace("MESH", json.loads(ask(path, "GET", "/scene/objects")[1])["objects"][0]["mesh"])
        headers = UPGRADE if status == 101 else {"If-None-Match": ask(path, method, target)[0].headers["ETag"]} \
            if status == 304 else None
        answer, content = ask(path, method, target, body, headers)
        assert answer.status == status, (method, target, answer.status, content)
        response = document.follow(operation["responses"][str(status)])
        if status != 400 and body is not None:
            document.check(document.follow(operation["requestBody"])["content"]["application/json"]["schema"], body)
        if "content" in response:
            (kind, media), = response["content"].items()
            assert answer.headers["Content-Type"] == kind, (target, answer.headers["Content-Type"])
            document.check(media["schema"], json.loads(content) if "json" in kind else content.decode("latin-1"))
        else:
            assert content == b"", (target, content)
        unseen.discard((method, template, status))
    assert not unseen, unseen


def check_refusals(document, where):
    for name, status, fields in REFUSALS:
        connection = http.client.HTTPConnection(where, timeout=60)
        connection.request("PUT", "/robots/robot/pose", "{}", 
                           {"Authorization": "Bearer " + TOKEN, "Content-Type": "application/json", **fields})
        answer = connection.getresponse()
        assert answer.status == status, (name, answer.status)
        (kind, media), = document.root["components"]["responses"][name]["content"].items()
        assert answer.headers["Content-Type"] == kind, (name, answer.headers["Content-Type"])
        document.check(media["schema"], json.loads(answer.read()))


def main():
    scipd, document, scene = (str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:])
    document = Document(document)
    with tempfile.TemporaryDirectory() as folder:
        control = folder + "/control.sock"
        rig = pathlib.Path(folder) / "rig.yaml"
        rig.write_text(RIG.replace("SCENE", scene))
        (pathlib.Path(folder) / "scans.jsonl").write_text(SCANS)
        token = pathlib.Path(folder) / "token"
        token.write_text(TOKEN + "\n")
        token.chmod(0o600)
        daemon = subprocess.Popen([scipd, "--config", str(rig)], stdout=subprocess.PIPE)
        try:
            ready = json.loads(daemon.stdout.readline())
            check_stream(document, control, "scanner", "StreamScan")
            check_stream(document, control, "multi", "StreamScan")
            check_stream(document, control, "tof", "CameraReading")
            check_stream(document, control, "sonar", "RangerReading")
            check_view(document, control, ["scanner", "multi", "tof", "sonar", "played"])
            check_wire(document, control, ready["sensors"][1]["tcp"])
            check_fault_stream(document, control)
            check_paths(document, control)
            check_exchanges(document, control, scene)
            check_refusals(document, ready["http"])
        finally:
            daemon.terminate()
            daemon.wait(20)
    print("the document and the server agree")


main()
