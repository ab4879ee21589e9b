# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Each kind of fault that a client of a scanner sees in its bytes, against a run without it. A run in lockstep repeats
# to the byte: so a fault shows as the difference of two runs, and nothing else may differ, neither before nor after.
# fault_kinds_test.py SCIPD SCENE [KIND..]
import sys
from concurrent.futures import ThreadPoolExecutor

from fault_lab import Client, Lab, Scan, sum_is_right

SCANS = 60
FIRST, COUNT = 20, 15  # the fault's scans, counted from the start of the scenario
STREAM = f"MD00001080000{SCANS}"
STREAM_WITH_INTENSITY = f"ME00001080000{SCANS}"
MODEL = {"model": "UTM-30LX-EW", "tcp": "127.0.0.1:0", "mount": {"xyz": [0, 0, 0.3]}}
UST = {**MODEL, "model": "UST-10LX"}
QUESTIONS = ["VV", "PP", "II"]


class Run:
    """What a client got: before the stream, in it, and afterwards."""

    def __init__(self, scipd, scene, fault, *, stream=STREAM, sensor=UST, seed=7):
        faults = [{"sensor": "robot/front", "at": {"scans": FIRST}, "for": {"scans": COUNT}, **fault}] if fault else []
        with Lab(scipd, scene, sensors={"front": sensor, "rear": sensor}, faults=faults, seed=seed) as lab:
            client = Client(lab.address("front"))
            for question in [*QUESTIONS, "BM"]:
                client.ask(question)
            begin = len(client.got)
            client.ask(stream)
            begin = client.got.index(b"\n\n", begin) + 2
            self.before = client.got[:begin]
            # The last one says that none is left. It is sound: the fault is over by then.
            last = (stream[:-2] + "00\n99b\n").encode()
            client.read_until(last, begin)
            end = client.got.index(last, begin)
            while b"\n\n" not in client.got[end:]:
                client.read()
            self.stream = client.got[begin:]
            begin = len(client.got)
            for question in ["QT", *QUESTIONS]:
                client.ask(question)
            self.after = client.got[begin:]
            client.close()
            # The scanner beside it has none of it.
            other = Client(lab.address("rear"))
            other.ask("BM")
            self.other = other.ask("GD0000108000")
            self.log = lab.log("front")
            self.states = [fault["state"] for fault in lab.faults("front")]
            assert not lab.log("rear"), "the other scanner has a log"
        self.messages = [message + b"\n\n" for message in self.stream.split(b"\n\n") if message]

    def scans(self, values_per_step=1):
        return [Scan(message[:-2], values_per_step) for message in self.messages]

    def touches(self):
        return [entry for entry in self.log if entry["what"] not in ("begins", "ends")]


def differing(base, run):
    """The scans that differ, of as many."""
    assert len(run.messages) == len(base.messages), f"{len(run.messages)} scans, not {len(base.messages)}"
    different = [i for i, (a, b) in enumerate(zip(base.messages, run.messages)) if a != b]
    assert different, "nothing differs"
    assert different[-1] - different[0] < COUNT, f"more scans differ than the fault has: {different}"
    return different


def all_differ(base, run):
    different = differing(base, run)
    assert len(different) == COUNT, f"{len(different)} scans differ, not {COUNT}"
    return different


def changed_bytes(base, run):
    """By scan, the places whose bytes differ, in messages that stay as long."""
    return {i: [n for n, (a, b) in enumerate(zip(base.messages[i], run.messages[i])) if a != b]
            for i in differing(base, run)}


# Each of these takes the run without the fault and the one with it.

def corrupt(base, run):
    # A changed byte may be a line feed or none: the messages cannot be told from each other, but their bytes can.
    assert len(run.stream) == len(base.stream)
    places = [i for i, (a, b) in enumerate(zip(base.stream, run.stream)) if a != b]
    touched = sum(len(entry["bytes"]) for entry in run.touches())
    assert len(places) == touched > 0, f"{len(places)} bytes differ, the log has {touched}"
    size = len(base.messages[0])
    share = len(places) / (COUNT * size)
    assert abs(share - 0.01) < 5 * (0.01 / (COUNT * size)) ** 0.5, f"{share} of the bytes differ"
    assert places[-1] - places[0] < COUNT * size


