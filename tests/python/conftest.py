# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What all tests of the package share: a folder that must be empty afterwards, and no process that knows it.
import pathlib
import shutil
import tempfile
import time

import pytest

pytest_plugins = ["scipd.pytest_plugin", "pytester"]

ROOT = pathlib.Path(__file__).resolve().parents[2]
PATIENCE_S = 30


@pytest.fixture
def scenes():
    return ROOT / "scenes"


@pytest.fixture
def room(scenes):
    """Its ranges can be checked by hand: 3 m ahead of the origin, 2 m to the sides."""
    return scenes / "square_room.sdf"


def processes_in(folder):
    """The command lines that name this folder."""
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            command = (process / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            if str(folder) in command and "State:\tZ" not in (process / "status").read_text():
                found.append(f"{process.name}: {command}")
        except OSError:
            pass  # it has ended
    return found


def eventually(condition, what):
    end = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.02)


@pytest.fixture(autouse=True)
def folder_of_daemons(monkeypatch, tmp_path_factory):
    """All daemons have their folders in here. At the end nothing is left of any."""
    tmp_path_factory.getbasetemp()  # pytest's own folders stay where they are
    folder = pathlib.Path(tempfile.mkdtemp(prefix="scipd-py-", dir="/tmp"))
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    monkeypatch.setenv("TMPDIR", str(folder))
    yield folder
    eventually(lambda: not processes_in(folder / "scipd-"), "processes are left")
    left = sorted(path.name for path in folder.glob("scipd-*"))
    shutil.rmtree(folder)
    assert not left, f"folders are left: {left}"
