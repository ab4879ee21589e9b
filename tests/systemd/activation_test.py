# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# scipd on sockets that systemd has opened: activation_test.py SCIPD SCENES
import http.client
import json
import pathlib
import signal
import socket
import sys
import tempfile
import time

from manager import PATIENCE_S, Manager, run_all
from fault_lab import Client


def listener(family=socket.AF_INET, where=("127.0.0.1", 0)):
    held = socket.socket(family, socket.SOCK_STREAM)
    held.bind(where)
    held.listen(64)
    return held


def text_of(held):
    return "{}:{}".format(*held.getsockname()[:2])


class Sockets:
    """What a socket unit holds: two scanners, the control socket and the control API."""

    def __init__(self, folder):
        self.path = f"{folder}/control.sock"
        self.front, self.rear, self.http = listener(), listener(), listener()
        self.control = listener(socket.AF_UNIX, self.path)

    def named(self):
        return [("scipd@demo.socket", held) for held in (self.front, self.rear, self.control, self.http)]

    def configuration(self, scenes, *sensors):
        held = {"front": self.front, "rear": self.rear}
        return {"scene": str(scenes / "square_room.sdf"), "http": text_of(self.http),
                "robots": {"rescue": {"sensors": {name: {"model": "UST-10LX", "tcp": text_of(held[name])}
                                                  for name in sensors}}}}


def answers(client, text=b"PROD:"):
    return text in client.read_until(b"\n\n")


def health(client):
    """Of a client that has asked already."""
    response = http.client.HTTPResponse(client)
    response.begin()
    return response.status, json.loads(response.read())


def ask_for_health(client):
    client.settimeout(PATIENCE_S)
    client.sendall(b"GET /health HTTP/1.1\r\nHost: %b\r\n\r\n" % (
        b"scipd" if client.family == socket.AF_UNIX else "{}:{}".format(*client.getpeername()).encode()))


def answers_who_came_before_it_started(program, scenes, folder):
    sockets = Sockets(folder)
    driver = Client(sockets.front.getsockname())
    driver.say("VV")
    local = socket.socket(socket.AF_UNIX)
    local.connect(sockets.path)
    browser = socket.create_connection(sockets.http.getsockname())
    for client in (local, browser):
        ask_for_health(client)
    with Manager(program, folder, sockets.configuration(scenes, "front", "rear"), sockets=sockets.named()) as scipd:
        line = scipd.ready()
        assert [s["tcp"] for s in line["sensors"]] == [text_of(sockets.front), text_of(sockets.rear)], line
        assert line["control"] == sockets.path and line["http"] == text_of(sockets.http), line
        assert answers(driver)
        for client in (local, browser):
            assert health(client) == (200, {"ready": True, "alive": True}), client
        assert scipd.control.ask("GET", "/status")[0] == 200
    assert "systemd" not in scipd.log(), scipd.log()
    # They are systemd's: the next client has scipd started again.
    assert pathlib.Path(sockets.path).is_socket()
    late = Client(sockets.front.getsockname())
    late.say("VV")
    with Manager(program, tempfile.mkdtemp(dir=folder), sockets.configuration(scenes, "front"),
                 environment={"RUNTIME_DIRECTORY": folder}, sockets=sockets.named()) as scipd:
        scipd.ready()
        assert answers(late)


def keeps_them_over_a_reload(program, scenes, folder):
    sockets = Sockets(folder)
    with Manager(program, folder, sockets.configuration(scenes, "front", "rear"), sockets=sockets.named()) as scipd:
        scipd.ready()
        driver = Client(sockets.front.getsockname())
        assert driver.ask("VV")
        scipd.configure(sockets.configuration(scenes, "front"))
        assert scipd.reload().startswith("1 sensor ")
        scipd.wait_for_log(f"systemd hands over a socket on {text_of(sockets.rear)}")
        assert driver.ask("VV")
        waiting = Client(sockets.rear.getsockname())
        waiting.say("VV")
        scipd.configure(sockets.configuration(scenes, "rear"))
        assert scipd.reload().startswith("1 sensor ")
        assert answers(waiting)


