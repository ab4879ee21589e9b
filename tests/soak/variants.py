# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Deeds of careless administrators, in the form of deeds.py: right and wrong configurations, and a standard error that
# nobody reads.
import time

MORE = """  more:
    sensors:
      ust: {model: UST-20LX, pty: more-ust}
      sonar: {ranger: {cone_deg: 30, beams: 61, rate_hz: 20, range_m: [0.02, 4.0]}}
"""
STILL_UNREAD_S = 5.0


def right(text, rng):
    return rng.choice([
        lambda: text,
        lambda: text + MORE,
        lambda: text.replace("square_room", "corridor"),
        lambda: text.replace("columns: 400", "columns: 40"),
        lambda: text.replace("[-1, 1, 0]", "[-1, 1.5, 0]"),
    ])()


def wrong(text, rng):
    return rng.choice([
        lambda: "robots: [",
        lambda: "",
        lambda: "\x01\x02" * 1000,
        lambda: text.replace("square_room", "no_such_room"),
        lambda: text.replace("UTM-30LX", "UTM-99"),
        lambda: text.replace("seed", "sead"),
        lambda: text.replace("victim-urg", "no/such\0folder"),
        lambda: text + MORE.replace("more-ust", "/proc/more"),
        lambda: wrong_in_many_places(text),
    ])()


def wrong_in_many_places(text):
    return text + "".join(f"  more{i}: {{pose: {i}, sensors: {{ust: {{model: {i}}}}}}}\n" for i in range(100))


def reload(scipd, rng):
    """SIGHUP with right and wrong configurations in turn. At the end it restores the first one."""
    try:
        while True:
            for make in (right, wrong):
                text = make(scipd.configuration, rng)
                scipd.configure(text)
                scipd.reload()
                yield len(text)
                time.sleep(rng.choice([0.01, 0.1, 0.5]))
    finally:
        scipd.configure(scipd.configuration)
        scipd.reload()


def stderr(scipd, rng):
    """Nobody reads standard error for some seconds, while scipd has much to write."""
    while True:
        scipd.listens.clear()
        try:
            end = time.monotonic() + STILL_UNREAD_S
            while time.monotonic() < end:
                text = wrong_in_many_places(scipd.configuration)
                scipd.configure(text)
                scipd.reload()
                yield len(text)
                time.sleep(rng.random() * 0.2)
        finally:
            scipd.listens.set()
            scipd.configure(scipd.configuration)
            scipd.reload()
        time.sleep(0.5)