def corrupt_sums(base, run):
    assert len(run.stream) == len(base.stream)
    places = [i for i, (a, b) in enumerate(zip(base.stream, run.stream)) if a != b]
    assert places and all(base.stream[i + 1:i + 2] == b"\n" for i in places), "more than sums differs"
    assert len(places) == sum(len(entry["bytes"]) for entry in run.touches())


def lose(base, run):
    touched = sum(len(entry["bytes"]) for entry in run.touches())
    assert touched > 0 and len(run.stream) == len(base.stream) - touched


def duplicate(base, run):
    touched = sum(len(entry["bytes"]) for entry in run.touches())
    assert touched > 0 and len(run.stream) == len(base.stream) + touched


def noise(base, run):
    assert len(run.stream) == len(base.stream) + 30
    at = run.stream.index(bytes(30))
    assert run.stream[:at] + run.stream[at + 30:] == base.stream


def wrong_data_sums(base, run):
    for scan in all_differ(base, run):
        lines = run.messages[scan].split(b"\n")
        assert sum_is_right(lines[1]) and not any(sum_is_right(line) for line in lines[2:-2])


def wrong_status_sums(base, run):
    for scan in all_differ(base, run):
        lines = run.messages[scan].split(b"\n")
        assert not sum_is_right(lines[1]) and all(sum_is_right(line) for line in lines[2:-2])


def truncate(base, run):
    # Without its end a message runs into the next one.
    assert len(run.stream) == len(base.stream) - sum(len(message) - 100 for message in base.messages[:COUNT])


def linefeed(base, run):
    assert len(run.stream) == len(base.stream) - COUNT


def echo(base, run):
    for scan, places in changed_bytes(base, run).items():
        assert len(places) == 1 and places[0] < len(STREAM), f"scan {scan} differs at {places}"


def repeat(base, run):
    assert len(run.messages) == SCANS + COUNT
    twice = [i for i in range(1, len(run.messages)) if run.messages[i] == run.messages[i - 1]]
    assert len(twice) == COUNT
    assert [m for i, m in enumerate(run.messages) if i not in twice] == base.messages


def reorder(base, run):
    assert sorted(run.messages) == sorted(base.messages) and COUNT <= len(unequal(base, run)) <= COUNT + 1
    stamps = [scan.stamp_ms for scan in run.scans()]
    assert sum(later < earlier for earlier, later in zip(stamps, stamps[1:])) == (COUNT + 1) // 2


def unequal(base, run):
    return [i for i, (a, b) in enumerate(zip(base.messages, run.messages)) if a != b]


def freeze(base, run):
    scans = run.scans()
    frozen = [i for i in range(1, SCANS) if scans[i].ranges == scans[i - 1].ranges]
    assert len(frozen) == COUNT - 1 and frozen[-1] - frozen[0] == COUNT - 2
    assert [scan.stamp_ms for scan in scans] == [scan.stamp_ms for scan in base.scans()]


def skip(base, run):
    gaps = [b.stamp_ms - a.stamp_ms for a, b in zip(run.scans(), run.scans()[1:])]
    assert len(run.messages) == SCANS and abs(max(gaps) - 25 * (COUNT + 1)) <= 1, gaps


def sector(change):
    """Exactly the steps 300 to 400 differ, and they are as `change` says."""
    def check(base, run):
        for i in all_differ(base, run):
            before, after = base.scans()[i], run.scans()[i]
            assert after.sound
            assert before.ranges[:300] == after.ranges[:300] and before.ranges[401:] == after.ranges[401:]
            assert all(change(range_mm) for range_mm in after.ranges[300:401]), after.ranges[300:401]
    return check


def interference(base, run):
    count = 0
    for i in differing(base, run):
        before, after = base.scans()[i].ranges, run.scans()[i].ranges
        different = [n for n in range(len(after)) if before[n] != after[n]]
        assert different and 300 <= different[0] and different[-1] <= 400
        count += len(different)
    expected = 0.1 * 101 * COUNT
    assert abs(count - expected) < 5 * expected ** 0.5, f"{count} beams, not about {expected}"


def shift(base, run):
    for i in all_differ(base, run):
        assert run.scans()[i].ranges[10:] == base.scans()[i].ranges[:-10]


def intensity(base, run):
    before, after = base.scans(2), run.scans(2)
    for i in all_differ(base, run):
        assert any(before[i].intensities) and not any(after[i].intensities)
        assert before[i].ranges == after[i].ranges


