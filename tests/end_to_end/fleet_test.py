# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Three daemons and a broker: one world. Ranges are those of the closed form: a wall 10 m ahead, and boxes whose faces
# are a quarter of a metre nearer than they are. fleet_test.py SCIPD SCIPCTL
import concurrent.futures
import json
import signal
import socket
import subprocess
import sys
import time

from fault_lab import wait_for
from fleet_lab import CRATE, FakeBroker, FleetLab, hall

CART = {"body": "cart", "pose": {"xyz": [2, 0, 0.3]}, "poses": {"from": "udp:127.0.0.1:0", "after": "hold"}}


def crate_at(x_m):
    return {"name": "crate", "sdf": CRATE, "pose": {"xyz": [x_m, 0, 0.3]}}


def send_pose(daemon, xyz):
    host, port = daemon.ready["poses"][daemon.name].removeprefix("udp:").rsplit(":", 1)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        sender.sendto(json.dumps({"xyz": xyz}).encode(), (host, int(port)))


def robots_of_one_are_seen_by_all(lab, east, west, north):
    assert east.sees(10 - 2), east.ahead_m()  # its own body is no obstacle
    west.wait_to_see(1.75)
    north.wait_to_see(2.75)
    send_pose(east, [4, 0, 0.3])
    west.wait_to_see(3.75)
    north.wait_to_see(4.75)
    east.wait_to_see(6)
    # By way of the broker it is the robot itself that moves, wherever it is.
    lab.broker.say("scipd/hall/poses", '{"robot":"east","xyz":[5,0,0.3]}\n{"robot":"north","xyz":[-2,0,0]}\n')
    west.wait_to_see(4.75)
    north.wait_to_see(6.75)
    assert east.pose("/robots/east") == [5, 0, 0.3]
    lab.broker.say("scipd/hall/poses", "damaged\n{\"xyz\":[1,1,1]}\n\xff\n{\"robot\":\"nobody\",\"xyz\":[1,1,1]}\n")
    lab.broker.say("scipd/hall/poses", '{"robot":"north","xyz":[-1,0,0]}\n')
    north.wait_to_see(5.75)
    assert west.pose("/robots/west") == [0, 0, 0]


def changes_reach_all(lab, east, west, north):
    status, answer = west.ask("POST", "/scene/models", crate_at(3))
    assert status == 201, answer
    assert west.sees(2.75)
    north.wait_to_see(3.75)
    assert west.ask("POST", "/scene/models", crate_at(3))[0] == 409
    assert west.ask("POST", "/scene/models", {"name": "bad", "sdf": "<model"})[0] == 400
    assert "scipd/hall/models/bad" not in lab.broker.kept("scipd/hall/#")
    assert north.ask("POST", "/scene/models", {**crate_at(2), "replace": True})[0] == 201
    west.wait_to_see(1.75)
    north.wait_to_see(2.75)
    assert north.ask("PUT", "/scene/models/crate/pose", {"xyz": [1, 0, 0.3]})[0] == 204
    west.wait_to_see(0.75)
    assert east.ask("DELETE", "/scene/models/pillar")[0] == 204
    for daemon in (west, north):
        wait_for(lambda d=daemon: d.ask("GET", "/scene/models/pillar/pose")[0] == 404, "the pillar stays")
    assert west.ask("PUT", "/scene", {"file": "hall.sdf"})[0] == 403
    # Somebody without a daemon adds, and takes away.
    lab.broker.say("scipd/hall/models/post", json.dumps({**crate_at(0.5), "name": "post"}), "-r", "-q", "1")
    west.wait_to_see(0.25)
    lab.broker.say("scipd/hall/models/post", "", "-r", "-q", "1")
    west.wait_to_see(0.75)


def a_reload_keeps_what_is_shared(lab, west):
    west.process.send_signal(signal.SIGHUP)
    wait_for(lambda: "is running now" in west.log(), "it is not loaded again")
    west.wait_to_see(0.75)
    assert west.ask("GET", "/scene/models/pillar/pose")[0] == 404
    (lab.folder / "hall.sdf").write_text(hall("<model name='m'><link name='l'/></model>"))
    west.process.send_signal(signal.SIGHUP)
    wait_for(lambda: "nothing was changed" in west.log(), "another base world is taken")
    assert "the world hall of the broker is another one" in west.log(), west.log()
    (lab.folder / "hall.sdf").write_text(hall())
    assert west.sees(0.75)


def late_ones_have_the_same_world(lab):
    wait_for(lambda: '"xyz":[5,0,0.3]' in lab.broker.kept("scipd/hall/places/#").get("scipd/hall/places/east", ""),
             "where the cart is is not kept")
    late = lab.start("late")
    assert late.sees(0.75), late.ahead_m()
    assert late.pose("/scene/models/cart") == [5, 0, 0.3]
    assert late.ask("GET", "/scene/models/pillar/pose")[0] == 404
    assert late.end() == 0
    wait_for(lambda: "scipd/hall/daemons/late" not in lab.broker.kept("scipd/hall/daemons/#"), "it stays in the list")


