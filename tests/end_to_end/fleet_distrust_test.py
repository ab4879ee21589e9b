# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Whatever anybody says at the broker, daemons start and go on: they tell what they cannot go along with, and how the
# message is taken away, until it is gone. fleet_distrust_test.py SCIPD SCIPCTL
import json
import sys

from fault_lab import wait_for
from fleet_lab import CRATE, FleetLab

OTHER_SCENE = json.dumps({"hash": "0123456789abcdef", "by": "nobody", "begun_s": 1})
FORGED_NOTE = json.dumps({"name": "east", "state": "serving", "instance": "1", "host": "nowhere"})


def trouble(daemon):
    status, answer = daemon.ask("GET", "/status")
    assert status == 200, answer
    return answer["fleet"]["trouble"] or ""


def keep(lab, topic, text):
    lab.broker.say("scipd/hall/" + topic, text, "-r", "-q", "1")


def take_away(lab, daemon, topic):
    """As the daemon's own words say."""
    command = f"mosquitto_pub -h 127.0.0.1 -p {lab.broker.port} -q 1 -r -n -t scipd/hall/{topic}"
    wait_for(lambda: command in trouble(daemon), f"it does not say {command}: {trouble(daemon)}")
    keep(lab, topic, "")
    wait_for(lambda: command not in trouble(daemon), "the trouble stays")


def models(lab):
    # The scene note is this world's: a daemon has been there, and the messages came afterwards.
    first = lab.start("first")
    assert first.ready, first.log()
    assert first.end() == 0
    keep(lab, "models/away", json.dumps({"name": "away", "file": "/etc/secret.sdf"}))
    keep(lab, "models/broken", '{"name":')
    keep(lab, "models/pillar", "nonsense")
    keep(lab, "models/crate", json.dumps({"name": "crate", "sdf": CRATE, "pose": {"xyz": [3, 0, 0.3]}}))
    east = lab.start("east")
    assert east.ready, east.log()
    assert east.sees(2.75), east.ahead_m()  # what makes sense is there
    assert "scipd/hall/models/broken: " in trouble(east) and "(and others)" in trouble(east), trouble(east)
    assert json.loads(lab.broker.kept("scipd/hall/daemons/east")["scipd/hall/daemons/east"])["trouble"]
    for model in ("broken", "away", "pillar"):
        take_away(lab, east, "models/" + model)
    assert trouble(east) == ""
    assert east.ask("GET", "/scene/models/pillar/pose")[0] == 200  # it stands as it did
    keep(lab, "models/away", '{"name":')  # while it runs
    take_away(lab, east, "models/away")
    assert "mosquitto_pub" in east.log()
    assert east.end() == 0


def a_note_of_nobody(lab):
    keep(lab, "daemons/east", FORGED_NOTE)
    east = lab.start("east")
    assert east.ready, east.log()
    assert "scipd/hall/daemons/east: the broker kept a note" in east.log(), east.log()
    keep(lab, "daemons/east", FORGED_NOTE)
    take_away(lab, east, "daemons/east")
    told = lab.broker.kept("scipd/hall/daemons/east")["scipd/hall/daemons/east"]
    assert json.loads(told)["instance"] != "1", told  # it has said again who it is
    # A note that makes another world seem to be served.
    assert east.end() == 0
    keep(lab, "scene", OTHER_SCENE)
    keep(lab, "daemons/ghost", FORGED_NOTE.replace("east", "ghost"))
    east = lab.start("east")
    assert east.ready, east.log()
    return east


def another_scene(lab, east):
    keep(lab, "scene", OTHER_SCENE)
    wait_for(lambda: "its content is 0123456789abcdef" in trouble(east), "it believes in the other scene")
    assert east.sees(10), east.ahead_m()
    refused = lab.start("west")
    assert refused.ready is None and refused.end() == 2
    assert "the world hall of the broker is another one" in refused.log(), refused.log()
    assert "-r -n -t scipd/hall/scene" in refused.log(), refused.log()
    take_away(lab, east, "scene")
    west = lab.start("west")
    assert west.ready, west.log()
    # They are in step again.
    assert west.ask("POST", "/scene/models", {"name": "crate", "sdf": CRATE, "pose": {"xyz": [2, 0, 0.3]}})[0] == 201
    east.wait_to_see(1.75)
    # While the broker is away, somebody else takes its world.
    lab.broker.kill()
    wait_for(lambda: "is lost" in east.log() and "is lost" in west.log(), "the loss is not told")
    lab.broker.start()
    wait_for(lambda: "is back" in east.log() and "is back" in west.log(), "the broker is not found again")
    assert trouble(east) == trouble(west) == ""
    assert west.end() == 0
    assert east.end() == 0


def main(scipd, _scipctl):
    with FleetLab(scipd) as lab:
        models(lab)
        east = a_note_of_nobody(lab)
        another_scene(lab, east)


main(*sys.argv[1:])