def warns_of_what_fits_nothing(program, scenes, folder):
    sockets = Sockets(folder)
    stray, datagrams = listener(), socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    datagrams.bind(("127.0.0.1", 0))
    named = sockets.named() + [("stray\n", stray), ("poses", datagrams)]
    with Manager(program, folder, sockets.configuration(scenes, "front", "rear"), sockets=named) as scipd:
        scipd.ready()
        scipd.process.terminate()
        assert scipd.process.wait(PATIENCE_S) == 0
        warnings = [line for line in scipd.log().splitlines() if "systemd hands over" in line]
        assert len(warnings) == 2, warnings
        assert f"a socket on {text_of(stray)} ('stray?')" in warnings[0], warnings
        assert "descriptor 8 ('poses'), which is no listening" in warnings[1], warnings


def takes_none_that_are_for_another(program, scenes, folder):
    sockets = Sockets(folder)
    with Manager(program, folder, sockets.configuration(scenes, "front"), sockets=sockets.named(),
                 listen_pid="1") as scipd:
        assert scipd.process.wait(PATIENCE_S) == 2
        assert f"cannot listen on {text_of(sockets.http)}: Address already in use" in scipd.log(), scipd.log()


def tells_of_what_is_in_its_way(program, scenes, folder):
    """A socket on all addresses of both kinds, such as a bare ListenStream=10940 makes."""
    sockets = Sockets(folder)
    wide = socket.create_server(("::", 0), family=socket.AF_INET6, dualstack_ipv6=True)
    port = wide.getsockname()[1]
    document = sockets.configuration(scenes, "front")
    document["robots"]["rescue"]["sensors"]["front"]["tcp"] = f"0.0.0.0:{port}"
    with Manager(program, folder, document, sockets=sockets.named() + [("wide", wide)]) as scipd:
        assert scipd.process.wait(PATIENCE_S) == 2
        assert f"systemd hands over a socket on [::]:{port}" in scipd.log(), scipd.log()
        assert f"cannot listen on 0.0.0.0:{port}" in scipd.log(), scipd.log()


def refuses_what_makes_no_sense(program, scenes, folder):
    sockets = Sockets(folder)
    with Manager(program, folder, sockets.configuration(scenes, "front"), sockets=sockets.named(),
                 environment={"LISTEN_FDNAMES": "one"}) as scipd:
        assert scipd.process.wait(PATIENCE_S) == 2
        assert "cannot take the sockets of systemd" in scipd.log(), scipd.log()


def refuses_clients_as_a_fault_asks(program, scenes, folder):
    """The socket goes on listening, as systemd holds it."""
    sockets = Sockets(folder)
    with Manager(program, folder, sockets.configuration(scenes, "front", "rear"), sockets=sockets.named()) as scipd:
        scipd.ready()
        faults = "/sensors/rescue/front/faults"
        status, fault = scipd.control.ask("POST", faults, {"kind": "cut", "how": "refuse", "for": {"s": 1000}})
        assert status < 300, fault
        for _ in range(3):
            try:
                client = Client(sockets.front.getsockname())
                client.say("VV")
                assert client.read() == b""
            except (ConnectionResetError, BrokenPipeError):
                pass
        assert scipd.control.ask("DELETE", f"{faults}/{fault['id']}")[0] < 300
        client = Client(sockets.front.getsockname())
        assert client.ask("VV")


def starts_after_a_kill(program, scenes, folder):
    sockets = Sockets(folder)
    document = sockets.configuration(scenes, "front")
    document["robots"]["rescue"]["sensors"]["front"]["pty"] = "auto"
    for attempt in range(2):
        life = tempfile.mkdtemp(dir=folder)
        with Manager(program, life, document, environment={"RUNTIME_DIRECTORY": folder},
                     sockets=sockets.named()) as scipd:
            sensor = scipd.ready()["sensors"][0]
            assert sensor["pty"] == f"{folder}/rescue-front", sensor
            assert Client(sockets.front.getsockname()).ask("VV")
            scipd.process.send_signal(signal.SIGKILL)
            scipd.process.wait()
            time.sleep(0.1)


def main():
    program, scenes = sys.argv[1], pathlib.Path(sys.argv[2])
    tests = [answers_who_came_before_it_started, keeps_them_over_a_reload, warns_of_what_fits_nothing,
             takes_none_that_are_for_another, tells_of_what_is_in_its_way, refuses_what_makes_no_sense,
             refuses_clients_as_a_fault_asks, starts_after_a_kill]
    for test in tests:
        with tempfile.TemporaryDirectory(prefix="scipd-activation-") as folder:
            run_all([test], program, scenes, folder)


if __name__ == "__main__":
    main()
