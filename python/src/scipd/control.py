# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""The control API of a scipd, over its Unix socket. One request a connection; any thread."""

from __future__ import annotations

import http.client
import json
import socket
import urllib.parse
from typing import Any, Callable

from .errors import Refused, ScipdError

PATIENCE_S = 60.0


class _UnixConnection(http.client.HTTPConnection):
    def __init__(self, path: str) -> None:
        super().__init__("localhost", timeout=PATIENCE_S)
        self._path = path

    def connect(self) -> None:
        self.sock = connect(self._path, PATIENCE_S)


def connect(path: str, patience_s: float) -> socket.socket:
    """A connection to a Unix socket."""
    connection = socket.socket(socket.AF_UNIX)
    connection.settimeout(patience_s)
    try:
        connection.connect(path)
    except BaseException:
        connection.close()
        raise
    return connection


def quoted(name: str) -> str:
    """A name as a part of a path: `robot/scanner` stays two parts."""
    return urllib.parse.quote(name)


class Control:
    def __init__(self, path: str, why_gone: Callable[[], ScipdError]) -> None:
        self.path = path
        self.why_gone = why_gone  # what to raise where nobody answers

    def get(self, target: str) -> Any:
        return self.ask("GET", target)

    def ask(self, method: str, target: str, body: Any = None) -> Any:
        """The answer, None if it is empty. Raises Refused."""
        status, text = self._exchange(method, target, None if body is None else json.dumps(body))
        answer = json.loads(text) if text.strip() else None
        if status >= 400:
            problem = answer if isinstance(answer, dict) else {}
            detail = "; ".join([str(problem.get("detail", text)), *problem.get("errors", [])])
            raise Refused(status, detail, problem.get("field"))
        return answer

    def _exchange(self, method: str, target: str, body: Any) -> Any:
        connection = _UnixConnection(self.path)
        try:
            connection.request(method, target, body, {"Content-Type": "application/json"} if body else {})
            response = connection.getresponse()
            return response.status, response.read().decode()
        except (OSError, http.client.HTTPException) as error:
            raise self.why_gone() from error
        finally:
            connection.close()