def another_base_world_does_not_serve(lab):
    (lab.folder / "other.sdf").write_text(hall("<model name='m'><link name='l'/></model>"))
    other = lab.start("other", scene="other.sdf")
    assert other.ready is None and other.end() == 2
    assert "the world hall of the broker is another one" in other.log(), other.log()
    same_name = lab.start("east")
    assert same_name.ready is None and same_name.end() == 2
    assert "there is a daemon east" in same_name.log(), same_name.log()
    # In another world of the same broker it is alone.
    alone = lab.start("other", scene="other.sdf", world="other")
    assert alone.sees(10)
    assert alone.end() == 0


def a_broker_goes_and_comes_back(lab, east, west, north):
    lab.broker.kill()
    for daemon in (east, west, north):
        wait_for(lambda d=daemon: "is lost" in d.log(), "the loss is not told")
    assert west.sees(0.75)  # all stays where it was
    status, answer = west.ask("POST", "/scene/models", crate_at(9))
    assert status == 503 and "try again" in answer["detail"], answer
    send_pose(east, [6, 0, 0.3])
    east.wait_to_see(4)
    lab.broker.start()
    for daemon in (east, west, north):
        wait_for(lambda d=daemon: "is back" in d.log(), "the broker is not found again: " + daemon.log())
    wait_for(lambda: west.pose("/scene/models/cart") == [6, 0, 0.3], "where the cart went meanwhile is not told")
    assert west.ask("DELETE", "/scene/models/crate")[0] == 204
    west.wait_to_see(5.75)
    north.wait_to_see(6.75)
    # The broker had forgotten all, and knows it again.
    names = {"scipd/hall/daemons/" + name for name in ("east", "west", "north")}
    wait_for(lambda: names <= lab.broker.kept("scipd/hall/daemons/#").keys(), "not all say that they are there")
    kept = lab.broker.kept("scipd/hall/#")
    assert json.loads(kept["scipd/hall/models/pillar"]) == {"remove": True}, kept
    assert "scipd/hall/models/crate" not in kept, kept


def a_daemon_dies_and_comes_back(lab, east, west):
    joined = west.log().count("daemon east has joined")  # where east was there first, none
    east.kill()
    wait_for(lambda: "daemon east is lost" in west.log(), "nobody sees that it died")
    assert west.sees(5.75)  # its robot stays where it was
    kept = lab.broker.kept("scipd/hall/daemons/east")
    assert json.loads(kept["scipd/hall/daemons/east"])["state"] == "lost", kept
    east = lab.start("east", robot=CART)
    wait_for(lambda: west.log().count("daemon east has joined") > joined, "nobody sees that it is back:" + west.log())
    west.wait_to_see(1.75)  # where its robot starts
    assert east.ask("GET", "/scene/models/pillar/pose")[0] == 404
    return east


def a_silent_broker_holds_nobody_up(lab, west):
    lab.broker.process.send_signal(signal.SIGSTOP)
    begun = time.monotonic()
    for _ in range(20):
        assert west.sees(1.75)
    assert time.monotonic() - begun < 10
    lab.broker.process.send_signal(signal.SIGCONT)


def scipctl_speaks_to_all(lab, scipctl, west, north):
    def fleet(*words, text="", to=("--to", lab.broker.url + "/hall")):
        return subprocess.run([scipctl, *words, *to], input=text, capture_output=True, text=True, timeout=60,
                              check=False)

    told = fleet("fleet", "status")
    assert told.returncode == 0 and "east (cart)" in told.stdout and "pillar  removed" in told.stdout, told
    west.wait_to_see(1.75)
    assert fleet("fleet", "add", "crate", "-", "--pose", "1,0,0.3,0,0,0", text=CRATE).returncode == 0
    west.wait_to_see(0.75)
    assert "--replace it" in fleet("fleet", "add", "crate", "-", text=CRATE).stderr
    # The broker is that of a daemon, if none is named.
    by_daemon = ("--control", west.ready["control"])
    assert fleet("fleet", "move", "crate", "1.5,0,0.3,0,0,0", to=by_daemon).returncode == 0
    west.wait_to_see(1.25)
    north.wait_to_see(2.25)
    late = lab.start("late")
    assert late.sees(1.25), late.ahead_m()
    late.end()
    assert fleet("fleet", "remove", "crate").returncode == 0
    west.wait_to_see(1.75)
    lines = "".join(f'{{"robot":"east","t":{i / 100},"xyz":[{2 + i / 100},0,0.3]}}\n' for i in range(101))
    assert fleet("pose", "stream", text=lines).returncode == 0
    west.wait_to_see(2.75)
    refused = fleet("pose", "stream", text='{"xyz":[1,2,3]}\n')
    assert refused.returncode != 0 and "line 1: robot is missing" in refused.stderr, refused
    assert "is serving" in fleet("fleet", "forget", "west").stderr
    missing = fleet("fleet", "status", to=("--to", f"mqtt://127.0.0.1:{lab.broker.port + 1}/hall"))
    assert missing.returncode != 0 and "mqtt://127.0.0.1" in missing.stderr, missing


