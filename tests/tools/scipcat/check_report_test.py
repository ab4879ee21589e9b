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
from wrong_scanner import WrongScanner, answers, says  # noqa: E402

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
                 "source  SCIP 2.0", "3 checks: 0 pass, 1 fail, 1 differ as is known, 1 not applicable",
                 "known   XX is answered with 0F, not 0E, as is known: a real UST-10LX 2.23"):
        assert part in broken.stdout, (part, broken.stdout)

    suites = xml.parse(junit).getroot().findall("testsuite")
    assert [suite.get("tests") for suite in suites] == ["14", "9"] and suites[1].get("skipped") == "9"
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
        assert done.returncode == 2 and "nothing answers QT" in done.stderr, done


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
    assert "3 of 14  2.4 the figures of PP" in shown and shown.endswith("\x1b[K"), shown
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
        looks_at_interruption(target, address, folder)
        looks_at_progress(target)


if __name__ == "__main__":
    main()
