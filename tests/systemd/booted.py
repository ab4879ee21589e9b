# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Tests scipd as a service of the systemd that runs here. tools/test-systemd runs this inside a container; nowhere else
# should it be run, as it makes users and changes /etc/scipd.
import contextlib
import grp
import json
import os
import pathlib
import pwd
import re
import signal
import socket
import stat
import subprocess
import termios
import time

PATIENCE_S = 60
ETC = pathlib.Path("/etc/scipd")
RUN = pathlib.Path("/run/scipd")
SCENES = "/usr/share/scipd/scenes"
WORST_EXPOSURE = 2.0
UNITS = ["scipd.service", "scipd@demo.service", "scipd@demo.socket"]
FRONT, DEMO = ("127.0.0.1", 10940), ("127.0.0.1", 10950)
SENSORS = {"front": {"model": "UST-10LX", "tcp": "127.0.0.1:10940", "pty": "auto", "backend": "embree"},
           "rear": {"model": "URG-04LX", "pty": "/run/scipd/rear", "backend": "depth"}}


def run(*command, check=True):
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S)
    assert not check or done.returncode == 0, (command, done.stdout, done.stderr, journal())
    return done.stdout + done.stderr


def journal():
    return subprocess.run(["journalctl", "--no-pager", "-n", "60", "-u", "scipd*"], capture_output=True,
                          text=True).stdout


def show(unit, name):
    return run("systemctl", "show", "--property", name, "--value", unit).strip()


def main_process(unit):
    return int(show(unit, "MainPID"))


def wait_for(what, condition):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.1)
    raise AssertionError(f"{what} did not come within {PATIENCE_S} s\n{journal()}")


def files_in(folder):
    """Without the folders of instances."""
    return [path.name for path in folder.iterdir() if not path.is_dir()]


def reload():
    """systemd does not wait for the end of it."""
    def done():
        return run("journalctl", "-u", "scipd").count("SIGHUP: ")
    before = done()
    run("systemctl", "reload", "scipd")
    wait_for("the end of the reload", lambda: done() > before)


def configure(name, sensors, scene=f"{SCENES}/rescue_maze.sdf", **more):
    ETC.mkdir(exist_ok=True)
    (ETC / f"{name}.yaml").write_text(json.dumps(
        {"scene": scene, "robots": {"rescue": {"sensors": sensors}}, **more}))


class Driver:
    """Of a scanner, by TCP."""

    def __init__(self, address):
        self.socket = socket.create_connection(address, timeout=PATIENCE_S)
        self.got = b""

    def ask(self, line):
        self.socket.sendall(line + b"\n")
        return self.read_until(b"\n\n")

    def read_until(self, end):
        while end not in self.got:
            more = self.socket.recv(65536)
            if not more:
                raise ConnectionError
            self.got += more
        said, _, self.got = self.got.partition(end)
        return said

    def cut_off(self):
        """Whether the scanner goes away, sooner or later."""
        try:
            while self.socket.recv(65536):
                pass
        except ConnectionError:
            pass
        return True


def ask_tty(path, *lines):
    """The answers, by default to VV."""
    with contextlib.closing(open(path, "r+b", buffering=0)) as tty:
        settings = termios.tcgetattr(tty)
        settings[3] &= ~(termios.ICANON | termios.ECHO)
        termios.tcsetattr(tty, termios.TCSANOW, settings)
        got = b""
        for number, line in enumerate(lines or [b"VV"], 1):
            tty.write(line + b"\n")
            while got.count(b"\n\n") < number:
                got += tty.read(4096)
        return got


def get(path, where="/status"):
    with contextlib.closing(socket.socket(socket.AF_UNIX)) as client:
        client.settimeout(PATIENCE_S)
        client.connect(str(path))
        client.sendall(f"GET {where} HTTP/1.1\r\nHost: scipd\r\nConnection: close\r\n\r\n".encode())
        answer = b"".join(iter(lambda: client.recv(65536), b""))
    return json.loads(answer.partition(b"\r\n\r\n")[2])


def as_user(user, function, *arguments):
    """Whether this works for the user."""
    child = os.fork()
    if child == 0:
        try:
            entry = pwd.getpwnam(user)
            os.initgroups(user, entry.pw_gid)
            os.setgid(entry.pw_gid)
            os.setuid(entry.pw_uid)
            function(*arguments)
            os._exit(0)
        except OSError:
            os._exit(1)
        finally:
            os._exit(2)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def units_are_right():
    run("systemd-analyze", "verify", "--man=no", *UNITS)
    for unit in UNITS[:2]:
        exposure = float(re.search(r"exposure level for \S+: ([0-9.]+)", run("systemd-analyze", "security", unit))[1])
        assert exposure <= WORST_EXPOSURE, (unit, exposure)
        print(f"    {unit}: exposure {exposure}")


