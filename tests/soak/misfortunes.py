# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# A deed in the form of deeds.py: whatever can go wrong on purpose goes wrong at the scanners that hostile clients use.
import contextlib
import http.client
import json
import time

PATIENCE_S = 5.0
VICTIMS = ["victim/ust", "victim/utm", "victim/urg"]
KINDS = [
    {"kind": "lose", "bytes": {"rate": 0.01}}, {"kind": "corrupt", "bytes": {"rate": 0.01}},
    {"kind": "noise", "count": 100}, {"kind": "delay", "ms": 50, "jitter_ms": 10}, {"kind": "coalesce", "ms": 100},
    {"kind": "split", "bytes": {"every": 500}, "pause_ms": 1}, {"kind": "stall"}, {"kind": "cut", "how": "silent"},
    {"kind": "cut", "how": "refuse"}, {"kind": "cut", "how": "rst", "boot": True}, {"kind": "hangup"},
    {"kind": "sums", "of": "all", "rate": 0.5}, {"kind": "truncate", "keep": 10, "rate": 0.5},
    {"kind": "resend", "what": "twice"}, {"kind": "status", "status": "0L"}, {"kind": "reboot"},
    {"kind": "state", "state": "abnormal"}, {"kind": "sleep"}, {"kind": "motor", "percent": -10},
    {"kind": "clock", "jump_ms": 100_000}, {"kind": "clock", "frozen": True}, {"kind": "repeat", "rate": 0.5},
    {"kind": "reorder", "rate": 0.5}, {"kind": "freeze"}, {"kind": "skip", "rate": 0.5}, {"kind": "late", "ms": 300},
    {"kind": "shift", "by": 100}, {"kind": "interference", "rate": 0.1}, {"kind": "poses", "how": "late", "ms": 300}]
WITHOUT_END = {"reboot"}


def faults(scipd, rng):
    """Starts faults of all kinds, a few at a time at each scanner, and ends all of them now and then."""
    with contextlib.closing(http.client.HTTPConnection(*scipd.http, timeout=PATIENCE_S)) as client:
        try:
            while True:
                fault = dict(rng.choice(KINDS))
                if fault["kind"] not in WITHOUT_END:
                    fault["for"] = {"s": rng.choice([0.1, 1.0])}
                yield ask(client, "POST", rng.choice(VICTIMS), fault)
                if rng.random() < 0.1:
                    yield ask(client, "DELETE", rng.choice(VICTIMS))
                time.sleep(rng.choice([0.02, 0.2]))
        finally:
            for victim in VICTIMS:
                ask(client, "DELETE", victim)


def ask(client, method, sensor, fault=None):
    """Asks, and returns how many bytes it sent. A scanner that a reload has just taken away has no faults (404)."""
    text = None if fault is None else json.dumps(fault)
    try:
        client.request(method, f"/sensors/{sensor}/faults", text, {"Content-Type": "application/json"} if text else {})
        response = client.getresponse()
        said = response.read()
    except http.client.HTTPException as error:
        client.close()
        raise OSError(f"{error!r}") from error
    if response.status not in (201, 204, 404, 409, 503):
        raise RuntimeError(f"{method} {fault}: {response.status} {said}")
    return len(text or "")
