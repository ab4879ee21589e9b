# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Sends pose lines with stamps, over the WebSocket /poses, and hears which were refused. One thread."""

from __future__ import annotations

import json
from typing import Any, Dict, List, Tuple

from .errors import ScipdError
from .listener import Listener
from .pose import Pose
from .websocket import WebSocketClosed


class StampedPoses:
    def __init__(self, control: str) -> None:
        self._refusals: List[Dict[str, Any]] = []
        self._listener = Listener(control, "/poses", lambda text: self._refusals.append(json.loads(text)))
        self.latest_us = -1

    def say(self, stamp_us: int, poses: Dict[Tuple[str, str], Pose]) -> None:
        """With a later stamp if this one has been used. `poses`: by ("robot" or "model", its name)."""
        self.latest_us = max(stamp_us, self.latest_us + 1)
        lines = [json.dumps({kind: name, "t": self.latest_us / 1e6, **pose.as_json()})
                 for (kind, name), pose in poses.items()]
        try:
            self._listener.send("\n".join(lines))
        except WebSocketClosed:
            pass  # whoever waits for the time to come finds out why

    def check(self) -> None:
        """Raises ScipdError if scipd has refused a pose since."""
        refusals, self._refusals = self._refusals, []
        if refusals:
            raise ScipdError(f"scipd has refused a pose: {refusals[0].get('detail')}")

    def close(self) -> None:
        self._listener.close()
