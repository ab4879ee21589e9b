# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""The test's side of keeper.py: starts it, hears from it, and lets it end scipd. Any thread."""

from __future__ import annotations

import json
import os
import pathlib
import select
import subprocess
import sys
import threading
import time
from typing import Any, Dict, List, Optional

_KEEPER = pathlib.Path(__file__).with_name("keeper.py")
# The keeper itself kills what does not end before this is over.
_END_S = 30.0


class Process:
    """A scipd in a folder of its own. The process that made it alone may end it, not what it has forked."""

    def __init__(self, command: List[str], folder: pathlib.Path, environment: Dict[str, str]) -> None:
        self.folder = folder
        self._owner = os.getpid()
        self._lock = threading.Lock()
        self._unread = b""
        self._said: Dict[str, Any] = {}
        self._last_log: Optional[str] = None
        # A session of its own: what a terminal or a runner does to the group of the tests does not reach it, so it is
        # there to end scipd when they are gone.
        self._keeper = subprocess.Popen(
            [sys.executable or "python3", "-I", "-S", str(_KEEPER), str(folder), *command],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment, start_new_session=True)

    def ready_line(self, patience_s: float) -> Optional[Dict[str, Any]]:
        """None: it has ended, or did not become ready in time."""
        end = time.monotonic() + patience_s
        while True:
            left = end - time.monotonic()
            self._hear(max(left, 0))
            if "ready" in self._said:
                return self._said
            if "ended" in self._said or left <= 0:
                return None

    @property
    def pid(self) -> Optional[int]:
        self._hear(0)
        pid = self._said.get("pid")
        return pid if isinstance(pid, int) else None

    @property
    def exit_code(self) -> Optional[int]:
        """None: it runs. A negative number is that of the signal that ended it."""
        self._hear(0)
        code = self._said.get("ended")
        return code if isinstance(code, int) else None

    def wait(self, patience_s: float) -> Optional[int]:
        """The exit code, or None if it still runs then."""
        end = time.monotonic() + patience_s
        while self.exit_code is None and time.monotonic() < end:
            self._hear(max(0.0, end - time.monotonic()))
        return self.exit_code

    @property
    def log(self) -> str:
        """What it has told on standard error."""
        if self._last_log is not None:
            return self._last_log
        try:
            return (self.folder / "log").read_text(encoding="utf-8", errors="replace")
        except OSError:
            return ""

    def end(self) -> None:
        """Ends it and removes its folder. Its log stays to be read here."""
        if os.getpid() != self._owner or self._keeper.stdin is None or self._keeper.stdin.closed:
            return
        try:
            self._keeper.stdin.write(b"end\n")
            self._keeper.stdin.flush()
            self.wait(_END_S)
        except OSError:
            pass  # the keeper is gone, and scipd with it
        self._last_log = self.log
        self._release()

    def _release(self) -> None:
        keeper = self._keeper
        try:
            if keeper.stdin is not None:
                keeper.stdin.close()
        except OSError:
            pass
        try:
            keeper.wait(_END_S)
        except subprocess.TimeoutExpired:
            keeper.kill()
            keeper.wait()
        if keeper.stdout is not None:
            keeper.stdout.close()

    def _hear(self, patience_s: float) -> None:
        """Takes in what has come, and waits for something that long."""
        with self._lock:
            output = self._keeper.stdout
            if output is None or output.closed or not select.select([output], [], [], patience_s)[0]:
                return
            more = os.read(output.fileno(), 65536)
            if not more:
                # Without its keeper scipd has been killed.
                self._said.setdefault("ended", -9)
            *lines, self._unread = (self._unread + more).split(b"\n")
            for line in lines:
                self._said.update(json.loads(line))
