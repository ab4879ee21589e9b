# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""A line to a scanner, by TCP or by its tty, on which messages end with an empty line. One thread."""

from __future__ import annotations

import os
import select
import socket
import time
import tty
from typing import Callable, Optional, Tuple

from .errors import NoScan

# Has time go on a little: in lockstep nothing comes without.
Meanwhile = Callable[[], None]
# Patience after a step of time in lockstep: all that is due by then has been sent before the step ends.
_AT_ONCE_S = 0.001
_REPLY_S = 1.0


class Line:
    def __init__(self, descriptor: int, name: str) -> None:
        self.name = name
        self._descriptor = descriptor
        self._unread = bytearray()

    @staticmethod
    def tcp(address: Tuple[str, int]) -> "Line":
        connection = socket.create_connection(address, timeout=10)
        connection.setblocking(True)
        return Line(connection.detach(), "tcp")

    @staticmethod
    def tty(path: str) -> "Line":
        descriptor = os.open(path, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(descriptor)
        return Line(descriptor, "tty")

    def __enter__(self) -> "Line":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        os.close(self._descriptor)

    def say(self, request: str) -> None:
        os.write(self._descriptor, request.encode() + b"\n")

    def ask(self, request: str, timeout_s: float, meanwhile: Optional[Meanwhile] = None) -> bytes:
        """The reply to it, without its empty line. Raises NoScan."""
        self.say(request)
        if meanwhile is not None:
            # Most replies come although time stands still. Time that went on before scipd has read the request would
            # make two runs differ.
            select.select([self._descriptor], [], [], _REPLY_S)
        return self.message(request, timeout_s, meanwhile)

    def message(self, echo: str, timeout_s: float, meanwhile: Optional[Meanwhile] = None) -> bytes:
        """The next message that begins with this echo. Others, and what a line has as noise, are passed over."""
        end = time.monotonic() + timeout_s
        while True:
            size = self._unread.find(b"\n\n")
            if size >= 0:
                message = bytes(self._unread[:size])
                del self._unread[:size + 2]
                if message.startswith(echo.encode()):
                    return message
            else:
                self._read(end - time.monotonic(), meanwhile, echo)

    def take_in(self) -> None:
        """Reads what has come: in lockstep, bytes that no client reads hold time up."""
        try:
            while select.select([self._descriptor], [], [], 0)[0]:
                more = os.read(self._descriptor, 65536)
                if not more:
                    return
                self._unread += more
        except OSError:
            pass  # message() reports it

    def _read(self, left_s: float, meanwhile: Optional[Meanwhile], echo: str) -> None:
        wait_s = max(0.0, left_s) if meanwhile is None else _AT_ONCE_S
        if select.select([self._descriptor], [], [], wait_s)[0]:
            try:
                more = os.read(self._descriptor, 65536)
            except OSError as error:
                raise NoScan(f"the {self.name} broke before {echo} was answered: {error.strerror}") from error
            if not more:
                raise NoScan(f"the scanner has closed the {self.name} before it answered {echo}")
            self._unread += more
        elif left_s <= 0:
            raise NoScan(f"the scanner has not answered {echo} by {self.name} in time")
        elif meanwhile is not None:
            meanwhile()
