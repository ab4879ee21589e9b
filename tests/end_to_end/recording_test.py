# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# GET /sensors/R/S/recording: the scans of a file, in each format, are those that a driver got over the wire at the
# same time, by their stamps, in Unix time. Who leaves, asks wrongly or asks for too many costs nobody else a recording.
# recording_test.py SCIPD SCIPCAT SCENES
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading

from fault_lab import PATIENCE_S, Control, Lab, wait_for
from replay_test import Scipd, scans

FORMATS = {"mcap": b"\x89MCAP", "ubh": b"[appName]", "csv": b"# U", "jsonl": b"{"}
RECORDING = "/sensors/robot/scanner/recording"


def get(control, target):
    talk = Control(control)
    talk.request("GET", target)
    answer = talk.getresponse()
    return answer.status, answer.read(), answer.headers


def info_of(scipcat, file):
    return json.loads(subprocess.run([scipcat, "info", str(file), "--json"], capture_output=True, check=True,
                                     timeout=PATIENCE_S).stdout)


def holds_what_the_wire_has(model, programs, folder):
    scipd, scipcat, scenes = programs
    wants = ["--echoes"] if model == "UTM-30LX-EW" else []
    with Scipd(scipd, folder, "--scene", f"{scenes}/rescue_maze.sdf", "--poses", f"{scenes}/rescue_maze.tum",
               "--model", model, "--accuracy", "material") as scanner:
        files = {}

        def ask(kind):
            status, files[kind], headers = get(scanner.ready["control"], f"{RECORDING}?format={kind}&scans=20")
            assert status == 200 and f'"scanner.{kind}"' in headers["Content-Disposition"], headers

        heard = folder / "heard.jsonl"
        with subprocess.Popen([scipcat, "record", scanner.tcp, "-o", str(heard), "-n", "100", "--intensity", *wants],
                              stderr=subprocess.DEVNULL) as driver:
            control = Control(scanner.ready["control"])
            wait_for(lambda: control.ask("GET", "/sensors/robot/scanner")[1]["state"] == "streaming", "a driver")
            asking = [threading.Thread(target=ask, args=[kind]) for kind in FORMATS]
            for one in asking:
                one.start()
            for one in asking:
                one.join()
            assert driver.wait(PATIENCE_S) == 0
    for kind, magic in FORMATS.items():
        assert files[kind].startswith(magic), (kind, files[kind][:40])
        (folder / f"made.{kind}").write_bytes(files[kind])
        info = info_of(scipcat, folder / f"made.{kind}")
        assert info["scans"] == 20 and info["device"]["model"] == model and not info["warnings"], info
        assert info["intensities"], info
    made, heard = scans(folder / "made.jsonl"), scans(heard)
    common = set(made) & set(heard)
    assert len(common) >= 5, (sorted(made), sorted(heard))
    for stamp in common:
        for member in ("distances_mm", "intensities", "echoes", "first_step", "serial", "first_angle_rad"):
            assert (member in made[stamp]) == (member != "echoes" or bool(wants)), (member, stamp)
            assert made[stamp].get(member) == heard[stamp].get(member), f"{model}: another {member} at {stamp} ms"
        later_s = heard[stamp]["host_time_s"] - made[stamp]["host_time_s"]
        assert 0.015 < later_s < PATIENCE_S, f"{model}: step 0 is {later_s} s before the scan came, at {stamp} ms"


def refuses_and_lets_go(programs, folder):
    scipd, _, scenes = programs
    with Scipd(scipd, folder, "--scene", f"{scenes}/square_room.sdf") as scanner:
        control = scanner.ready["control"]
        for query, word in [("scans=0", b"4000"), ("scans=4001", b"4000"), ("scans=x", b"4000"),
                            ("format=pcap", b"jsonl")]:
            status, body, _ = get(control, f"{RECORDING}?{query}")
            assert status == 400 and word in body, (status, body)
        waiting = [Control(control) for _ in range(4)]
        for one in waiting:
            one.request("GET", f"{RECORDING}?scans=4000")
        wait_for(lambda: get(control, f"{RECORDING}?scans=1")[0] == 409, "a refusal of the fifth")
        waiting.pop().close()
        wait_for(lambda: get(control, f"{RECORDING}?scans=1")[0] == 200, "room for another")
        for one in waiting:
            one.close()


