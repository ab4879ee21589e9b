# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# A daemon begins and ends with whoever started it, and nobody else's does.
import concurrent.futures
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import urllib.request

import pytest
from conftest import eventually, processes_in

import scipd as package
from scipd import Scipd, ScipdEnded, ScipdNotFound, ScipdNotReady, find_program
from scipd.program import find_world


def test_it_is_ready_where_it_says(room):
    with Scipd(world=room) as daemon:
        socket.create_connection((daemon.host, daemon.port)).close()
        assert os.path.exists(daemon.tty) and os.path.exists(daemon.control)
        with urllib.request.urlopen(daemon.http + "health") as answer:
            assert json.load(answer) == {"ready": True, "alive": True}
        folder = pathlib.Path(daemon.control).parent
        assert daemon.exit_code is None
    assert not folder.exists()
    assert daemon.exit_code == 0
    assert "stopped (SIGTERM)" in daemon.log, "the log can be read afterwards"
    daemon.close()
    with pytest.raises(ScipdEnded, match="was closed"):
        daemon.robot().pose


def test_without_arguments_it_is_a_ust_10lx_in_the_maze():
    with Scipd() as daemon:
        assert daemon.sensor().model == "UST-10LX"
        assert "maze" in daemon.status["scene"]


def test_twenty_side_by_side(scipd, room):
    def start(i):
        daemon = scipd(world=room, accuracy="ideal", seed=i, args=["--threads", "1"])
        daemon.robot().pose = (0.1 * i - 1, 0, 0)
        return daemon

    with concurrent.futures.ThreadPoolExecutor(20) as pool:
        daemons = list(pool.map(start, range(20)))
        scans = list(pool.map(lambda daemon: daemon.scan(timeout_s=60), daemons))
    assert len({daemon.port for daemon in daemons}) == 20
    for i, scan in enumerate(scans):
        assert scan.at(0) == pytest.approx(4 - 0.1 * i, abs=0.0015)


def test_a_configuration_has_any_number_of_sensors(room):
    sensors = {"front": {"model": "UST-10LX", "tcp": "127.0.0.1:0", "mount": {"xyz": [0, 0, 0.3]}},
               "rear": {"model": "URG-04LX", "pty": "auto", "mount": {"xyz": [0, 0, 0.3], "rpy": [0, 0, 3.14159]}},
               "sonar": {"ranger": {"cone_deg": 10, "beams": 7, "rate_hz": 20, "range_m": [0.02, 4.0]}}}
    with Scipd(config={"scene": str(room), "robots": {"rescue": {"sensors": sensors}}}, seed=3) as daemon:
        assert list(daemon.sensors) == ["rescue/front", "rescue/rear", "rescue/sonar"]
        assert daemon.robot().name == daemon.robot("rescue").name == "rescue"
        assert daemon.sensor("rear").port is None and daemon.scan("rear").at(0) == pytest.approx(3, abs=0.1)
        assert daemon.scan("front").at(0) == pytest.approx(3, abs=0.1)
        assert daemon.truth("sonar").nearest() is not None
        with pytest.raises(ValueError, match="say which sensor: rescue/front, rescue/rear"):
            daemon.scan()
        with pytest.raises(ValueError, match="there is no robot 'cart'; there are: rescue"):
            daemon.robot("cart")


def test_args_hold_in_place_of_what_would_be_chosen(room):
    with Scipd(world=room, accuracy="ideal", args=["--mount", "1,0,0.3,0,0,0", "--http", "none"]) as daemon:
        assert daemon.http is None
        assert daemon.scan().at(0) == 2.0


def test_what_is_wrong_is_told_with_the_end_of_the_log(tmp_path):
    with pytest.raises(ScipdNotReady, match="exit code 2(.|\n)*there is no file '.*nowhere"):
        Scipd(world="nowhere.sdf")
    with pytest.raises(ScipdNotReady, match="unknown model|UST-99"):
        Scipd(model="UST-99")
    with pytest.raises(ValueError, match="clock is 'wall' or 'poses', not 'sun'"):
        Scipd(clock="sun")
    with pytest.raises(ValueError, match="write it there"):
        Scipd(config=tmp_path / "rig.yaml", accuracy="ideal")


def test_the_program_is_found_by_SCIPD_then_PATH_then_beside_the_package(monkeypatch, tmp_path):
    there = find_program()
    monkeypatch.setenv("SCIPD", "/nowhere/scipd")
    with pytest.raises(ScipdNotFound, match="SCIPD names /nowhere/scipd"):
        find_program()
    monkeypatch.delenv("SCIPD")
    monkeypatch.setenv("PATH", str(pathlib.Path(there).parent))
    assert find_program() == there
    monkeypatch.setenv("PATH", str(tmp_path))
    built = tmp_path / "build" / "release" / "bin" / "scipd"
    monkeypatch.setattr("scipd.program._ROOT", tmp_path)
    with pytest.raises(ScipdNotFound, match="install the package scipd"):
        find_program()
    built.parent.mkdir(parents=True)
    built.symlink_to(there)
    assert find_program() == str(built)


