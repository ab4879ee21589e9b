# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""What can go wrong, each as a sentence for whoever reads the report of a test."""

from __future__ import annotations

from typing import Optional


class ScipdError(Exception):
    """Everything that this package raises on its own, but for wrong arguments (TypeError, ValueError)."""


class ScipdNotFound(ScipdError):
    """There is no program scipd."""


class ScipdNotReady(ScipdError):
    """scipd ended before it was ready, or took too long; the message has the end of its log."""


class ScipdEnded(ScipdError):
    """scipd is not there any more: it crashed, somebody killed it, or it was closed."""


class Refused(ScipdError):
    """scipd refused a request of the control API."""

    def __init__(self, status: int, detail: str, field: Optional[str] = None) -> None:
        super().__init__(f"scipd refused it ({status}): {field + ': ' if field else ''}{detail}")
        self.status = status
        self.detail = detail
        self.field = field


class NoScan(ScipdError):
    """A scanner sent no scan in time, or none that is whole."""


class TimeStandsStill(ScipdError):
    """In lockstep, time did not go on."""
