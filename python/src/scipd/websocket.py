# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""A client of the WebSockets of the control API: RFC 6455 as far as they need it. One thread reads, any may send."""

from __future__ import annotations

import base64
import os
import select
import socket
import struct
import threading
from typing import Optional, Tuple

from .control import connect

_TEXT, _BINARY, _CLOSE, _PING, _PONG = 1, 2, 8, 9, 10
_LAST = 0x80
_MASKED = 0x80
_CONNECT_S = 60.0


class WebSocketClosed(Exception):
    """The other side has ended it, or close() was called."""


class WebSocket:
    def __init__(self, path: str, target: str) -> None:
        """`path`: a Unix socket. Raises OSError, or WebSocketClosed where scipd refuses it."""
        self._socket = connect(path, _CONNECT_S)
        self._sending = threading.Lock()
        self._unread = b""
        self._waits = False
        try:
            self._shake_hands(target)
        except BaseException:
            self._socket.close()
            raise
        self._socket.settimeout(None)

    @property
    def is_idle(self) -> bool:
        """Whether whoever reads waits for something that has not come."""
        try:
            return self._waits and not select.select([self._socket], [], [], 0)[0]
        except (OSError, ValueError):  # closed
            return True

    def send(self, text: str) -> None:
        self._send(_TEXT, text.encode())

    def receive(self, patience_s: Optional[float] = None) -> str:
        """The next message. Raises TimeoutError, and WebSocketClosed at the end."""
        message = b""
        try:
            self._socket.settimeout(patience_s)
        except OSError as error:  # closed by another thread
            raise WebSocketClosed(str(error)) from error
        while True:
            first, data = self._frame()
            code = first & 0x0F
            if code == _PING:
                self._send(_PONG, data)
            elif code == _CLOSE:
                raise WebSocketClosed(data[2:].decode(errors="replace"))
            elif code != _PONG:
                message += data
                if first & _LAST:
                    return message.decode()

    def close(self) -> None:
        """Another thread that reads gets WebSocketClosed."""
        try:
            self._socket.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass
        self._socket.close()

    def _shake_hands(self, target: str) -> None:
        key = base64.b64encode(os.urandom(16)).decode()
        self._socket.sendall((f"GET {target} HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\n"
                              f"Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n"
                              ).encode())
        # Whether the answer belongs to the key matters to those who may have a cache in between.
        while b"\r\n\r\n" not in self._unread:
            self._read_more()
        header, self._unread = self._unread.split(b"\r\n\r\n", 1)
        if header.split(b" ")[1:2] != [b"101"]:
            raise WebSocketClosed(f"{target} is no WebSocket: {header.splitlines()[0].decode(errors='replace')}")

    def _send(self, code: int, data: bytes) -> None:
        size = len(data)
        length = (struct.pack("!B", _MASKED | size) if size < 126 else
                  struct.pack("!BH", _MASKED | 126, size) if size < 65536 else
                  struct.pack("!BQ", _MASKED | 127, size))
        # A mask of zeros is one, and leaves the data as it is: there is no proxy to protect.
        with self._sending:
            try:
                self._socket.sendall(bytes([_LAST | code]) + length + bytes(4) + data)
            except OSError as error:
                raise WebSocketClosed(str(error)) from error

    def _frame(self) -> Tuple[int, bytes]:
        # All of a frame is there before any of it is taken, so that one may give up waiting in between.
        first, size = self._peek(2)
        begin = 2
        if size == 126:
            begin, size = 4, struct.unpack("!H", self._peek(4)[2:])[0]
        elif size == 127:
            begin, size = 10, struct.unpack("!Q", self._peek(10)[2:])[0]
        frame = self._peek(begin + size)
        self._unread = self._unread[begin + size:]
        return first, frame[begin:]

    def _peek(self, size: int) -> bytes:
        while len(self._unread) < size:
            self._read_more()
        return self._unread[:size]

    def _read_more(self) -> None:
        try:
            self._waits = True
            more = self._socket.recv(1 << 18)
        except socket.timeout as error:  # no TimeoutError before Python 3.10
            raise TimeoutError from error
        except OSError as error:
            raise WebSocketClosed(str(error)) from error
        finally:
            self._waits = False
        if not more:
            raise WebSocketClosed("the connection has ended")
        self._unread += more
