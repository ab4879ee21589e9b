# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What scipd tells systemd, and when it feeds the watchdog: notify_test.py SCIPD SCENES
import json
import os
import pathlib
import re
import signal
import socket
import sys
import tempfile
import time

from manager import PATIENCE_S, Manager, run_all
from fault_lab import Client, Control

WATCHDOG_S = 1.0  # fed four times in this
SENSOR = {"model": "UST-10LX", "tcp": "127.0.0.1:0"}


def configuration(scenes, *sensors, **more):
    return {"scene": str(scenes / "square_room.sdf"),
            "robots": {"rescue": {"sensors": {name: SENSOR for name in sensors}}}, **more}


def start(scipd, folder, document, **how):
    scipd = Manager(scipd, folder, document, **how)
    scipd.ready()
    return scipd


def says_what_it_serves_and_where(program, scenes, folder):
    with start(program, folder, configuration(scenes, "front", "rear")) as scipd:
        assert any("loads" in m.get("STATUS", "") and "square_room.sdf" in m["STATUS"] for m in scipd.told), scipd.told
        assert scipd.status.startswith("2 sensors in square_room.sdf: "), scipd.status
        for sensor in scipd.line["sensors"]:
            assert f"{sensor['name']} on {sensor['tcp']}" in scipd.status, scipd.status
        scipd.process.terminate()
        scipd.hear("STOPPING", STOPPING="1")
        assert scipd.process.wait(PATIENCE_S) == 0
        assert not any("WATCHDOG" in message for message in scipd.told), scipd.told


def names_some_of_many(program, scenes, folder):
    with start(program, folder, configuration(scenes, *"abcdefg")) as scipd:
        assert scipd.status.startswith("7 sensors in square_room.sdf: rescue/a on "), scipd.status
        assert scipd.status.endswith(" and 3 more"), scipd.status


def tells_every_reload_from_its_beginning_to_its_end(program, scenes, folder):
    with start(program, folder, configuration(scenes, "front")) as scipd:
        scipd.configure(configuration(scenes, "front", "rear"))
        assert scipd.reload().startswith("2 sensors in square_room.sdf: rescue/front on ")
        scipd.configure("scene: [\n")
        status = scipd.reload()
        assert status.startswith("2 sensors in "), status
        assert "the last reload changed nothing: " in status and "service.yaml:" in status, status
        scipd.configure(configuration(scenes, "rear"))
        status = scipd.reload()
        assert status.startswith("1 sensor in ") and "changed nothing" not in status, status
        assert scipd.process.poll() is None


def asks_for_as_much_time_as_the_world_may_take(program, scenes, folder):
    with start(program, folder, configuration(scenes, "front", limits={"world_load_s": 2000})) as scipd:
        # Beside the world there are five minutes for all else.
        assert any(m.get("EXTEND_TIMEOUT_USEC") == "2300000000" for m in scipd.told), scipd.told


def tells_of_another_world(program, scenes, folder):
    document = configuration(scenes, "front", allow=[str(scenes)])
    with start(program, folder, document) as scipd:
        status, answer = scipd.control.ask("PUT", "/scene", {"file": str(scenes / "rescue_maze.sdf")})
        assert status < 300, answer
        assert scipd.hear("STATUS")["STATUS"].startswith("1 sensor in rescue_maze.sdf: ")


def says_why_it_cannot_start(program, scenes, folder):
    document = configuration(scenes, "front")
    document["robots"]["rescue"]["sensors"]["front"] = {"model": "UST-10LX", "tcp": "192.0.2.1:10940"}
    with Manager(program, folder, document) as scipd:
        assert scipd.process.wait(PATIENCE_S) == 1  # the address may come with its network
        status = scipd.hear("STATUS", patience_s=1)["STATUS"]
        while not status.startswith("cannot start: "):
            status = scipd.hear("STATUS", patience_s=1)["STATUS"]
        assert "192.0.2.1:10940" in status, status
        assert not any("READY" in message for message in scipd.told)


def says_what_is_wrong_with_its_configuration(program, scenes, folder):
    with Manager(program, folder, "robots: 1\nscene: nowhere.sdf\n") as scipd:
        assert scipd.process.wait(PATIENCE_S) == 2
        status = scipd.hear("STATUS", patience_s=1)["STATUS"]
        assert re.match(r"cannot start: \S+/service\.yaml:\d: .*/service\.yaml:\d: ", status), status
        assert "service.yaml:" in scipd.log(), scipd.log()


def feeds_the_watchdog_whoever_wants_scans(program, scenes, folder):
    with start(program, folder, configuration(scenes, "front"), watchdog_s=WATCHDOG_S) as scipd:
        assert scipd.meals(2 * WATCHDOG_S) >= 3  # its laser is off
        client = Client(scipd.address("rescue/front"))
        client.ask("MD0540054000000")
        client.read_until(b"\n\n")
        assert scipd.meals(2 * WATCHDOG_S) >= 3
        client.close()
        assert scipd.meals(2 * WATCHDOG_S) >= 3