def test_a_scene_that_ships_is_found_by_its_name(monkeypatch, tmp_path, room):
    monkeypatch.chdir(tmp_path)
    with Scipd(world="square_room", accuracy="ideal") as daemon:
        assert daemon.scan().at(0) == 3.0
        daemon.scene.load("corridor")
        assert daemon.status["scene"].endswith("scenes/corridor.sdf")
    assert find_world("office_map") == str(room.parent / "office_map.yaml")
    assert find_world("there.sdf") == "there.sdf"
    with pytest.raises(ValueError, match="no scene of that name .*; there are: corridor, crossing, .*square_room"):
        Scipd(world="round_room")
    # The layout of the Debian package; a file of this folder comes first.
    (tmp_path / "usr/bin").mkdir(parents=True)
    shutil.copy(find_program(), tmp_path / "usr/bin/scipd")
    shutil.copytree(room.parent, tmp_path / "usr/share/scipd/scenes")
    monkeypatch.setenv("SCIPD", str(tmp_path / "usr/bin/scipd"))
    assert find_world("depot") == str(tmp_path / "usr/share/scipd/scenes/depot.sdf")
    (tmp_path / "depot").mkdir()
    assert find_world("depot") == "depot"


def test_a_crash_is_told_to_whoever_asks_next(room):
    with Scipd(world=room) as daemon:
        os.kill(daemon.pid, signal.SIGSEGV)
        with pytest.raises(ScipdEnded, match="was ended by signal 11(.|\n)*The end of its log:(.|\n)*info"):
            eventually(lambda: daemon.status is None, "it lives on")
        assert daemon.exit_code == -11


def test_a_crash_that_nobody_was_told_of_is_told_at_the_end(room):
    with pytest.raises(ScipdEnded, match="was ended by signal 6"):
        with Scipd(world=room) as daemon:
            os.kill(daemon.pid, signal.SIGABRT)
            eventually(lambda: not os.path.exists(f"/proc/{daemon.pid}"), "it lives on")


def test_nobody_elses_scipd_is_ended(room, tmp_path):
    other = subprocess.Popen([find_program(), "--scene", room, "--tcp", "127.0.0.1:0", "--pty", "none", "--control",
                              tmp_path / "s"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    try:
        assert b"ready" in other.stdout.readline()
        with Scipd(world=room) as daemon:
            assert daemon.pid != other.pid
        assert other.poll() is None
    finally:
        other.terminate()
        other.wait()
        other.stdout.close()


STARTS_ONE = """
import os, signal, sys, time
from scipd import Scipd
daemon = Scipd(world={room!r})
print(daemon.pid, flush=True)
{end}
"""


@pytest.mark.parametrize("end", ["os._exit(3)", "os.kill(os.getpid(), signal.SIGKILL)", "sys.exit()", "1 / 0",
                                 "os.kill(os.getpid(), signal.SIGTERM)"])
def test_it_ends_with_its_process_however_that_ends(room, end, folder_of_daemons):
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(package.__file__).parents[1])}
    done = subprocess.run([sys.executable, "-c", STARTS_ONE.format(room=str(room), end=end)], env=environment,
                          capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode != 0 or end == "sys.exit()", done
    pid = int(done.stdout)
    eventually(lambda: not os.path.exists(f"/proc/{pid}"), "scipd lives on")
    eventually(lambda: not list(folder_of_daemons.glob("scipd-*")), "its folder is left")


def test_it_ends_with_its_process_though_what_that_has_forked_lives_on(room):
    end = "child = os.fork()\ntime.sleep(0 if child else 20)\nos._exit(0)"
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(package.__file__).parents[1])}
    with subprocess.Popen([sys.executable, "-c", STARTS_ONE.format(room=str(room), end=end)], env=environment,
                          stdout=subprocess.PIPE, text=True) as process:
        pid = int(process.stdout.readline())
        process.wait(60)
        eventually(lambda: not os.path.exists(f"/proc/{pid}"), "scipd lives on")


def test_what_is_forked_does_not_end_it(room):
    with Scipd(world=room) as daemon:
        child = os.fork()
        if child == 0:
            try:
                daemon._process.end()
            finally:
                os._exit(0)
        os.waitpid(child, 0)
        assert daemon.exit_code is None and daemon.status["sensors"]


def test_it_ends_with_its_keeper(room, folder_of_daemons):
    daemon = Scipd(world=room)
    pid = daemon.pid
    os.kill(daemon._process._keeper.pid, signal.SIGKILL)
    eventually(lambda: not os.path.exists(f"/proc/{pid}"), "scipd lives on")
    with pytest.raises(ScipdEnded, match="signal 9"):
        daemon.close()
    assert not processes_in(folder_of_daemons / "scipd-")
    for folder in folder_of_daemons.glob("scipd-*"):  # the one thing that only the keeper could do
        for file in folder.iterdir():
            file.unlink()
        folder.rmdir()
