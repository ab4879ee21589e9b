# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
The pytest plugin: the fixture `scipd` starts daemons that end with their test. What a failed test leaves to look at is
kept: the log, the conversation with each scanner, and a recording of the last seconds.
"""

from __future__ import annotations

import pathlib
import re
import shutil
from typing import Any, Callable, Generator, List

import pytest

from .daemon import Scipd
from .errors import ScipdEnded

_DAEMONS = pytest.StashKey[List[Scipd]]()
_LOG_LINES = 20


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("scipd")
    group.addoption("--scipd-keep", metavar="DIR", default=None,
                    help="where failed tests keep logs, conversations and recordings of their scipd "
                         "(default: scipd-failed beside the report of --junitxml, else in the root folder)")
    group.addoption("--scipd-last", metavar="SECONDS", type=float, default=5.0,
                    help="how many seconds of scans a failed test keeps; 0: none, and scipd computes only what drivers "
                         "ask for (default: 5)")


@pytest.fixture
def scipd(request: pytest.FixtureRequest) -> Generator[Callable[..., Scipd], None, None]:
    """Starts a scipd for this test: `robot = scipd(world="room.sdf")`. The arguments are those of scipd.Scipd. Call it
    as often as you like: each ends with the test."""
    daemons: List[Scipd] = []
    request.node.stash[_DAEMONS] = daemons
    shutil.rmtree(_kept_folder(request.node), ignore_errors=True)  # of an earlier run
    last_s: float = request.config.getoption("--scipd-last")

    def start(*args: Any, **keywords: Any) -> Scipd:
        daemon = Scipd(*args, **keywords)
        daemons.append(daemon)
        if last_s > 0:
            daemon.keep_last(last_s)
        return daemon

    yield start
    ended: List[ScipdEnded] = []
    for daemon in reversed(daemons):
        try:
            daemon.close()
        except ScipdEnded as error:
            ended.append(error)
    if ended:
        raise ended[0]


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, Any, None]:
    report = (yield).get_result()
    daemons: List[Scipd] = item.stash.get(_DAEMONS, [])
    if not report.failed or not daemons:
        return
    folder = _kept_folder(item)
    for number, daemon in enumerate(daemons, 1):
        place = folder if len(daemons) == 1 else folder / str(number)
        try:
            daemon.save(place)
        except OSError as error:
            report.sections.append(("scipd", f"nothing is kept in {place}: {error}"))
            continue
        log = "\n".join(daemon.log.rstrip().splitlines()[-_LOG_LINES:])
        report.sections.append(("scipd", f"log, wire and last scans are in {place}; the end of the log:\n{log}"))
        item.user_properties.append(("scipd", str(place)))


def _kept_folder(item: pytest.Item) -> pathlib.Path:
    """Of one test, below that of all."""
    config = item.config
    named = config.getoption("--scipd-keep")
    report = getattr(config.option, "xmlpath", None)
    if named:
        root = config.invocation_params.dir / named
    elif report:
        root = (config.invocation_params.dir / report).parent / "scipd-failed"
    else:
        root = config.rootpath / "scipd-failed"
    return pathlib.Path(root / re.sub(r"[^\w.\[\]-]+", "-", item.nodeid)[:200])