def stamps(change):
    """`change` has the stamps of the fault's scans from those without it."""
    def check(base, run):
        last = differing(base, run)[-1]
        before, after = base.scans(), run.scans()
        first = last - COUNT + 1
        for i in range(SCANS):
            expected = before[i].stamp_ms
            if first <= i <= last:
                expected = change(before, first, i) & 0xFFFFFF
            assert abs(after[i].stamp_ms - expected) <= 1, f"scan {i}: {after[i].stamp_ms}, not {expected}"
            assert after[i].ranges == before[i].ranges
    return check


def frozen_clock(base, run):
    after = [scan.stamp_ms for scan in run.scans()]
    same = [i for i in range(1, SCANS) if after[i] == after[i - 1]]
    assert len(same) >= COUNT - 1 and same[-1] - same[0] == len(same) - 1, after
    assert after[-10:] == [scan.stamp_ms for scan in base.scans()][-10:]


def repeated_stamps(base, run):
    before, after = [[scan.stamp_ms for scan in r.scans()] for r in (base, run)]
    repeated = [i for i in range(1, SCANS) if after[i] == after[i - 1]]
    assert COUNT // 2 - 1 <= len(repeated) <= COUNT // 2 + 1, after
    assert all(b - a == 2 for a, b in zip(repeated, repeated[1:]))
    assert all(after[i] == before[i] for i in range(SCANS) if i not in repeated)


def wrapped(base, run):
    after = [scan.stamp_ms for scan in run.scans()]
    drops = [i for i in range(1, SCANS) if after[i] < after[i - 1]]
    # It wraps in the midst of the fault, and is as it was afterwards.
    assert len(drops) == 1 and after[drops[0] - 1] > 0xFFFFFF - 26 and after[drops[0]] < 26, after
    assert after[-10:] == [scan.stamp_ms for scan in base.scans()][-10:]


def slow_motor(base, run):
    gaps = [b.stamp_ms - a.stamp_ms for a, b in zip(run.scans(), run.scans()[1:])]
    slow = [gap for gap in gaps if gap >= 27]
    assert gaps[0] == 25 and gaps[-1] == 25
    assert COUNT - 2 <= len(slow) <= COUNT + 1 and all(27 <= gap <= 56 for gap in slow), gaps


def stopped_poses(base, run):
    # The robot drives to +x at 20 mm/s: what it sees in front comes closer by half a millimetre a scan.
    assert differing(base, run)
    def front(scans):
        return sum(sum(scan.ranges[530:551]) for scan in scans) / 21 / len(scans)
    different = differing(base, run)
    late = slice(different[-1] - 4, different[-1] + 1)
    gap_mm = front(run.scans()[late]) - front(base.scans()[late])
    assert 3 < gap_mm < 9, gap_mm


def late_poses(base, run):
    different = differing(base, run)
    def front(scans):
        return sum(sum(scan.ranges[530:551]) for scan in scans) / 21 / len(scans)
    some = slice(different[0], different[-1] + 1)
    gap_mm = front(run.scans()[some]) - front(base.scans()[some])
    assert 3 < gap_mm < 5, gap_mm  # 0.2 s late


def jumped_poses(base, run):
    for i in all_differ(base, run):
        before, after = base.scans()[i].ranges, run.scans()[i].ranges
        gap_mm = sum(before[530:551]) / 21 - sum(after[530:551]) / 21
        assert 280 < gap_mm < 320, gap_mm


