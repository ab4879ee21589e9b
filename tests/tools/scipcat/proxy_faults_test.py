#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
A fault of `scipcat proxy` before a sound scanner, against the same fault of scipd: in lockstep both drivers get the
same bytes. And what a proxy tells of a twin. proxy_faults_test.py SCIPD SCIPCAT SCENE
"""
import concurrent.futures
import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).parents[2] / "end_to_end"))
from fault_lab import PATIENCE_S, Client, Lab, sum_is_right, wait_for  # noqa: E402

SCIPD, SCIPCAT, SCENE = sys.argv[1:4]
UST = {"model": "UST-10LX", "tcp": "127.0.0.1:0", "mount": {"xyz": [0, 0, 0.3]}}
SCANS = 20
# Without chance, so that both do the same to the byte.
FAULTS = {
    "lose,bytes.at=[3,100],messages=scans": {"kind": "lose", "bytes": {"at": [3, 100]}, "messages": "scans"},
    "duplicate,bytes.at=[7],messages=replies": {"kind": "duplicate", "bytes": {"at": [7]}, "messages": "replies"},
    "truncate,keep=100,messages=scans": {"kind": "truncate", "keep": 100, "messages": "scans"},
    "truncate,command=PP": {"kind": "truncate", "command": "PP"},
    "linefeed,lines=all,messages=scans": {"kind": "linefeed", "lines": "all", "messages": "scans"},
    "linefeed": {"kind": "linefeed"},
    "status,status=0L,command=MD": {"kind": "status", "status": "0L", "command": "MD"},
    "status,status=02,at.request=PP": {"kind": "status", "status": "02", "at": {"request": "PP"}},
    "resend,command=PP": {"kind": "resend", "command": "PP"},
    "resend,what=previous": {"kind": "resend", "what": "previous"},
    "repeat": {"kind": "repeat"},
    "reorder": {"kind": "reorder"},
}


class Proxy:
    def __init__(self, target, *words):
        self.errors = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen([SCIPCAT, "proxy", target, "--listen", "127.0.0.1:0", "--json", *words],
                                        stdout=subprocess.PIPE, stderr=self.errors, text=True)
        line = self.process.stdout.readline()
        assert line, self.said()
        host, port = json.loads(line)["listen"].rsplit(":", 1)
        self.address = host, int(port)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()

    def said(self):
        self.errors.seek(0)
        return self.errors.read()

    def end(self):
        self.process.send_signal(signal.SIGINT)
        out, _ = self.process.communicate(timeout=PATIENCE_S)
        assert self.process.returncode == 0, self.said()
        return [json.loads(line) for line in out.splitlines()]


def conversation(address):
    """All that a driver gets that asks the same each time, and never waits for a message to end."""
    client = Client(address)
    sizes = []

    def listen():
        while not client.silent(0.3) and client.read():
            pass
        sizes.append(len(client.got))

    for line in ("VV", "PP", "BM", "MD00001080000%02d" % SCANS, "II", "QT"):
        client.say(line)
        listen()
    client.close()
    return client.got, sizes


def does_as_scipd():
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        list(pool.map(does_this_as_scipd, FAULTS))


def does_this_as_scipd(words):
    fault = {"sensor": "robot/front", **FAULTS[words]}
    with Lab(SCIPD, SCENE, sensors={"front": UST}, faults=[fault]) as lab:
        wanted, sizes = conversation(lab.address("front"))
    with Lab(SCIPD, SCENE, sensors={"front": UST}) as lab:
        with Proxy("tcp://%s:%d" % lab.address("front"), "--fault", words) as proxy:
            got, others = conversation(proxy.address)
    assert sizes[3] - sizes[2] > (100 * SCANS if "MD" not in words else 10), (words, sizes, wanted[-300:])
    # The clock of the scanner goes on with the time that it took: II tells it.
    wanted, got = (re.sub(rb"TIME:\w+;.", b"", text) for text in (wanted, got))
    assert got == wanted, f"{words}: {sizes} {others}\n{wanted[-300:]!r}\n{got[-300:]!r}"


def acts_by_chance():
    """Those that choose by chance choose others than scipd would, and as many."""
    with Lab(SCIPD, SCENE, sensors={"front": UST}) as lab:
        target = "tcp://%s:%d" % lab.address("front")
        sound, sizes = conversation(lab.address("front"))
        with Proxy(target, "--fault", "sums,messages=scans,of=data") as proxy:
            got, _ = conversation(proxy.address)
        scans = [m for m in got.split(b"\n\n") if b"\n99b\n" in m]
        assert len(scans) == SCANS
        assert not any(sum_is_right(line) for scan in scans for line in scan.split(b"\n")[2:])
        with Proxy(target, "--fault", "corrupt,bytes.rate=0.01,at.scan=6,for.scans=10") as proxy:
            got, _ = conversation(proxy.address)
            assert "corrupt, at scan 6: begins" in proxy.said() and "at scan 16: ends" in proxy.said(), proxy.said()
        assert len(got) == len(sound)
        begin = sizes[2] + len(b"MD0000108000020\n00P\n\n")
        size = (sizes[3] - begin) // SCANS
        scans = [got[begin + i * size:begin + (i + 1) * size] for i in range(SCANS)]
        # A bit of every hundredth byte: no scan gets away with it, and no other scan has any.
        hit = [i + 1 for i, scan in enumerate(scans)
               if not all(sum_is_right(line) for line in scan[:-2].split(b"\n")[1:])]
        assert hit == list(range(6, 16)), hit


def tells_of_the_twin():
    """A box that only the scanner sees: 0.4 m around (1.2, 0), so its face is at 1 m, before the wall at 3 m."""
    box = ("<sdf version='1.9'><model name='more'><link name='l'><visual name='v'><geometry><box><size>0.4 0.4 1</size>"
           "</box></geometry></visual></link></model></sdf>")
    with Lab(SCIPD, SCENE, sensors={"front": UST}, lockstep=False, seed=7) as lab:
        twin = lab.folder / "twin.yaml"
        twin.write_text(json.dumps({"scene": SCENE, "robots": {"robot": {"sensors": {"front": UST}}}}))
        with Proxy("tcp://%s:%d" % lab.address("front"), "--twin", str(twin)) as proxy:
            children = pathlib.Path(f"/proc/{proxy.process.pid}/task/{proxy.process.pid}/children").read_text().split()
            assert len(children) == 1, children
            client = Client(proxy.address)
            client.ask("PP")
            client.ask("BM")
            client.ask("MD0000108001000")

            def read_scans(count):
                end = len(client.got) + count * 3400
                while len(client.got) < end:
                    client.read()

            read_scans(60)
            status, answer = lab.control.ask(
                "POST", "/scene/models", {"name": "more", "sdf": box, "pose": {"xyz": [1.2, 0, 0.3]}})
            assert status in (200, 201), answer
            read_scans(60)
            assert lab.control.ask("DELETE", "/scene/models/more")[0] in (200, 204)
            read_scans(40)
            client.close()
            told = proxy.end()
            assert "scans held against the twin's" in proxy.said(), proxy.said()
        wait_for(lambda: not pathlib.Path("/proc/" + children[0]).exists(), "the twin's end")
    assert [change["differs"] for change in told] == [True, False], told
    begun, ended = told
    assert list(begun) == ["differs", "from", "to", "what", "a", "b", "scan", "time_s"]
    assert begun["what"] == "mean" and begun["from"] < 540 < begun["to"], begun
    # 0.2 m to either side at 1 m is atan(0.2) = 11.3 degrees: 45 steps.
    assert abs(begun["from"] - 495) < 4 and abs(begun["to"] - 585) < 4, begun
    assert abs(begun["a"] - 1000) < 60 and abs(begun["b"] - 3000) < 60, begun
    assert 50 < begun["scan"] < 90 and begun["scan"] + 50 < ended["scan"] < begun["scan"] + 100, told
    assert (ended["from"], ended["to"]) == (begun["from"], begun["to"])


for test in (does_as_scipd, acts_by_chance, tells_of_the_twin):
    test()
    print(test.__name__, flush=True)
