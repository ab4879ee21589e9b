# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Three daemons and a broker: one world. Ranges are those of the closed form: a wall 10 m ahead, and boxes whose faces
# are a quarter of a metre nearer than they are. fleet_test.py SCIPD
import json
import socket
import sys
import time

from fault_lab import wait_for
from fleet_lab import CRATE, FleetLab, hall

CART = {"body": "cart", "pose": {"xyz": [2, 0, 0.3]}, "poses": "udp:127.0.0.1:0"}


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
    kept = lab.broker.kept("scipd/hall/#")
    assert json.loads(kept["scipd/hall/models/pillar"]) == {"remove": True}, kept
    assert "scipd/hall/models/crate" not in kept, kept
    assert {"scipd/hall/daemons/" + name for name in ("east", "west", "north")} <= kept.keys(), kept


def a_daemon_dies_and_comes_back(lab, east, west):
    east.kill()
    wait_for(lambda: "daemon east is lost" in west.log(), "nobody sees that it died")
    assert west.sees(5.75)  # its robot stays where it was
    kept = lab.broker.kept("scipd/hall/daemons/east")
    assert json.loads(kept["scipd/hall/daemons/east"])["state"] == "lost", kept
    east = lab.start("east", robot=CART)
    wait_for(lambda: west.log().count("daemon east has joined") == 2, "nobody sees that it is back:" + west.log())
    west.wait_to_see(1.75)  # where its robot starts
    assert east.ask("GET", "/scene/models/pillar/pose")[0] == 404
    return east


def a_silent_broker_holds_nobody_up(lab, west):
    lab.broker.process.send_signal(19)
    begun = time.monotonic()
    for _ in range(20):
        assert west.sees(1.75)
    assert time.monotonic() - begun < 10
    lab.broker.process.send_signal(18)


def main(scipd):
    with FleetLab(scipd) as lab:
        east = lab.start("east", robot=CART)
        west = lab.start("west")
        north = lab.start("north", robot={"pose": {"xyz": [-1, 0, 0]}})
        for daemon in (east, west, north):
            assert daemon.ready, daemon.log()
        robots_of_one_are_seen_by_all(lab, east, west, north)
        changes_reach_all(lab, east, west, north)
        late_ones_have_the_same_world(lab)
        another_base_world_does_not_serve(lab)
        a_broker_goes_and_comes_back(lab, east, west, north)
        a_daemon_dies_and_comes_back(lab, east, west)
        a_silent_broker_holds_nobody_up(lab, west)
        for daemon in lab.daemons:
            assert "rror" not in daemon.log().replace("Error code", ""), daemon.log()


main(sys.argv[1])
