# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What a soak prints at its end, and what must hold.
import dataclasses
import statistics

# Memory and descriptors count as flat if the median of the last quarter is at most this factor times that of the second
# quarter, plus a little. In a shorter soak a quarter does not contain every deed.
GROWTH = 1.1
GROWTH_MB = 8.0
GROWTH_DESCRIPTORS = 8
JUDGED_FROM_S = 600.0
# How many more descriptors may be in use after all deeds than before: connections that linger.
# Behind each of four good clients five may wait who said something and hung up: scipd cannot know that nobody reads.
LEFT_DESCRIPTORS = 8 + 4 * 5
ENOUGH_ANSWERS = 200  # for a 99th percentile
EDITED_STATUS_MS = 20.0
LATE_PICTURE_MS = 30.0  # of a picture while nobody does anything but change the scene
CALM_SIZES = 2  # the last seconds, which count as the end


@dataclasses.dataclass
class Deed:
    times: int = 0
    bytes: int = 0
    missed: int = 0  # scans of good clients, while only this deed was done
    slowest_s: float = 0.0  # answer to /status, less the machine's delay, while only this deed was done
    slowest_edit_s: float = 0.0
    most_mb: float = 0.0


class Judge:
    def __init__(self, slow):
        self.failed = []
        self.slow = slow  # scipd cannot be on time, as it is sanitized

    def that(self, holds, text):
        """Prints the text and whether it holds; notes it if not."""
        if not holds:
            self.failed.append(text)
        print(f"  {'ok  ' if holds else 'FAIL'}  {text}")

    def on_time(self, holds, text):
        """The same of what only a scipd can do that is on time."""
        if self.slow and not holds:
            print(f"  late  {text}")
        else:
            self.that(holds, text)


def quantile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))] if values else float("nan")


def tell(soak, said, exit_code, stderr):
    judge = Judge(said.slow)
    seconds = soak.end_s - soak.begin_s
    print(f"{seconds:.0f} s of {', '.join(said.deeds) or 'no deed'}; seed {said.seed}")
    tell_streams(judge, soak, seconds)
    tell_clients(judge, soak, said)
    tell_sizes(judge, soak, said, seconds)
    tell_deeds(judge, soak, said)
    print("\nthe end")
    judge.that(exit_code == 0, f"scipd ends when asked to: {exit_code}")
    faults = [fault for fault in soak.faults if fault]
    judge.that(not faults, f"no other faults: {faults[:5]}")
    size, reloads, last = stderr
    print(f"standard error: {size} bytes, which tell of {reloads} reloads")
    judge.on_time(reloads > 0 or not {"reload", "stderr"} & set(said.deeds), "reloads come about")
    if judge.failed:
        print(f"the last of standard error:\n{last}")
        print("\nFAILED:\n  " + "\n  ".join(judge.failed))
    return 1 if judge.failed else 0


def tell_streams(judge, soak, seconds):
    print("\ngood client     scans  missed  damaged  crooked  lost   longest silence   late by p50, p99, max ms")
    sensors = {sensor["name"]: sensor for sensor in soak.status.latest.get("sensors", ())}
    for stream in soak.streams:
        sensor = sensors.get(stream.name, {"lost": -1, "lateness_ms": {"p50": None, "p99": None, "max": None}})
        late = ", ".join(f"{sensor['lateness_ms'][key] or 0:.1f}" for key in ("p50", "p99", "max"))
        still_s = soak.end_s - (stream.last_s or soak.begin_s)
        print(f"  {stream.name:12} {stream.scans:6} {stream.missed:7} {stream.damaged:8} {stream.crooked:8} "
              f"{sensor['lost']:5} {max(stream.silence_s, still_s):14.3f} s    {late}")
        enough = stream.scans + stream.missed >= 0.9 * seconds * 1000 / stream.period_ms - 20
        sound = stream.damaged == 0 and not stream.fault
        judge.that(sound, f"{stream.name}: no scan is damaged{': ' + stream.fault if stream.fault else ''}")
        complete = stream.missed == stream.crooked == sensor["lost"] == 0
        judge.on_time(complete and enough, f"{stream.name} has every scan, at its time")