def feeds_it_while_time_stands_still(program, scenes, folder):
    document = configuration(scenes, "front", clock="poses")
    document["robots"]["rescue"]["poses"] = "udp:127.0.0.1:0"
    with start(program, folder, document, watchdog_s=WATCHDOG_S) as scipd:
        client = Client(scipd.address("rescue/front"))
        client.ask("BM")
        client.ask("MD0540054000000")
        assert scipd.meals(2 * WATCHDOG_S) >= 3


def feeds_it_beside_a_fault_on_purpose(program, scenes, folder):
    with start(program, folder, configuration(scenes, "front"), watchdog_s=WATCHDOG_S) as scipd:
        client = Client(scipd.address("rescue/front"))
        client.ask("MD0540054000000")
        for fault in ({"kind": "late", "ms": 900}, {"kind": "skip", "rate": 1}, {"kind": "sleep", "for": {"s": 30}}):
            status, answer = scipd.control.ask("POST", "/sensors/rescue/front/faults", fault)
            assert status < 300, answer
            assert scipd.meals(2 * WATCHDOG_S) >= 3


def feeds_nothing_while_it_is_stuck(program, scenes, folder):
    with start(program, folder, configuration(scenes, "front"), watchdog_s=WATCHDOG_S) as scipd:
        scipd.process.send_signal(signal.SIGSTOP)
        time.sleep(0.1)
        scipd.drain()
        assert scipd.meals(WATCHDOG_S) == 0
        scipd.process.send_signal(signal.SIGCONT)
        assert scipd.meals(2 * WATCHDOG_S) >= 3
        assert "stuck" not in scipd.log(), scipd.log()


def reads_again_what_was_to_be_read_again_while_it_loaded(program, scenes, folder):
    with Manager(program, folder, {**configuration(scenes, "front"), "scene": str(scenes / "depot.sdf")}) as scipd:
        scipd.hear("STATUS")
        scipd.process.send_signal(signal.SIGHUP)
        scipd.ready()
        scipd.hear("RELOADING", RELOADING="1")
        scipd.hear("READY", READY="1")
        assert scipd.process.poll() is None


def serves_where_nobody_reads(program, scenes, folder):
    with start(program, folder, configuration(scenes, "front"), watchdog_s=0.02) as scipd:
        time.sleep(1)
        assert scipd.control.ask("GET", "/health")[0] == 200
        scipd.process.terminate()
        assert scipd.process.wait(PATIENCE_S) == 0


def says_that_it_is_ready_to_whom_that_reads_late(program, scenes, folder):
    document = configuration(scenes, "front", allow=[str(scenes)])
    with Manager(program, folder, document, watchdog_s=WATCHDOG_S) as scipd:
        fill(scipd.folder / "notify")
        scipd.control = Control(json.loads(scipd.process.stdout.readline())["control"])
        # The status of the new world must not take the place of what was not told yet.
        status, answer = scipd.control.ask("PUT", "/scene", {"file": str(scenes / "rescue_maze.sdf")})
        assert status < 300, answer
        time.sleep(WATCHDOG_S)
        scipd.drain()
        assert scipd.hear("READY", READY="1")["STATUS"].startswith("1 sensor in rescue_maze.sdf: ")


def fill(path):
    """Sends until the queue of the socket is full."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as sender:
        sender.setblocking(False)
        try:
            while True:
                sender.sendto(b"X=1", str(path))
        except BlockingIOError:
            pass


def feeds_no_watchdog_of_another(program, scenes, folder):
    with start(program, folder, configuration(scenes, "front"), watchdog_s=WATCHDOG_S, watched_pid="1") as scipd:
        assert scipd.meals(2 * WATCHDOG_S) == 0


def serves_as_always_where_nobody_hears(program, scenes, folder):
    environment = {"NOTIFY_SOCKET": os.path.join(folder, "nobody")}
    with Manager(program, folder, configuration(scenes, "front"), environment=environment) as scipd:
        assert '"ready":true' in scipd.process.stdout.readline()
        scipd.process.terminate()
        assert scipd.process.wait(PATIENCE_S) == 0


def main():
    program, scenes = sys.argv[1], pathlib.Path(sys.argv[2])
    tests = [says_what_it_serves_and_where, names_some_of_many, tells_every_reload_from_its_beginning_to_its_end,
             asks_for_as_much_time_as_the_world_may_take, tells_of_another_world, says_why_it_cannot_start,
             says_what_is_wrong_with_its_configuration, feeds_the_watchdog_whoever_wants_scans,
             feeds_it_while_time_stands_still, feeds_it_beside_a_fault_on_purpose, feeds_nothing_while_it_is_stuck,
             reads_again_what_was_to_be_read_again_while_it_loaded, serves_where_nobody_reads,
             says_that_it_is_ready_to_whom_that_reads_late, feeds_no_watchdog_of_another,
             serves_as_always_where_nobody_hears]

    for test in tests:
        with tempfile.TemporaryDirectory(prefix="scipd-notify-") as folder:
            run_all([test], program, scenes, folder)


if __name__ == "__main__":
    main()