def it_starts():
    configure("scipd", SENSORS)
    run("systemctl", "start", "scipd")
    assert show("scipd", "ActiveState") == "active"
    status = show("scipd", "StatusText")
    assert status.startswith("2 sensors in rescue_maze.sdf: rescue/front on 127.0.0.1:10940 and "
                             "/run/scipd/rescue-front, rescue/rear on /run/scipd/rear"), status
    assert b"UST-10LX" in Driver(FRONT).ask(b"VV")
    for tty, model in (("rescue-front", b"UST-10LX"), ("rear", b"URG-04LX")):
        assert model in ask_tty(RUN / tty), tty


def both_backends_cast():
    """The second one draws with what Mesa compiles, within the confines of the unit."""
    driver = Driver(FRONT)
    driver.ask(b"MD0540054000003")
    assert b"99b" in driver.read_until(b"\n\n")
    assert b"GD0044072501\n00P\n" in ask_tty(RUN / "rear", b"BM", b"GD0044072501")
    sensors = {sensor["name"]: sensor for sensor in get(RUN / "control.sock")["sensors"]}
    assert sensors["rescue/front"]["casts"].get("embree", 0) >= 3, sensors
    assert sensors["rescue/rear"]["casts"].get("depth", 0) >= 1, sensors


def its_group_gets_in_and_nobody_else():
    for user, groups in (("robot", "scipd"), ("stranger", "")):
        run("useradd", *(["--groups", groups] if groups else []), user, check=False)
    for tried, *how in ((get, RUN / "control.sock"), (ask_tty, RUN / "rescue-front")):
        assert as_user("robot", tried, *how), how
        assert not as_user("stranger", tried, *how), how
    tty = os.stat(os.path.realpath(RUN / "rear"))
    assert stat.S_IMODE(tty.st_mode) == 0o660 and tty.st_gid == grp.getgrnam("scipd").gr_gid, tty
    assert not as_user("stranger", lambda: os.close(os.open(os.path.realpath(RUN / "rear"), os.O_RDWR)))


def a_child_that_reads_a_world_is_bounded():
    """The filter of calls lets it bound itself: a file that is not what it seems would take all memory."""
    (ETC / "large.obj").write_text("v 0 0 0\n" * 3 + "f 1 2 3\n" + "vn 0 0 1\n" * 4_000_000)
    configure("small", {"front": {"model": "UST-10LX", "tcp": "127.0.0.1:0"}}, scene="large.obj",
              limits={"world_memory_mb": 40})
    run("systemctl", "start", "scipd@small", check=False)
    assert show("scipd@small", "ActiveState") == "failed"
    assert show("scipd@small", "ExecMainStatus") == "2" and show("scipd@small", "NRestarts") == "0"
    status = show("scipd@small", "StatusText")
    assert status.startswith("cannot start: ") and "takes more than 40 MB of memory" in status, status
    run("systemctl", "reset-failed", "scipd@small")


def the_journal_knows_scanners():
    entries = [json.loads(line) for line in
               run("journalctl", "-o", "json", "SCIPD_SENSOR=rescue/small").splitlines()]
    assert not entries, entries
    configure("scipd", {**SENSORS, "front": {**SENSORS["front"], "backend": "auto"}})
    reload()
    wait_for("an entry", lambda: run("journalctl", "-o", "json", "SCIPD_SENSOR=rescue/front"))
    entry = json.loads(run("journalctl", "-o", "json", "SCIPD_SENSOR=rescue/front").splitlines()[0])
    assert entry["MESSAGE"].startswith("rescue/front: ") and entry["_SYSTEMD_UNIT"] == "scipd.service", entry
    configure("scipd", SENSORS)
    reload()


def a_reload_is_told():
    driver = Driver(FRONT)
    configure("scipd", {**SENSORS, "third": {"model": "UST-20LX", "tcp": "127.0.0.1:10942"}})
    reload()
    wait_for("the third", lambda: show("scipd", "StatusText").startswith("3 sensors"))
    assert b"UST-20LX" in Driver(("127.0.0.1", 10942)).ask(b"VV")
    (ETC / "scipd.yaml").write_text("robots: {}\n")
    reload()
    wait_for("a word", lambda: "the last reload changed nothing: " in show("scipd", "StatusText"))
    assert show("scipd", "ActiveState") == "active" and show("scipd", "NRestarts") == "0"
    configure("scipd", SENSORS)
    reload()
    wait_for("two", lambda: re.match("2 sensors(?!.*changed nothing)", show("scipd", "StatusText")))
    assert b"UST-10LX" in driver.ask(b"VV")  # it was connected all the time


