# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# The world changes while scanners look at it.
import math

import pytest

from scipd import Refused, Scipd

# A square of 2 m that stands upright, whose material is in a file of its own.
WALL = "mtllib wall.mtl\nusemtl wood\nv 0 -1 0\nv 0 1 0\nv 0 1 2\nv 0 -1 2\nf 1 2 3 4\n"


@pytest.fixture
def daemon(scipd, room):
    return scipd(world=room, accuracy="ideal")


def test_a_box_stands_on_its_pose(daemon):
    assert daemon.scene.add("crate", box=(0.4, 0.6, 0.5), pose=(2, 0, 0), material="wood") == []
    ahead = daemon.truth().at(0)
    assert (ahead.object, ahead.material) == ("crate::body::box", "wood")
    assert ahead.range_m == pytest.approx(1.8)
    assert daemon.scan().at(0) == 1.8
    daemon.scene.move("crate", (1.5, 0, math.pi / 2))
    assert daemon.scan().at(0) == 1.2
    assert daemon.scene.pose("crate").yaw == pytest.approx(math.pi / 2)
    daemon.scene.remove("crate")
    assert daemon.scan().at(0) == 3.0
    assert "crate" not in daemon.scene.models


def test_a_mesh_may_lie_anywhere(daemon, tmp_path):
    (tmp_path / "wall.obj").write_text(WALL.split("\n", 2)[2])
    daemon.scene.add("wall", mesh=tmp_path / "wall.obj", pose=(1, 0, 0), scale=0.5, material="glass")
    assert daemon.truth().at(0).material == "glass"
    assert daemon.scan().at(0) == 1.0


def test_models_and_files_are_added(daemon, scenes):
    daemon.scene.add("carton", file=scenes / "models" / "carton", pose=(2, 0, 0))
    assert daemon.truth().at(0).object.startswith("carton::")
    daemon.scene.load(scenes / "corridor.sdf")
    assert "carton" not in daemon.scene.models


def test_what_is_wrong_is_told(daemon):
    with pytest.raises(TypeError, match="one of box=, mesh=, sdf= and file="):
        daemon.scene.add("nothing")
    with pytest.raises(ValueError, match="three lengths"):
        daemon.scene.add("flat", box=(1, 1, 0))
    with pytest.raises(Refused, match="409"):
        daemon.scene.add("room", box=(1, 1, 1))
    with pytest.raises(Refused) as refused:
        daemon.scene.remove("ghost")
    assert refused.value.status == 404


def test_in_lockstep_models_move_at_once_too(room):
    with Scipd(world=room, accuracy="ideal", clock="poses") as daemon:
        daemon.scene.move("box", (2, 0, 0))
        assert daemon.truth().at(0).range_m == pytest.approx(1.7)
