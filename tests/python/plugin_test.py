# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# pytest with the fixture `scipd`, as those who write tests see it: what a failed test leaves, and that nothing runs on.
import os
import pathlib
import signal
import subprocess
import sys
import xml.etree.ElementTree

import pytest
from conftest import eventually

PLUGIN = ("-p", "scipd.pytest_plugin", "-p", "no:cacheprovider")


@pytest.fixture
def run(pytester, room):
    """Runs a test file in a pytest of its own."""
    def run_file(text, *options):
        pytester.makepyfile("import os, signal, time, pytest\n" + text.replace("ROOM", repr(str(room))))
        return pytester.runpytest_subprocess(*PLUGIN, *options)
    return run_file


FAILS = """
def test_a_wall(scipd):
    daemon = scipd(world=ROOM)
    daemon.scan()
    time.sleep(0.2)
    assert daemon.scan().at(0) > 100
"""


def test_a_failed_test_keeps_log_wire_and_last_scans(run, pytester):
    result = run(FAILS)
    result.assert_outcomes(failed=1)
    kept = pytester.path / "scipd-failed" / "test_a_failed_test_keeps_log_wire_and_last_scans.py-test_a_wall"
    result.stdout.fnmatch_lines(["*- scipd -*", f"log, wire and last scans are in {kept}; the end of the log:",
                                 "*info*"])
    assert "info" in (kept / "scipd.log").read_text()
    assert "tcp > ME0000108001001" in (kept / "wire.txt").read_text()
    recording = (kept / "last_scans.mcap").read_bytes()
    assert recording.startswith(b"\x89MCAP0\r\n") and recording.count(b"distances_mm") > 3
    run(FAILS.replace("> 100", "> 1")).assert_outcomes(passed=1)
    assert not kept.exists(), "what an earlier run has kept is gone"


def test_it_lies_beside_the_report_which_names_it(run, pytester):
    run(FAILS, "--junitxml", "out/report.xml").assert_outcomes(failed=1)
    kept = pytester.path / "out" / "scipd-failed" / "test_it_lies_beside_the_report_which_names_it.py-test_a_wall"
    assert (kept / "wire.txt").exists()
    properties = xml.etree.ElementTree.parse(pytester.path / "out" / "report.xml").iter("property")
    assert [p.get("value") for p in properties if p.get("name") == "scipd"] == [str(kept)]
    run(FAILS, "--scipd-keep", "elsewhere", "--scipd-last", "0").assert_outcomes(failed=1)
    kept = pytester.path / "elsewhere" / kept.name
    assert sorted(file.name for file in kept.iterdir()) == ["scipd.log", "wire.txt"]


def test_several_daemons_and_blocks_have_a_folder_each(run, pytester):
    result = run("""
def test_two(scipd):
    with scipd(world=ROOM) as first, scipd(world=ROOM) as second:
        assert first.port == second.port
""")
    result.assert_outcomes(failed=1)
    kept, = (pytester.path / "scipd-failed").iterdir()
    assert sorted(str(file.relative_to(kept)) for file in kept.rglob("*.txt")) == ["1/wire.txt", "2/wire.txt"]


def test_a_test_that_passes_keeps_nothing(run, pytester):
    result = run("""
def test_fine(scipd):
    assert scipd(world=ROOM).scan().nearest()
def test_without(request):
    assert request
""")
    result.assert_outcomes(passed=2)
    assert not (pytester.path / "scipd-failed").exists()


def test_a_daemon_that_crashes_fails_its_test(run):
    result = run("""
def test_crash(scipd):
    daemon = scipd(world=ROOM)
    os.kill(daemon.pid, signal.SIGABRT)
    time.sleep(1)
def test_after_it(scipd):
    scipd(world=ROOM).scan()
""")
    result.assert_outcomes(passed=2, errors=1)
    result.stdout.fnmatch_lines(["*ScipdEnded: scipd was ended by signal 6*"])


SLEEPS = """
def test_sleeps(scipd):
    daemon = scipd(world=ROOM)
    print("pid", daemon.pid, flush=True)
    time.sleep(300)
"""


def test_a_test_that_times_out_by_an_alarm_keeps_all_and_ends_all(run, pytester):
    # As pytest-timeout does with its method `signal`.
    result = run(SLEEPS.replace("    time", "    signal.signal(signal.SIGALRM, lambda *_: pytest.fail('too long'))\n"
                                            "    signal.alarm(1)\n    time"))
    result.assert_outcomes(failed=1)
    assert list((pytester.path / "scipd-failed").rglob("last_scans.mcap"))


@pytest.mark.parametrize("method", ["signal", "thread"])
def test_with_pytest_timeout(run, method):
    # The method `thread` ends the whole process where it stands.
    pytest.importorskip("pytest_timeout")
    result = run(SLEEPS, "-s", "-p", "pytest_timeout", "--timeout", "3", "--timeout-method", method)
    assert result.ret != 0
    pid = int(result.stdout.str().split("pid ")[1].split()[0])
    eventually(lambda: not os.path.exists(f"/proc/{pid}"), "scipd lives on")


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_a_run_that_is_killed_leaves_nothing(pytester, room, number):
    file = pytester.makepyfile("import time\n" + SLEEPS.replace("ROOM", repr(str(room))))
    with subprocess.Popen([sys.executable, "-m", "pytest", *PLUGIN, "-s", str(file)], stdout=subprocess.PIPE, text=True,
                          start_new_session=True) as process:
        line = next(line for line in process.stdout if "pid " in line)
        # All of the run, as those do who wait no longer; and a terminal whose user presses Ctrl-C.
        os.killpg(process.pid, number)
        process.communicate(timeout=60)
    pid = int(line.split("pid ")[1])
    eventually(lambda: not os.path.exists(f"/proc/{pid}"), "scipd lives on")


def test_a_folder_that_cannot_be_written_is_told(run, pytester):
    (pytester.path / "file").write_text("")
    result = run(FAILS, "--scipd-keep", "file")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["nothing is kept in *file/*: *"])


def test_the_fixture_is_told_with_all_others(run):
    result = run("", "--fixtures")
    result.stdout.fnmatch_lines(["scipd*pytest_plugin.py*", "*Starts a scipd for this test*"])
    assert pathlib.Path("scipd-failed").exists() is False