def refuses_what_a_csv_cannot_hold(programs, folder):
    """A scan has three echoes at `material` and one at `sensor`: a CSV has no columns for both."""
    scipd, scipcat, scenes = programs
    with Scipd(scipd, folder, "--scene", f"{scenes}/square_room.sdf", "--model", "UTM-30LX-EW") as scanner:
        control = Control(scanner.ready["control"])

        def across_a_change(kind):
            def casts():
                return sum(control.ask("GET", "/sensors/robot/scanner")[1]["casts"].values())

            assert control.ask("PATCH", "/sensors/robot/scanner", {"accuracy": "sensor"})[0] == 200
            talk, before = Control(scanner.ready["control"]), casts()
            talk.request("GET", f"{RECORDING}?format={kind}&scans=40")
            wait_for(lambda: casts() > before + 2, "some of the scans")
            status, answer = control.ask("PATCH", "/sensors/robot/scanner", {"accuracy": "material"})
            assert status == 200, answer
            answer = talk.getresponse()
            return answer.status, answer.read()

        status, body = across_a_change("csv")
        problem = json.loads(body)
        assert status == problem["status"] == 409 and "ask for mcap, ubh or jsonl" in problem["detail"], (status, body)
        for kind in ("mcap", "ubh", "jsonl"):
            status, body = across_a_change(kind)
            assert status == 200, (kind, body)
            (folder / f"changed.{kind}").write_bytes(body)
            info = info_of(scipcat, folder / f"changed.{kind}")
            assert info["scans"] == 40 and not info["warnings"], info
        echoes = ["echoes" in scan for scan in scans(folder / "changed.jsonl").values()]
        assert True in echoes and False in echoes, echoes
        assert get(scanner.ready["control"], f"{RECORDING}?format=csv&scans=2")[0] == 200


def ends_with_its_scanner(programs):
    scipd, _, scenes = programs
    stays, goes = ({"model": "UST-10LX", "tcp": "127.0.0.1:0"} for _ in range(2))
    with Lab(scipd, f"{scenes}/square_room.sdf", sensors={"stays": stays, "goes": goes}, lockstep=False) as lab:
        talk = Control(lab.ready["control"])
        talk.request("GET", "/sensors/robot/goes/recording?scans=4000")
        wait_for(lambda: lab.control.ask("GET", "/sensors/robot/goes")[1]["casts"], "a scan")
        file = lab.folder / "lab.yaml"
        configuration = json.loads(file.read_text())
        del configuration["robots"]["robot"]["sensors"]["goes"]
        file.write_text(json.dumps(configuration))
        lab.process.send_signal(signal.SIGHUP)
        answer = talk.getresponse()
        assert answer.status == 409 and b"was removed or changed" in answer.read(), answer.status
        assert get(lab.ready["control"], "/sensors/robot/stays/recording?scans=1")[0] == 200


def main(*programs):
    for model in ("UST-10LX", "UTM-30LX-EW"):
        with tempfile.TemporaryDirectory() as folder:
            holds_what_the_wire_has(model, programs, pathlib.Path(folder))
    with tempfile.TemporaryDirectory() as folder:
        refuses_and_lets_go(programs, pathlib.Path(folder))
    with tempfile.TemporaryDirectory() as folder:
        refuses_what_a_csv_cannot_hold(programs, pathlib.Path(folder))
    ends_with_its_scanner(programs)
    print("what the API records is what the wire has")


if __name__ == "__main__":
    main(*sys.argv[1:])
