# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Mixed hostile load on a running scipd, in which good clients must miss nothing. `tools/soak` builds and starts it.
# `soak.py --help` lists the options. Exit code 0: all checks of report.py hold.
import argparse
import asyncio
import multiprocessing
import os
import pathlib
import socket
import time

import good
import hostile
import report
import scipd as under_load
import wire
from deeds import DEEDS

CALM_S = 3.0  # time after all deeds for their clients to leave
DRAINED_S = 180.0  # most time for scipd to finish work and close idle connections
LEAKED_S = 70.0  # longer than scipd lets a connection idle; if so long none was closed, the rest never is
BOOTED_S = 20.0  # longer than any scanner takes to boot
PATIENCE_S = 60.0
ROOT = pathlib.Path(__file__).resolve().parents[2]


class Soak:
    """Collects the measurements, and which deed disturbed them."""

    def __init__(self, scipd):
        self.scipd = scipd
        self.begin_s = time.monotonic()
        self.machine = good.Machine(scipd)
        self.status = good.StatusClient(scipd, self.machine, self.take_answer)
        self.poses = good.PoseSenders(scipd)
        self.editor = good.Editor(scipd, self.take_edit)
        self.pictures = good.Pictures(scipd, self.machine, *under_load.PICTURES)
        self.streams = [good.Stream(name, *stream, self.take_missing) for name, stream in under_load.STREAMS.items()]
        self.answers = []
        self.edits_s = []
        self.edited_s = []  # when changes of the scene began while no deed was done
        self.sizes = []  # (MB, descriptors, threads), once a second
        self.doings = [(self.begin_s, "none")]  # (since when, deed)
        self.deeds = {}
        self.faults = []

    def deed(self, name):
        return self.deeds.setdefault(name, report.Deed())

    def done_at(self, when_s):
        """The deed at that time: its name, `several`, or `none`."""
        return next(name for since_s, name in reversed(self.doings) if since_s <= max(when_s, self.begin_s))

    def culprit(self, when_s):
        return self.deed(self.done_at(when_s))

    def take_answer(self, answer):
        self.answers.append(answer)
        deed = self.culprit(answer.since_s)
        deed.slowest_s = max(deed.slowest_s, answer.by_scipd_s())

    def take_edit(self, since_s, latency_s):
        self.edits_s.append(latency_s)
        if self.done_at(since_s) == "none":
            self.edited_s.append(since_s)
        deed = self.culprit(since_s)
        deed.slowest_edit_s = max(deed.slowest_edit_s, latency_s)

    def answers_after_edits(self):
        """Answers to /status within a second of a change of the scene, while no deed was done."""
        return [answer for answer in self.answers if self.done_at(answer.since_s) == "none" and
                any(0.0 <= answer.since_s - edit_s < 1.0 for edit_s in self.edited_s)]

    def take_missing(self, scans, since_s):
        self.culprit(since_s).missed += scans

    def take_size(self):
        size = self.scipd.size()
        self.sizes.append(size)
        deed = self.culprit(time.monotonic())
        deed.most_mb = max(deed.most_mb, size[0])

    def take_told(self, what, *told):
        """Handles a message of the hostile process."""
        if what == "begin":
            self.doings.append((time.monotonic(), told[0][0] if len(told[0]) == 1 else "several"))
        elif what == "end":
            self.doings.append((time.monotonic(), "none"))
            for name, (times, size) in told[0].items():
                self.deed(name).times += times
                self.deed(name).bytes += size
            self.faults += told[1]
        return what == "over"

    async def measure(self):
        while self.scipd.exit_code() is None:
            self.take_size()
            await asyncio.sleep(1.0)
        raise RuntimeError(f"scipd has ended by itself, {self.scipd.exit_code()}")

    async def connect_streams(self):
        for stream in self.streams:
            if self.scipd.sensors[stream.name]["tcp"]:
                address = self.scipd.tcp(stream.name)
                await asyncio.get_running_loop().create_connection(lambda stream=stream: stream, *address)
            else:
                good.stream_from_tty(self.scipd.tty(stream.name), stream)

    async def run(self, told):
        """Runs until the hostile process says that it is over, or a good client fails."""
        await self.connect_streams()
        clients = [asyncio.ensure_future(work) for work in (
            self.machine.run(), self.status.run(), self.poses.send(), self.poses.look(), self.editor.run(),
            self.pictures.run(), self.measure())]
        over = asyncio.get_running_loop().create_future()

        def hear():
            if self.take_told(*told.recv()):
                over.set_result(None)

        asyncio.get_running_loop().add_reader(told.fileno(), hear)
        done, _ = await asyncio.wait([over, *clients], return_when=asyncio.FIRST_COMPLETED)
        self.faults += [f"a good client: {task.exception()!r}" for task in done if task is not over]
        asyncio.get_running_loop().remove_reader(told.fileno())
        await asyncio.sleep(CALM_S)
        await self.drain()
        await asyncio.sleep(CALM_S)
        self.end_s = time.monotonic()
        for client in clients:
            client.cancel()
        self.status.take_time()
        self.editor.take_time()

    async def drain(self):
        """Waits until scipd has closed the hostile clients' connections, as long as it goes on to close some."""
        least, begin_s = self.sizes[-1][1], time.monotonic()
        closed_s = begin_s
        while least > self.sizes[0][1] + report.LEFT_DESCRIPTORS:
            await asyncio.sleep(1.0)
            now_s = time.monotonic()
            if self.sizes[-1][1] < least:
                least, closed_s = self.sizes[-1][1], now_s
            if now_s - closed_s > LEAKED_S or now_s - begin_s > DRAINED_S:
                return

    def ask_victims(self):
        """Checks the victims after all deeds. If scipd is gone, their ttys may already belong to another program."""
        if self.scipd.exit_code() is not None:
            return
        self.faults += [fault_of(self.scipd, name) for name, sensor in self.scipd.sensors.items()
                        if name.startswith("victim/") and (sensor["tcp"] or sensor["pty"])]


