#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
What `scipcat check` writes, in all its forms, and how it ends. check_report_test.py SCIPD SCIPCAT SCENE
"""
import contextlib
import json
import os
import pathlib
import pty
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import xml.etree.ElementTree as xml

sys.path.append(str(pathlib.Path(__file__).parents[2] / "end_to_end"))
from fault_lab import Client, Lab  # noqa: E402
from wrong_scanner import Fault, WrongScanner, answers, says  # noqa: E402

SCIPD, SCIPCAT, SCENE = sys.argv[1:4]


def run(*words):
    return subprocess.run([SCIPCAT, "check", *map(str, words)], capture_output=True, text=True, timeout=100)


def looks_at_json(target):
    done = run(target, "--section", "4.2", "--section", "1", "--section", "14.8", "--json")
    assert done.returncode == 0 and done.stderr == "", done
    report = json.loads(done.stdout)
    assert list(report) == ["device", "checks", "nearest", "failed"], list(report)
    assert report["device"]["model"] == "UST-10LX" and report["device"]["target"] == target
    assert report["failed"] == 0 and report["nearest"] is None
    checks = {check["id"]: check for check in report["checks"]}
    assert list(checks) == ["1.1", "1.2", "1.3", "1.4", "4.2", "14.8"], list(checks)
    assert checks["4.2"] == {
        "id": "4.2", "name": "BM switches the laser on", "source": "SCIP 2.0 (C-42-03320B) p. 14; recorded URG-04LX",
        "verdict": "pass", "why": "", "sent": r"\nQT\nBM\n", "got": r"QT\n00P\n\nBM\n00P\n\n"}, checks["4.2"]
    assert checks["1.1"]["verdict"] == "not applicable"
    assert checks["14.8"]["verdict"] == "not applicable" and "--unsafe" in checks["14.8"]["why"]


def looks_at_files(target, folder):
    """Texts of a scanner stand in them as they are, not as marks of the page."""
    junit, page = folder / "check.xml", folder / "check.html"
    with WrongScanner(target, says("VV", "FIRM", "<b>&2\x01")) as wrong:
        sound = run(wrong.target, "--section", "2", "--section", "14", "--junit", junit, "--html", page)
    assert sound.returncode == 0, sound
    with WrongScanner(target, answers("BM", "00", "01")) as wrong:
        broken = run(wrong.target, "--section", "4.2", "--section", "9.1", "--section", "1.1", "--junit",
                     folder / "broken.xml", "--html", folder / "broken.html")
    assert broken.returncode == 1 and broken.stderr == "scipcat: 1 of 3 checks failed\n", broken
    for part in ("4.2   fail", "but     BM is answered with 01, not 00", r"got     QT\n00P\n\nBM\n01Q\n\n",
                 "source  SCIP 2.0", "3 checks: 0 pass, 1 fail, 1 differ as is known, 1 not applicable, 0 skipped",
                 "known   XX is answered with 0F, not 0E, as is known: a real UST-10LX 2.23"):
        assert part in broken.stdout, (part, broken.stdout)

    suites = xml.parse(junit).getroot().findall("testsuite")
    assert [suite.get("tests") for suite in suites] == ["15", "9"] and suites[1].get("skipped") == "9"
    assert "<b>&2?" in xml.parse(junit).getroot().get("name")
    failures = xml.parse(folder / "broken.xml").getroot().findall(".//failure")
    assert [failure.get("message") for failure in failures] == ["BM is answered with 01, not 00"], failures
    for name in (page, folder / "broken.html"):
        text = name.read_text()
        root = xml.fromstring(text.split("\n", 1)[1])
        assert "prefers-color-scheme: dark" in text and "http" not in text
        assert root.find(".//table") is not None and root.find(".//b") is None
    assert 'class="fail"' in text


def looks_at_wrong_words(target, folder):
    cases = [([target, "--section", "99"], "there is no section 99"),
             ([target, "--section", "4.99"], "there is no section 4.99"),
             ([target, "--junit", folder / "none" / "x.xml"], "there is no directory"),
             ([], "TARGET is required"),
             (["tcp://127.0.0.1:1"], "cannot connect to 127.0.0.1 port 1"),
             (["/dev/no-such-tty"], "cannot open /dev/no-such-tty"),
             (["/dev/null"], "is no tty")]
    for words, sentence in cases:
        done = run(*words)
        assert done.returncode == 2 and sentence in done.stderr and done.stdout == "", done
    with socket.create_server(("127.0.0.1", 0)) as mute:
        done = run("tcp://127.0.0.1:%d" % mute.getsockname()[1], "--timeout", "0.1")
        assert done.returncode == 2 and "is another program connected?" in done.stderr, done


def looks_at_who_hangs_up():
    """One that hangs up after each reply keeps no promise."""
    def serve(listener):
        with contextlib.suppress(OSError):
            while True:
                client, _ = listener.accept()
                client.recv(100)
                client.sendall(b"QT\n00P\n\n")
                client.close()

    with socket.create_server(("127.0.0.1", 0), backlog=20) as listener:
        threading.Thread(target=serve, args=(listener,), daemon=True).start()
        done = run("tcp://127.0.0.1:%d" % listener.getsockname()[1], "--json")
        listener.shutdown(socket.SHUT_RDWR)
    checks = json.loads(done.stdout)["checks"]
    assert done.returncode == 1 and len(checks) > 160, done.stderr
    assert {check["verdict"] for check in checks} == {"fail", "not applicable"}


def looks_at_unknown_command(address):
    """GD that is unknown fails one check. Those that only want a scan get it by MD, the others are skipped."""
    with WrongScanner(address, answers("GD.*", None, "0E")) as wrong:
        done = run(wrong.target, "--json")
        text = run(wrong.target, "--section", "5", "--section", "13.8", "--section", "14.1")
    checks = {check["id"]: check for check in json.loads(done.stdout)["checks"]}
    failed = [check for check in checks.values() if check["verdict"] == "fail"]
    assert [check["id"] for check in failed] == ["2.0"] and failed[0]["why"] == "it does not know GD", failed
    assert done.returncode == 1 and json.loads(done.stdout)["failed"] == 1 and len(checks) > 160, done
    by_md = [number for number, check in checks.items() if r"\nMD" in check["sent"] and check["verdict"] == "pass"]
    for number in ("3.5", "3.7", "3.8", "5.6", "5.7", "5.8", "5.9", "7.1", "7.2", "7.3", "7.4", "7.5", "8.1"):
        assert number in by_md, checks[number]
    for number in ("6.3", "12.4"):  # which see by BM that the laser is off
        assert checks[number]["verdict"] == "pass" and r"BM\n" in checks[number]["sent"], checks[number]
    for number in ("4.1", "4.4", "5.10", "9.15", "9.20", "11.5", "13.8"):
        assert checks[number]["verdict"] == "not applicable", checks[number]
        assert checks[number]["why"] == "it needs GD, which the scanner does not know (2.0)", checks[number]

    # Without chapter 2 the first check that needs GD counts. Only what does not apply is called so.
    assert text.returncode == 1, text
    for part in ("5.1   not applicable", "5.10  fail", "13.8  skipped", "14.1  skipped", " 1 fail, ", ", 2 skipped\n"):
        assert part in text.stdout, (part, text.stdout)


class HangsUp(Fault):
    """Ends the conversation at a request; with `for_good`, and from then on, it answers nothing."""

    def __init__(self, request, for_good=False):
        self.request, self.for_good, self.dead = request, for_good, False

    def chunk(self, data):
        if data == self.request and not self.for_good:
            raise ConnectionAbortedError
        self.dead = self.dead or data == self.request
        return b"" if self.dead else data


def looks_at_gone(address):
    """A scanner that goes away ends the check. One that comes back after a hang-up goes on with the next check."""
    listener = socket.create_server(("127.0.0.1", 0))
    place = "127.0.0.1:%d" % listener.getsockname()[1]

    def serve():
        """Answers QT, and refuses the rest, until a request that is only MD ends it."""
        client, _ = listener.accept()
        with client, client.makefile("rb") as lines:
            for line in lines:
                request = line.rstrip(b"\n")
                if request == b"MD":
                    return listener.close()
                if request:
                    client.sendall(request + (b"\n00P\n\n" if request == b"QT" else b"\n0Eu\n\n"))

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    done = run("tcp://" + place, "--json")
    thread.join(10)
    report = json.loads(done.stdout)
    sentence = f"the scanner has gone after MD: cannot connect to {place.replace(':', ' port ')}: Connection refused"
    assert done.returncode == 2 and done.stderr.startswith(f"scipcat: {sentence}; "), done.stderr
    assert [check["id"] for check in report["checks"]] == ["1.1", "1.2", "1.3", "1.4", "2.0"], report
    assert report["checks"][-1]["why"] == sentence and report["failed"] == 1, report

    sections = ["--section", "4", "--section", "9.3"]
    with WrongScanner(address, HangsUp(b"TM0\n", for_good=True)) as wrong:
        done = run(wrong.target, "--json", "--timeout", "0.3", *sections)
    checks = json.loads(done.stdout)["checks"]
    assert done.returncode == 2 and "the scanner has gone after TM0: nothing answers QT" in done.stderr, done.stderr
    assert checks[-1]["verdict"] == "fail" and checks[-1]["sent"].endswith(r"TM0\n"), checks[-1]
    assert not any(check["verdict"] == "fail" for check in checks[:-1]), checks

    with WrongScanner(address, HangsUp(b"MD\n")) as wrong:
        done = run(wrong.target, "--json", *sections)
    checks = json.loads(done.stdout)["checks"]
    assert [check["id"] for check in checks if check["verdict"] == "fail"] == ["9.3"], checks
    assert done.returncode == 1 and "closed the connection" in checks[-1]["why"], checks[-1]


def looks_at_interruption(target, address, folder):
    """The report has what was checked so far, and the scanner is left at rest."""
    junit = folder / "half.xml"
    process = subprocess.Popen([SCIPCAT, "check", target, "--json", "--junit", junit], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    time.sleep(2.0)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=20)
    assert process.returncode == 1 and "interrupted before all checks were made" in err, err
    made = len(json.loads(out)["checks"])
    assert 5 < made < 160 and len(xml.parse(junit).getroot().findall(".//testcase")) == made, made
    client = Client(address)
    assert b"10Q" in client.ask("GD0540054001")
    client.close()


def looks_at_progress(target):
    """Somebody who watches sees how far it is."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen([SCIPCAT, "check", target, "--section", "2"], stdout=subprocess.DEVNULL, stderr=theirs)
    assert process.wait(60) == 0
    os.close(theirs)
    shown = ""
    with contextlib.suppress(OSError):  # there is no more
        while True:
            shown += os.read(ours, 65536).decode()
    assert "4 of 15  2.4 the figures of PP" in shown and shown.endswith("\x1b[K"), shown
    os.close(ours)


def main():
    keys = {"model": "UST-10LX", "tcp": "127.0.0.1:0", "mount": {"xyz": [0, 0, 0.3]}}
    with Lab(SCIPD, SCENE, sensors={"one": keys}, lockstep=False) as lab, tempfile.TemporaryDirectory() as name:
        address, folder = lab.address("one"), pathlib.Path(name)
        target = "tcp://%s:%d" % address
        looks_at_json(target)
        looks_at_files(address, folder)
        looks_at_wrong_words(target, folder)
        looks_at_who_hangs_up()
        looks_at_unknown_command(address)
        looks_at_gone(address)
        looks_at_interruption(target, address, folder)
        looks_at_progress(target)


if __name__ == "__main__":
    main()
