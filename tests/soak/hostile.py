# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# The process of the hostile deeds, which it does one after the other and several at once. It also reads scipd's
# standard error. It has a low priority, because on a small machine the measurements would include what it takes.
import os
import random
import signal
import threading
import time

from deeds import DEEDS

LONGEST_SLICE_S = 10.0
TOGETHER = 3  # slices in each round that have several deeds at once
AT_ONCE = 4
STUCK_S = 30.0  # longer than any deed takes to end
CALM_S = 3.0  # before all deeds, so that the good clients can begin


def schedule(names, seconds, seed):
    """Slices of time with the deeds of each. A round has one slice for every deed alone."""
    rng = random.Random(seed)
    together = TOGETHER if len(names) > 1 else 0
    slice_s = min(LONGEST_SLICE_S, seconds / (len(names) + together)) if len(names) > 1 else seconds
    while names:
        yield from (([name], slice_s) for name in rng.sample(names, len(names)))
        yield from ((rng.sample(names, min(AT_ONCE, len(names))), slice_s) for _ in range(together))


class Reader(threading.Thread):
    """Reads standard error while the event `listens` is set."""

    def __init__(self, scipd):
        super().__init__(daemon=True)
        self.scipd = scipd
        self.bytes = self.reloads = 0
        self.tail = b""

    def run(self):
        while self.scipd.listens.wait():
            data = self.scipd.standard_error.read(65536)
            if not data:
                return
            self.bytes += len(data)
            self.reloads += data.count(b"SIGHUP: ")
            self.tail = (self.tail + data)[-1500:]


class Doer(threading.Thread):
    """Does one deed until a time, or until all is over."""

    def __init__(self, scipd, name, rng, until_s, over):
        super().__init__(daemon=True)
        self.scipd, self.name, self.rng, self.until_s, self.over = scipd, name, rng, until_s, over
        self.times = self.bytes = 0
        self.fault = None

    def run(self):
        try:
            while not self.done():
                self.go_on()
        except Exception as error:
            self.fault = f"{self.name}: {error!r}"

    def done(self):
        return time.monotonic() >= self.until_s or self.over.is_set()

    def go_on(self):
        deed = DEEDS[self.name](self.scipd, self.rng)
        try:
            for size in deed:
                if size is not None:
                    self.times += 1
                    self.bytes += size
                if self.done():
                    return
        except OSError:
            time.sleep(0.05)
        finally:
            deed.close()


def do_together(scipd, names, seconds, seed, over):
    doers = [Doer(scipd, name, random.Random(f"{seed} {name}"), time.monotonic() + seconds, over) for name in names]
    for doer in doers:
        doer.start()
    for doer in doers:
        doer.join(seconds + STUCK_S)
    faults = [doer.fault or f"{doer.name} does not end" for doer in doers if doer.fault or doer.is_alive()]
    return {doer.name: (doer.times, doer.bytes) for doer in doers}, faults


def run(scipd, names, seconds, seed, tell, over):
    """Does deeds for this many seconds, or until `over` is set. It sends ("begin", names) at the begin of each slice
    and ("end", {name: (times, bytes)}, faults) at its end, ("over",) at the end of all, and, once scipd has ended,
    ("said", bytes on standard error, reloads, the last of it)."""
    os.nice(10)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    scipd.listens = threading.Event()
    scipd.listens.set()
    reader = Reader(scipd)
    reader.start()
    time.sleep(CALM_S)
    end = time.monotonic() + seconds
    for number, (together, slice_s) in enumerate(schedule(names, seconds, seed)):
        left_s = end - time.monotonic()
        if left_s < 0.1 or over.is_set():
            break
        tell.send(("begin", together))
        tell.send(("end", *do_together(scipd, together, min(slice_s, left_s), f"{seed} {number}", over)))
    over.wait(max(0.0, end - time.monotonic()))
    tell.send(("over",))
    reader.join()
    tell.send(("said", reader.bytes, reader.reloads, reader.tail.decode(errors="replace")))
