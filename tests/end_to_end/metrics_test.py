# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# /metrics counts what a client sees, in the format of Prometheus, and docs/operations.md lists all of it; /health
# answers; the log is JSON. metrics_test.py SCIPD SCENE OPERATIONS.MD
import collections
import http.client
import json
import pathlib
import re
import signal
import sys

from fault_lab import PATIENCE_S, Client, Lab, wait_for

FRONT = {"model": "UST-10LX", "tcp": "127.0.0.1:0", "mount": {"xyz": [0, 0, 0.3]}}
SERIAL = {"model": "URG-04LX", "pty": "tty", "mount": {"xyz": [0, 0, 0.3]}}
SONAR = {"ranger": {"cone_deg": 30, "beams": 61, "rate_hz": 20, "range_m": [0.02, 4.0]}}
SAMPLE = re.compile(r'([a-z_]+)(?:\{([^}]*)\})? (\S+)')
LABEL = re.compile(r'([a-z_]+)="((?:[^"\\]|\\.)*)"(?:,|$)')
PARTS = {"histogram": ["_bucket", "_sum", "_count"]}


class Metrics:
    """A text of the format 0.0.4, read back by its rules."""

    def __init__(self, text):
        assert text.endswith("\n")
        self.types, self.values, self.helped, seen = {}, {}, {}, []
        for line in text.splitlines():
            if line.startswith("# HELP "):
                name, self.helped[name] = line[7:].split(" ", 1)[0], line
            elif line.startswith("# TYPE "):
                name, kind = line[7:].split(" ")
                assert name not in self.types, f"{name} twice"
                assert kind in ["counter", "gauge", "histogram"], line
                self.types[name] = kind
                seen.append(name)
            else:
                self.take(line, seen[-1])
        assert set(self.helped) == set(self.types)

    def take(self, line, metric):
        name, labels, value = SAMPLE.fullmatch(line).groups()
        said = dict(LABEL.findall(labels or ""))
        assert LABEL.sub("", labels or "") == "", line
        parts = PARTS.get(self.types[metric], [""])
        assert name in [metric + part for part in parts], f"{line} among those of {metric}"
        key = name, tuple(sorted(said.items()))
        assert key not in self.values, f"{line} twice"
        self.values[key] = float(value)

    def value(self, name, **labels):
        return self.values[name, tuple(sorted(labels.items()))]

    def of(self, name, **labels):
        """The values of all samples that have these labels."""
        return [value for (sample, said), value in self.values.items()
                if sample == name and labels.items() <= dict(said).items()]

    def labels(self, metric):
        return {label for (name, said), _ in self.values.items() if name.startswith(metric) for label, _ in said
                if label != "le"}


def read_metrics(control):
    control.request("GET", "/metrics")
    answer = control.getresponse()
    text = answer.read().decode()
    assert answer.status == 200, text
    assert answer.headers["Content-Type"] == "text/plain; version=0.0.4; charset=utf-8"
    return Metrics(text)


def stream(lab, sensor, scans):
    """All bytes of a client that takes so many scans and leaves."""
    client = Client(lab.address(sensor))
    client.ask("BM")
    client.say(f"MD00001080000{scans:02}")
    wait_for(lambda: client.read() and client.got.count(b"\n99b\n") == scans and client.got.endswith(b"\n\n"), "scans")
    client.close()
    wait_for(lambda: read_metrics(lab.control).value("scipd_clients", sensor=f"robot/{sensor}") == 0, "it left")
    return len(client.got)


def check_scans(lab):
    sensor = "robot/front"
    before = read_metrics(lab.control)
    for name in ["scans_total", "sent_bytes_total", "scans_lost_total", "faults_injected_total", "clients"]:
        assert before.value("scipd_" + name, sensor=sensor) == 0, name
    assert before.of("scipd_casts_total", sensor=sensor) == [0]
    received = stream(lab, "front", 12)
    after = read_metrics(lab.control)
    assert after.value("scipd_scans_total", sensor=sensor) == 12
    assert after.of("scipd_casts_total", sensor=sensor) == [12]
    assert 0 < after.of("scipd_cast_seconds_total", sensor=sensor)[0] < PATIENCE_S
    assert after.value("scipd_sent_bytes_total", sensor=sensor) == received
    check_histogram(after, sensor, 12)
    assert after.value("scipd_scans_total", sensor="robot/serial") == 0
    return received


def check_histogram(metrics, sensor, count):
    name = "scipd_lateness_seconds"
    assert metrics.value(name + "_count", sensor=sensor) == count
    buckets = sorted((float(dict(said)["le"]), value) for (sample, said), value in metrics.values.items()
                     if sample == name + "_bucket" and dict(said)["sensor"] == sensor)
    assert len(buckets) > 10 and buckets[-1] == (float("inf"), count), buckets
    assert all(a[1] <= b[1] for a, b in zip(buckets, buckets[1:])), buckets
    # Each is at most as late as the bound of its bucket, and later than the one before.
    between = [b[1] - a[1] for a, b in zip([(0, 0)] + buckets, buckets)]
    least = sum(n * a[0] for n, a in zip(between, [(0, 0)] + buckets))
    most = sum(n * b[0] for n, b in zip(between, buckets) if n)
    assert least <= metrics.value(name + "_sum", sensor=sensor) <= most, (least, most)