def a_vehicle_is_a_robot(lab, west):
    state = {"timestamp": "2025-01-31T12:00:00Z", "velocity": {"vx": 0}, "errors": [],
             "agvPosition": {"x": 7, "y": 0, "theta": 0, "mapId": "hall", "positionInitialized": True}}
    tug = lab.start("tug", robot={"body": "cart", "poses": "vda5050:ACME", "pose": {"xyz": [6, 0, 0.3]}})
    west.wait_to_see(5.75)
    lab.broker.say("uagv/v2/ACME/tug/state", json.dumps(state))
    west.wait_to_see(6.75)
    assert tug.pose("/robots/tug") == [7, 0, 0.3]
    state["agvPosition"] |= {"x": 3, "positionInitialized": False}
    lab.broker.say("uagv/v2/ACME/tug/state", json.dumps(state))
    wait_for(lambda: "does not know where it is" in tug.log(), "a lost vehicle is not told")
    assert west.sees(6.75)
    assert tug.end() == 0


def what_is_far_is_left_out(lab, west):
    near = lab.start("near", near_m=3)
    for x_m in (2, 50, 60, 70):
        lab.broker.say("scipd/hall/poses", json.dumps({"model": "cart", "xyz": [x_m, 0, 0.3]}))
        wait_for(lambda x_m=x_m: west.pose("/scene/models/cart")[0] == x_m, "the cart does not come")
    wait_for(lambda: near.pose("/scene/models/cart")[0] == 50, "the cart does not leave")
    assert near.ask("PUT", "/robots/near/pose", {"xyz": [68, 0, 0]})[0] == 204
    wait_for(lambda: near.pose("/scene/models/cart")[0] == 70, "the cart is not where the robot comes")
    assert near.end() == 0


def without_a_broker_it_may_do_better_later(scipd):
    accepted = b"\x20\x02\x00\x00"
    unavailable, forbidden = b"\x20\x02\x00\x03", b"\x20\x02\x00\x05"
    with FleetLab(scipd) as lab, FakeBroker(accepted, times=1) as dies, FakeBroker(unavailable) as busy, \
            FakeBroker(forbidden) as strict, FakeBroker(b"", hangs_up=False) as silent:
        lab.broker.kill()
        cases = [(lab.broker.url, 1, "start the broker first"), (dies.url, 1, "cannot join"),
                 (busy.url, 1, "unavailable"), (strict.url, 2, "not authorised"), (silent.url, 1, "not answer")]
        with concurrent.futures.ThreadPoolExecutor(len(cases)) as pool:
            started = list(pool.map(lambda i: lab.start(f"early{i}", url=cases[i][0]), range(len(cases))))
        for daemon, (url, code, why) in zip(started, cases):
            assert daemon.ready is None and daemon.end() == code, (code, daemon.log())
            assert f"cannot join the world hall by the broker {url}" in daemon.log(), daemon.log()
            assert why in daemon.log(), (why, daemon.log())


def main(scipd, scipctl):
    without_a_broker_it_may_do_better_later(scipd)
    with FleetLab(scipd) as lab:
        east = lab.start("east", robot=CART)
        west = lab.start("west")
        north = lab.start("north", robot={"pose": {"xyz": [-1, 0, 0]}})
        for daemon in (east, west, north):
            assert daemon.ready, daemon.log()
        robots_of_one_are_seen_by_all(lab, east, west, north)
        changes_reach_all(lab, east, west, north)
        a_reload_keeps_what_is_shared(lab, west)
        late_ones_have_the_same_world(lab)
        another_base_world_does_not_serve(lab)
        a_broker_goes_and_comes_back(lab, east, west, north)
        east = a_daemon_dies_and_comes_back(lab, east, west)
        a_silent_broker_holds_nobody_up(lab, west)
        scipctl_speaks_to_all(lab, scipctl, west, north)
        assert east.end() == 0
        a_vehicle_is_a_robot(lab, west)
        what_is_far_is_left_out(lab, west)
        for daemon in lab.daemons:
            assert daemon is west or " error " not in daemon.log(), daemon.log()


main(*sys.argv[1:])