def fault_of(scipd, name):
    """Why the scanner does not answer, or None if it does. It may have to boot first, or be in time-adjust mode. Asks
    over its tty if it has one."""
    end = time.monotonic() + BOOTED_S
    heard, fault = b"", None
    while b"VV\n00P\n" not in heard and time.monotonic() < end:
        try:
            if scipd.tty(name):
                heard = ask_tty(scipd.tty(name))
            else:
                with socket.create_connection(scipd.tcp(name), 2.0) as client:
                    client.sendall(b"TM2\nQT\nVV\n")
                    time.sleep(0.5)
                    heard = client.recv(65536)
        except OSError as error:
            fault = error
            time.sleep(0.5)
    return None if b"VV\n00P\n" in heard else f"{name} does not answer any more: {heard[:200]!r}, {fault!r}"


def ask_tty(path):
    descriptor = wire.open_tty(path)
    try:
        os.write(descriptor, b"\nTM2\nQT\nVV\n")
        time.sleep(0.5)
        return os.read(descriptor, 65536)
    finally:
        os.close(descriptor)


def options():
    parser = argparse.ArgumentParser(prog="tools/soak",
                                     description="Mixed hostile load on scipd; good clients must miss nothing.")
    parser.add_argument("minutes", nargs="?", type=float, default=60.0, help="how long; default: 60")
    parser.add_argument("--only", default="", metavar="DEED,...",
                        help="do only these deeds, or none: " + ", ".join(DEEDS))
    parser.add_argument("--except", default="", metavar="DEED,...", help="do all deeds but these", dest="without")
    parser.add_argument("--seed", type=int, default=1,
                        help="seed of what the hostile clients choose at random; default: 1")
    parser.add_argument("--status-ms", type=float, default=50.0,
                        help="the longest that an answer to /status may take; default: 50")
    parser.add_argument("--edit-s", type=float, default=15.0,
                        help="the longest that a change of the scene may take; default: 15")
    parser.add_argument("--rss-mb", type=float, default=600.0, help="the most memory at any time; default: 600")
    parser.add_argument("--slow", action="store_true",
                        help="do not judge what only a scipd does that is on time: for one with sanitizers")
    parser.add_argument("--scipd", default=str(ROOT / "build/release/bin/scipd"), help="the program to test")
    said = parser.parse_args()
    without = said.without.split(",") if said.without else []
    only = [] if said.only == "none" else said.only.split(",") if said.only else list(DEEDS)
    for name in only + without:
        if name not in DEEDS:
            parser.error(f"there is no deed {name}; use some of {', '.join(DEEDS)}")
    said.deeds = [name for name in only if name not in without]
    return said


def last_words(soak, told):
    """What the hostile process reports after scipd has ended."""
    while told.poll(PATIENCE_S):
        what, *words = told.recv()
        if what == "said":
            return words
        soak.take_told(what, *words)
    soak.faults.append("the hostile process does not end")
    return 0, 0, ""


def main():
    said = options()
    scipd = under_load.Scipd(said.scipd, ROOT / "scenes", said.seed)
    fork = multiprocessing.get_context("fork")
    told, tell = fork.Pipe(duplex=False)
    over = fork.Event()
    try:
        scipd.wait_until_ready()
        work = (scipd, said.deeds, said.minutes * 60.0, said.seed, tell, over)
        fork.Process(target=hostile.run, args=work, daemon=True).start()
        tell.close()
        soak = Soak(scipd)
        asyncio.run(soak.run(told))
        soak.ask_victims()
    finally:
        over.set()
        exit_code = scipd.end()
    return report.tell(soak, said, exit_code, last_words(soak, told))


if __name__ == "__main__":
    raise SystemExit(main())