def check_refusals(lab):
    client = Client(lab.address("front"))
    for request in ["XX", "XX", "GD0000108000", "MD9999000000000"]:
        client.ask(request)
    answers = collections.Counter(line[:2].decode() for line in client.got.split(b"\n") if len(line) == 3)
    assert len(answers) == 3 and answers["10"] == 1, answers
    metrics = read_metrics(lab.control)
    told = {dict(labels)["status"]: count for (name, labels), count in metrics.values.items()
            if name == "scipd_refused_requests_total"}
    assert told == answers, (told, answers)
    assert metrics.value("scipd_clients", sensor="robot/front") == 1
    client.close()
    return len(client.got), answers


def check_faults(lab):
    status, answer = lab.control.ask("POST", "/sensors/robot/front/faults",
                                     {"kind": "status", "status": "0L", "for": {"s": 1000}})
    if status != 201:
        raise SystemExit(f"no such fault: {answer}")
    client = Client(lab.address("front"))
    client.ask("VV")
    client.ask("PP")
    hits = lab.faults("front")[0]["hits"]
    assert hits > 0
    assert read_metrics(lab.control).value("scipd_faults_injected_total", sensor="robot/front") == hits
    lab.control.ask("DELETE", "/sensors/robot/front/faults")
    assert read_metrics(lab.control).value("scipd_faults_injected_total", sensor="robot/front") == hits
    client.close()
    return len(client.got), hits


def check_poses(lab):
    assert lab.control.ask("PUT", "/robots/robot/pose", {"xyz": [0.1, 0, 0], "t": 5})[0] == 204
    assert lab.control.ask("PUT", "/robots/robot/pose", {"xyz": [0.1, 0, 0], "t": 5})[0] == 409
    metrics = read_metrics(lab.control)
    assert metrics.value("scipd_poses_total") == 1
    assert metrics.value("scipd_poses_refused_total") == 1


def check_reload(lab, received, refused, hits):
    """Another scanner of the same name counts on."""
    file = lab.folder / "lab.yaml"
    configuration = json.loads(file.read_text())
    configuration["robots"]["robot"]["sensors"]["front"]["model"] = "UST-20LX"
    file.write_text(json.dumps(configuration))
    lab.process.send_signal(signal.SIGHUP)
    wait_for(lambda: lab.control.ask("GET", "/sensors/robot/front")[1]["model"] == "UST-20LX", "the reload")
    metrics = read_metrics(lab.control)
    sensor = "robot/front"
    assert metrics.value("scipd_scans_total", sensor=sensor) == 12
    assert metrics.value("scipd_sent_bytes_total", sensor=sensor) == received
    for status, count in refused.items():
        assert metrics.value("scipd_refused_requests_total", sensor=sensor, status=status) == count
    assert metrics.value("scipd_faults_injected_total", sensor=sensor) == hits
    received += stream(lab, "front", 5)
    metrics = read_metrics(lab.control)
    assert metrics.value("scipd_scans_total", sensor=sensor) == 17
    assert metrics.value("scipd_sent_bytes_total", sensor=sensor) == received
    check_histogram(metrics, sensor, 17)


def check_document(lab, page):
    row = re.compile(r"\| `(scipd_\w+)` \| (\w+) \| ([^|]*) \| [^|]+ \|")
    documented = {name: (kind, set(re.findall(r"`(\w+)`", labels)))
                  for name, kind, labels in row.findall(pathlib.Path(page).read_text())}
    metrics = read_metrics(lab.control)
    told = {name: (kind, metrics.labels(name)) for name, kind in metrics.types.items()}
    assert documented == told, {name: (documented.get(name), told.get(name)) for name in {*documented, *told}
                                if documented.get(name) != told.get(name)}


def check_health(lab):
    assert lab.control.ask("GET", "/health") == (200, {"ready": True, "alive": True})
    tcp = http.client.HTTPConnection(lab.ready["http"], timeout=PATIENCE_S)
    tcp.request("GET", "/health")
    answer = tcp.getresponse()
    assert answer.status == 200 and json.loads(answer.read()) == {"ready": True, "alive": True}
    read_metrics(tcp)


def check_log(lab):
    entries = [json.loads(line) for line in lab.said.splitlines()]
    assert all(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z", entry["time"]) for entry in entries), entries
    fault, = [entry for entry in entries if entry["message"].endswith("begins")]
    assert fault["sensor"] == "robot/front" and fault["message"].startswith("fault 1, status, at scan "), fault
    assert {**entries[-1], "time": ""} == {"time": "", "level": "info", "message": "stopped (SIGTERM)"}, entries[-1]


def main():
    scipd, scene, page = sys.argv[1:]
    sensors = {"front": FRONT, "serial": SERIAL, "sonar": SONAR}
    with Lab(scipd, scene, sensors=sensors, lockstep=False, options=["--log-format", "json"],
             http="127.0.0.1:0") as lab:
        check_health(lab)
        received = check_scans(lab)
        refused_bytes, refused = check_refusals(lab)
        with_faults, hits = check_faults(lab)
        check_poses(lab)
        check_document(lab, page)
        check_reload(lab, received + refused_bytes + with_faults, refused, hits)
    check_log(lab)
    print("all is counted")


main()