STEPS = {"steps": [300, 400]}
CASES = {
    "corrupt": ({"kind": "corrupt", "bytes": {"rate": 0.01}}, corrupt),
    "corrupt within sums": ({"kind": "corrupt", "bytes": {"rate": 0.2}, "within": "sums"}, corrupt_sums),
    "lose": ({"kind": "lose", "bytes": {"rate": 0.01}}, lose),
    "duplicate": ({"kind": "duplicate", "bytes": {"rate": 0.01}}, duplicate),
    "noise": ({"kind": "noise", "count": 30}, noise),
    "sums of data": ({"kind": "sums", "of": "data"}, wrong_data_sums),
    "sums of status": ({"kind": "sums", "of": "status"}, wrong_status_sums),
    "truncate": ({"kind": "truncate", "keep": 100}, truncate),
    "linefeed": ({"kind": "linefeed"}, linefeed),
    "echo": ({"kind": "echo"}, echo),
    "repeat": ({"kind": "repeat"}, repeat),
    "reorder": ({"kind": "reorder"}, reorder),
    "freeze": ({"kind": "freeze"}, freeze),
    "skip": ({"kind": "skip"}, skip),
    "dirty, near": ({"kind": "dirty", **STEPS, "reads": "near"}, sector(lambda mm: mm < 100 or mm > 60000)),
    "dirty, weak": ({"kind": "dirty", **STEPS, "reads": "weak"}, sector(lambda mm: mm > 60000)),
    "dirty, nothing": ({"kind": "dirty", **STEPS, "reads": "nothing"}, sector(lambda mm: mm > 60000)),
    "blind": ({"kind": "blind", **STEPS}, sector(lambda mm: mm > 60000)),
    "stick": ({"kind": "stick", **STEPS, "range_m": 1.5}, sector(lambda mm: mm == 1500)),
    "interference": ({"kind": "interference", **STEPS, "rate": 0.1}, interference),
    "shift": ({"kind": "shift", "by": 10}, shift),
    "intensity": ({"kind": "intensity"}, intensity),
    "clock jumps": ({"kind": "clock", "jump_ms": 5000}, stamps(lambda before, first, i: before[i].stamp_ms + 5000)),
    "clock drifts": ({"kind": "clock", "ppm": 10000},
                     stamps(lambda before, first, i:
                            before[i].stamp_ms + round(0.01 * (before[i].stamp_ms - before[first].stamp_ms)))),
    "clock wraps": ({"kind": "clock", "wrap_in_s": 0.2}, wrapped),
    "clock stands still": ({"kind": "clock", "frozen": True}, frozen_clock),
    "clock repeats": ({"kind": "clock", "repeat": 2}, repeated_stamps),
    "motor": ({"kind": "motor", "percent": -10}, slow_motor),
    "poses stop": ({"kind": "poses", "how": "stop"}, stopped_poses),
    "poses come late": ({"kind": "poses", "how": "late", "ms": 200}, late_poses),
    "poses jump": ({"kind": "poses", "how": "jump", "xyz": [0.3, 0, 0]}, jumped_poses),
}
# What comes after these is not as it would have been.
LEAVES_ITS_TIME = {"motor", "skip"}


def try_case(scipd, scene, name, bases):
    fault, check = CASES[name]
    with_intensity = name == "intensity"
    options = {"stream": STREAM_WITH_INTENSITY, "sensor": {**MODEL, "accuracy": "material"}} if with_intensity else {}
    base = bases[with_intensity]
    run = Run(scipd, scene, fault, **options)
    assert run.before == base.before, "something differs before the fault"
    check(base, run)
    assert run.states == ["ended"], run.states
    assert run.touches(), "the log is empty"
    whats = [entry["what"] for entry in run.log]
    assert whats[0] == "begins" and whats.count("ends") == 1, whats
    if name not in LEAVES_ITS_TIME:
        assert run.after == base.after, f"afterwards it answers {run.after!r}, not {base.after!r}"
        assert run.other == base.other, "another scanner differs"
    again = Run(scipd, scene, fault, **options)
    assert again.stream == run.stream and again.log == run.log, "the same seed gives other bytes"
    if "rate" in str(fault):
        other = Run(scipd, scene, {**fault, "seed": 99}, **options)
        assert other.stream != run.stream, "another seed gives the same bytes"


def main(scipd, scene, *names):
    bases = {False: Run(scipd, scene, None),
             True: Run(scipd, scene, None, stream=STREAM_WITH_INTENSITY, sensor={**MODEL, "accuracy": "material"})}
    failed = []

    def attempt(name):
        try:
            try_case(scipd, scene, name, bases)
        except (AssertionError, OSError, ValueError, IndexError) as error:
            failed.append(name)
            print(f"{name}: {type(error).__name__}: {str(error)[:400]}", flush=True)
        else:
            print(f"{name}: fine", flush=True)

    with ThreadPoolExecutor(2) as pool:
        list(pool.map(attempt, names or CASES))
    if failed:
        sys.exit(f"failed: {', '.join(failed)}")


if __name__ == "__main__":
    main(*sys.argv[1:])