def tell_status(judge, soak, said):
    took = [1000 * answer.took_s for answer in soak.answers]
    own = [1000 * answer.by_scipd_s() for answer in soak.answers]
    machine = [1000 * answer.machine_s() for answer in soak.answers]
    print("\n/status, ms                           p50     p99      max")
    for name, values in (("answered in", took), ("less what the machine delayed", own),
                         ("what the machine delayed", machine)):
        print(f"  {name:30} {quantile(values, 0.5):8.1f} {quantile(values, 0.99):7.1f} {max(values, default=0):8.1f}")
    for answer in sorted(soak.answers, key=lambda answer: -answer.by_scipd_s())[:3]:
        print(f"  {1000 * answer.took_s:.0f} ms at {answer.since_s - soak.begin_s:.1f} s "
              f"({soak.done_at(answer.since_s)}): scipd ran for {1000 * answer.ran_s:.0f}, "
              f"had no core for {1000 * answer.waited_s:.0f}, heard {1000 * answer.late_s:.0f} too late")
    slow, by_scipd = (sum(value > said.status_ms for value in values) for values in (took, own))
    judge.on_time(bool(own) and by_scipd == 0, f"no answer to /status takes longer than {said.status_ms:g} ms: "
               f"{slow} of {len(took)} do, {by_scipd} by scipd itself")


def tell_edits(judge, soak, said):
    """What a change of the scene does to others when nothing else is the matter."""
    answers = [1000 * answer.by_scipd_s() for answer in soak.answers_after_edits()]
    if len(answers) >= ENOUGH_ANSWERS:
        p99 = quantile(answers, 0.99)
        judge.on_time(p99 < EDITED_STATUS_MS, f"/status within a second of a change, with no deed: p99 {p99:.1f} ms of "
                      f"{len(answers)}, less than {EDITED_STATUS_MS:g}")
    late_ms = 1000 * soak.pictures.late_s
    print(f"pictures: {soak.pictures.count}, the latest by {late_ms:.1f} ms")
    judge.that(soak.pictures.count > 0, "pictures come")
    if not said.deeds:
        judge.on_time(late_ms <= LATE_PICTURE_MS, f"none is late by more than {LATE_PICTURE_MS:g} ms")


def tell_clients(judge, soak, said):
    tell_status(judge, soak, said)
    print(f"changes of the scene: {len(soak.edits_s)}, p50 {quantile(soak.edits_s, 0.5):.3f}, "
          f"max {max(soak.edits_s, default=0):.3f} s")
    judge.on_time(bool(soak.edits_s) and max(soak.edits_s) <= said.edit_s, f"none takes longer than {said.edit_s:g} s")
    tell_edits(judge, soak, said)
    poses = soak.poses
    print(f"poses: {poses.sent} by UDP and as many by WebSocket; {poses.asked} times asked where their robot is")
    judge.that(poses.sent > 0 and poses.refused == 0, f"none is refused: {poses.refused}")
    judge.on_time(poses.asked > 0 and poses.strayed == 0, f"they are heeded: {poses.strayed} times the robot was "
               f"elsewhere. {poses.fault or ''}")


def tell_sizes(judge, soak, said, seconds):
    print("\nscipd                 first  2nd quarter  last quarter   end  most")
    for column, name, slack in ((0, "RSS, MB", GROWTH_MB), (1, "descriptors", GROWTH_DESCRIPTORS), (2, "threads", 1)):
        values = [size[column] for size in soak.sizes]
        quarter = len(values) // 4
        second = statistics.median(values[quarter:2 * quarter] or [0])
        last = statistics.median(values[3 * quarter:] or [0])
        end = statistics.median(values[-CALM_SIZES:] or [0])
        print(f"  {name:18} {values[0]:7.0f} {second:12.0f} {last:13.0f} {end:5.0f} {max(values):5.0f}")
        if seconds >= JUDGED_FROM_S:
            judge.that(last <= GROWTH * second + slack, f"{name}: flat, the last quarter's at most {GROWTH} x the "
                       f"second's + {slack:g}")
        if name == "descriptors":
            judge.on_time(end <= values[0] + LEFT_DESCRIPTORS, f"descriptors: those of hostile clients are closed, "
                       f"{values[0]} before and {end:.0f} after")
        if name == "RSS, MB":
            judge.that(max(values) <= said.rss_mb, f"RSS never exceeds {said.rss_mb:g} MB")


def tell_deeds(judge, soak, said):
    print("\ndeed            times        MB   alone: scans missed  /status by scipd, ms  change of the scene, s  "
          "RSS, MB")
    for name in [*said.deeds, "several", "none"]:
        deed = soak.deed(name)
        print(f"  {name:12} {deed.times:7} {deed.bytes / 1e6:9.1f} {deed.missed:21} {1000 * deed.slowest_s:21.1f} "
              f"{deed.slowest_edit_s:23.3f} {deed.most_mb:8.0f}")
    idle = [name for name in said.deeds if soak.deed(name).times == 0]
    judge.on_time(not idle, f"every deed was done: {idle or 'all'}")
