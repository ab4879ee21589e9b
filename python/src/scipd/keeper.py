# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
The process between a test and its scipd: keeper.py FOLDER COMMAND... It runs scipd as its child. It ends it and removes
its folder when the test asks for that, or is gone in whatever way: killed, timed out, or ended without a word. So no
daemon is ever looked for by its name, and none is left behind. It imports nothing of this package.

Standard input is a pipe from the test. "end" ends scipd; when the pipe closes, the folder goes too. Standard output is
that of scipd, the ready line, and two lines of our own: {"pid": N} and {"ended": CODE}.
"""
import ctypes
import json
import os
import select
import shutil
import signal
import sys
import time
from typing import List

# scipd ends within milliseconds. A sanitized one takes longer, and one that hangs is killed then.
PATIENCE_S = 15
PR_SET_PDEATHSIG = 1


def tell(**what: int) -> None:
    """A line for the test, which may be gone."""
    try:
        os.write(1, (json.dumps(what) + "\n").encode())
    except OSError:
        pass


def start(folder: str, command: List[str]) -> int:
    """Runs scipd, which ends with this process. Its log is FOLDER/log."""
    prctl = ctypes.CDLL(None).prctl
    log = os.open(os.path.join(folder, "log"), os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o600)
    nothing = os.open(os.devnull, os.O_RDONLY)
    pid = os.fork()
    if pid != 0:
        os.close(log)
        return pid
    try:
        prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        os.dup2(nothing, 0)
        os.dup2(log, 2)
        os.execv(command[0], command)
    except OSError as error:
        os.write(2, f"{command[0]} cannot be run: {error.strerror}\n".encode())
    finally:
        os._exit(127)


class Child:
    """scipd, while it runs and afterwards."""

    def __init__(self, pid: int) -> None:
        self.pid = pid
        self.ended = False

    def look(self) -> None:
        """Tells the test once when it has ended."""
        if self.ended:
            return
        pid, status = os.waitpid(self.pid, os.WNOHANG)
        if pid == self.pid:
            self.ended = True
            tell(ended=-os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status))

    def end(self) -> None:
        """Asks it to end, and kills it if it does not. It is not reaped before, so its number is nobody else's."""
        self.look()
        if self.ended:
            return
        os.kill(self.pid, signal.SIGTERM)
        end = time.monotonic() + PATIENCE_S
        while not self.ended and time.monotonic() < end:
            time.sleep(0.005)
            self.look()
        if not self.ended:
            os.kill(self.pid, signal.SIGKILL)
            while not self.ended:
                time.sleep(0.005)
                self.look()


def wake_up() -> int:
    """A descriptor that can be read when a child has ended or somebody asks this process to end."""
    reading, writing = os.pipe()
    os.set_blocking(reading, False)
    os.set_blocking(writing, False)
    for number in (signal.SIGCHLD, signal.SIGTERM):
        signal.signal(number, lambda *_: None)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.set_wakeup_fd(writing)
    return reading


def parent_descriptor() -> List[int]:
    """Can be read when the test has ended, though a process that it has forked holds the pipe open."""
    try:
        return [os.pidfd_open(os.getppid())]
    except (AttributeError, OSError):
        return []


def serve(child: Child, woken: int) -> None:
    """Until the test is gone."""
    gone = parent_descriptor()
    while True:
        readable, _, _ = select.select([0, woken, *gone], [], [])
        if woken in readable and signal.SIGTERM in os.read(woken, 64):
            return
        child.look()
        if any(descriptor in readable for descriptor in gone):
            return
        if 0 in readable:
            if not os.read(0, 64):
                return
            child.end()


def main(folder: str, *command: str) -> None:
    woken = wake_up()
    child = Child(start(folder, list(command)))
    tell(pid=child.pid)
    serve(child, woken)
    child.end()
    shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