def everything_comes_back_after_a_kill():
    driver = Driver(FRONT)
    driver.ask(b"MD0540054000000")
    os.kill(main_process("scipd"), signal.SIGKILL)
    assert driver.cut_off()
    wait_for("a restart", lambda: show("scipd", "NRestarts") == "1" and show("scipd", "ActiveState") == "active")
    driver = Driver(FRONT)
    driver.ask(b"MD0540054000000")
    assert b"99b" in driver.read_until(b"\n\n")
    for tty in ("rescue-front", "rear"):
        assert b"VEND" in ask_tty(RUN / tty), tty
    assert len(get(RUN / "control.sock")["sensors"]) == 2
    used = ["control.sock", "rear", "rescue-front"]
    assert sorted(files_in(RUN)) == [f".{name}.lock" for name in used] + used, files_in(RUN)


def a_stuck_one_is_started_again():
    drop_in = pathlib.Path("/run/systemd/system/scipd.service.d/test.conf")
    drop_in.parent.mkdir(parents=True)
    drop_in.write_text("[Service]\nWatchdogSec=2s\n")
    run("systemctl", "daemon-reload")
    run("systemctl", "restart", "scipd")
    driver = Driver(FRONT)
    time.sleep(5)
    assert show("scipd", "NRestarts") == "0"  # its laser is off
    driver.ask(b"MD0540054000000")
    os.kill(main_process("scipd"), signal.SIGSTOP)
    wait_for("a restart", lambda: show("scipd", "NRestarts") == "1" and show("scipd", "ActiveState") == "active")
    assert "Watchdog timeout" in journal()
    assert b"UST-10LX" in Driver(FRONT).ask(b"VV")
    drop_in.unlink()
    run("systemctl", "daemon-reload")


def it_ends_and_leaves_nothing():
    run("systemctl", "stop", "scipd")
    assert show("scipd", "Result") == "success" and show("scipd", "ExecMainStatus") == "0"
    assert not files_in(RUN), files_in(RUN)


def the_first_client_starts_an_instance():
    """On a port of its own, beside scipd.service."""
    run("systemctl", "start", "scipd")
    drop_in = pathlib.Path("/run/systemd/system/scipd@demo.socket.d/test.conf")
    drop_in.parent.mkdir(parents=True)
    drop_in.write_text("[Socket]\nListenStream=\nListenStream=%s:%d\nListenStream=/run/scipd/%%i/control.sock\n" % DEMO)
    run("systemctl", "daemon-reload")
    configure("demo", {"front": {"model": "UST-20LX", "tcp": "127.0.0.1:10950", "pty": "auto"}})
    run("systemctl", "start", "scipd@demo.socket")
    assert not as_user("stranger", get, RUN / "demo/control.sock")
    assert show("scipd@demo", "ActiveState") == "inactive"
    assert as_user("robot", get, RUN / "demo/control.sock")
    assert show("scipd@demo", "ActiveState") == "active"
    run("systemctl", "stop", "scipd@demo")
    for _ in range(2):
        assert show("scipd@demo", "ActiveState") == "inactive"
        assert b"UST-20LX" in Driver(DEMO).ask(b"VV")
        assert show("scipd@demo", "ActiveState") == "active"
        assert b"UST-20LX" in ask_tty(RUN / "demo/rescue-front")
        assert "hands over" not in run("journalctl", "-u", "scipd@demo")
        run("systemctl", "stop", "scipd@demo")
    assert b"UST-20LX" in Driver(DEMO).ask(b"VV")
    assert len(get(RUN / "control.sock")["sensors"]) == 2  # the other one is as it was
    os.kill(main_process("scipd@demo"), signal.SIGKILL)
    assert b"UST-20LX" in Driver(DEMO).ask(b"VV")
    run("systemctl", "stop", "scipd@demo.socket", "scipd@demo", "scipd")
    assert show("scipd@demo", "Result") == "success"
    assert not files_in(RUN) and not files_in(RUN / "demo"), (files_in(RUN), files_in(RUN / "demo"))


def main():
    for test in (units_are_right, it_starts, both_backends_cast, its_group_gets_in_and_nobody_else,
                 a_child_that_reads_a_world_is_bounded, the_journal_knows_scanners, a_reload_is_told,
                 everything_comes_back_after_a_kill, a_stuck_one_is_started_again, it_ends_and_leaves_nothing,
                 the_first_client_starts_an_instance):
        print(test.__name__.replace("_", " "), flush=True)
        test()


if __name__ == "__main__":
    main()
