# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""A thread that hears a WebSocket of a scipd, until scipd ends or close() is called."""

from __future__ import annotations

import threading
import time
from typing import Callable

from .websocket import WebSocket, WebSocketClosed


class Listener:
    """Calls `hear` with each message, on a thread of its own. The socket is open when this is made."""

    def __init__(self, path: str, target: str, hear: Callable[[str], None]) -> None:
        self._socket = WebSocket(path, target)
        self._hear = hear
        self._thread = threading.Thread(target=self._run, name=f"scipd {target}", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            while True:
                self._hear(self._socket.receive())
        except WebSocketClosed:
            pass

    def catch_up(self) -> None:
        """Returns when all that has come is heard."""
        for _ in range(2):  # between coming and being heard a message is nowhere to be seen for a moment
            while self._thread.is_alive() and not self._socket.is_idle:
                time.sleep(0.0002)

    def send(self, text: str) -> None:
        """Raises WebSocketClosed."""
        self._socket.send(text)

    def close(self) -> None:
        self._socket.close()
        if self._thread is not threading.current_thread():
            self._thread.join()
