# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# The faults that a client notices by time or by its connection: on the wall clock, over TCP and a tty. Bounds of time
# are wide, since the machine may be busy. fault_lines_test.py SCIPD SCENE [CASE..]
import errno
import os
import select
import socket
import sys
import threading
import time

from fault_lab import PATIENCE_S, Client, Lab, Scan, wait_for

UST = {"model": "UST-10LX", "tcp": "127.0.0.1:0", "mount": {"xyz": [0, 0, 0.3]}}
URG = {"model": "URG-04LX", "pty": "tty", "mount": {"xyz": [0, 0, 0.3]}, "timing": "ideal"}
ENDLESS = "MD0000108000000"


class Bench:
    """A scipd with a scanner that is at fault, and one beside it that streams and misses nothing."""

    def __init__(self, scipd, scene):
        self.scipd, self.scene = scipd, scene
        self.lab = Lab(scipd, scene, sensors={"front": UST, "rear": UST, "third": UST, "serial": URG}, lockstep=False)
        self.other = Client(self.lab.address("rear"))
        self.other.ask("BM")
        self.other.ask(ENDLESS)
        self.reader = threading.Thread(target=self.read_other, daemon=True)
        self.reader.start()

    def read_other(self):
        try:
            self.other.read_until(b"QT\n00P\n\n")
        except OSError:
            pass  # a case has failed, and scipd ends

    def beside(self):
        """A client of a third scanner."""
        return Client(self.lab.address("third"))

    def start(self, sensor="front", **fault):
        status, answer = self.lab.control.ask("POST", f"/sensors/robot/{sensor}/faults", fault)
        assert status == 201, answer
        return answer["id"]

    def state(self, fault, sensor="front"):
        return self.lab.control.ask("GET", f"/sensors/robot/{sensor}/faults/{fault}")[1]["state"]

    def wait_until_ended(self, fault, sensor="front"):
        wait_for(lambda: self.state(fault, sensor) == "ended", f"fault {fault} does not end")

    def stop(self, fault, sensor="front"):
        assert self.lab.control.ask("DELETE", f"/sensors/robot/{sensor}/faults/{fault}")[0] == 204

    def client(self):
        return Client(self.lab.address("front"))

    def finish(self):
        """The scanner is sound again, and the other one has missed nothing."""
        client = self.client()
        assert client.ask("VV").startswith(b"VV\n00P\nVEND")
        assert b"sensor is working normally" in client.ask("II")
        assert client.ask("BM") in (b"BM\n00P\n\n", b"BM\n02R\n\n")
        client.ask("MD0000108000003")
        client.read_until(b"MD0000108000000\n99b\n")
        assert client.ask("QT").endswith(b"QT\n00P\n\n")
        client.close()
        begin = len(self.other.got)
        wait_for(lambda: self.other.got.count(b"99b", begin) > 3, "the other scanner is silent")
        self.other.say("QT")
        self.reader.join(PATIENCE_S)
        self.other.close()
        stream = self.other.got[self.other.got.index(b"\n\n", self.other.got.index(ENDLESS.encode())) + 2:]
        scans = [Scan(m) for m in stream.split(b"\n\n") if m.startswith(b"MD")]
        gaps = {b.stamp_ms - a.stamp_ms for a, b in zip(scans, scans[1:])}
        assert len(scans) > 2 and gaps <= {24, 25, 26}, f"the other scanner has gaps of {gaps} ms"
        assert all(scan.sound for scan in scans)
        assert not self.lab.log("rear")


def refused(address):
    try:
        socket.create_connection(address, timeout=5).close()
    except ConnectionRefusedError:
        return True
    return False


def closed(client):
    """How the connection ends."""
    try:
        while client.read():
            pass
        return "ended"
    except ConnectionResetError:
        return "reset"


def delay(bench):
    client = bench.client()
    fault = bench.start(kind="delay", ms=300)
    begin = time.monotonic()
    client.ask("VV")
    assert time.monotonic() - begin >= 0.6, "each way is 300 ms late"
    bench.stop(fault)
    # What is still under way arrives with the end of the fault.
    fault = bench.start(kind="delay", ms=10000)
    client.say("PP")
    bench.stop(fault)
    begin = time.monotonic()
    client.read_until(b"PP\n00P\n")
    client.read_until(b"\n\n", client.got.index(b"PP\n00P\n"))
    assert time.monotonic() - begin < 5
    fast = []
    for _ in range(20):
        begin = time.monotonic()
        client.ask("VV")
        fast.append(time.monotonic() - begin)
    assert min(fast) < 0.3
    client.close()


def coalesce(bench):
    client = bench.client()
    bench.start(kind="coalesce", ms=500, **{"for": {"s": 5}})
    for line in ("VV", "PP", "II"):
        client.say(line)
    first = client.read()
    # The first answer waits for the others.
    assert first.count(b"\n\n") == 3, first
    client.close()


def split(bench):
    client = bench.client()
    fault = bench.start(kind="split", bytes={"at": [3, 10]}, pause_ms=100)
    client.say("VV")
    pieces = [client.read(), client.read(), client.read()]
    assert [len(piece) for piece in pieces[:2]] == [3, 7], pieces
    bench.stop(fault)
    client.close()


def stall(bench):
    client = bench.client()
    fault = bench.start(kind="stall")
    client.say("VV")
    assert client.silent(0.4)
    bench.stop(fault)
    assert client.read_until(b"\n\n").startswith(b"VV\n00P\n")
    client.close()


def cut_by_fin(bench):
    client = bench.client()
    client.ask("VV")  # it is served by now
    bench.start(kind="cut", how="fin")
    assert closed(client) == "ended"
    client.close()


def cut_by_rst(bench):
    client = bench.client()
    client.ask("VV")
    fault = bench.start(kind="cut", how="rst", **{"for": {"s": 0.5}})
    assert closed(client) == "reset"
    assert refused(bench.lab.address("front"))
    bench.wait_until_ended(fault)
    client.close()


def cut_silently(bench):
    client = bench.client()
    client.ask("VV")
    fault = bench.start(kind="cut", how="silent", boot=True, **{"for": {"s": 0.6}})
    client.say("VV")
    assert client.silent(0.3)
    assert closed(client) == "reset", "the scanner knows nothing of it any more"
    bench.wait_until_ended(fault)
    wait_for(lambda: "boots" in str(bench.lab.log("front")), "it does not boot")
    client.close()


def refuse(bench):
    client = bench.client()
    client.ask("VV")
    fault = bench.start(kind="cut", how="refuse", **{"for": {"s": 1000}})
    assert refused(bench.lab.address("front"))
    assert client.ask("VV").startswith(b"VV\n00P\n"), "who is connected stays"
    client.close()
    bench.stop(fault)
    wait_for(lambda: not refused(bench.lab.address("front")), "it goes on refusing")


def refuse_at_a_tty(bench):
    tty = bench.lab.tty("serial")
    descriptor = os.open(tty, os.O_RDWR | os.O_NOCTTY)
    assert tty_ask(descriptor, b"VV").startswith(b"VV\n00P\n")
    fault = bench.start("serial", kind="cut", how="refuse", **{"for": {"s": 1000}})
    wait_for(lambda: not os.path.lexists(tty), "others find it")
    assert tty_ask(descriptor, b"PP").startswith(b"PP\n00P\n"), "who is connected stays"
    bench.stop(fault, "serial")
    wait_for(lambda: os.path.exists(tty), "the link does not come back")
    assert tty_ask(descriptor, b"VV").startswith(b"VV\n00P\n")
    os.close(descriptor)


def mute(bench):
    before = bench.client()
    before.ask("VV")
    fault = bench.start(kind="cut", how="mute", **{"for": {"s": 1000}})
    before.say("VV")
    assert before.silent(0.4), "who is connected already is not answered either"
    before.close()
    client = bench.client()
    client.say("VV")
    assert client.silent(0.4)
    bench.stop(fault)
    assert client.ask("PP").startswith(b"PP\n00P\n"), "it goes on"
    assert b"VV" not in client.got
    client.close()


def reboot(bench):
    client = bench.client()
    client.ask("BM")
    client.ask(ENDLESS)
    bench.start(kind="reboot", boot_s=0.5)
    closed(client)
    client.close()
    client = bench.client()
    begin = time.monotonic()
    assert b"TIME:" in client.ask("II")
    assert b"LASR:OFF" in client.got
    assert time.monotonic() - begin < PATIENCE_S
    client.close()


def state(bench):
    client = bench.client()
    client.ask("BM")
    client.ask(ENDLESS)
    fault = bench.start(kind="state", state="abnormal", until="RB")
    client.read_until(b"MD0000108000000\n0Ll\n\n")
    assert client.ask("BM") == b"BM\n0Ll\n\n"
    assert b"works well" not in client.ask("II")
    client.say("RB")
    client.read_until(b"RB\n01")
    client.say("RB")
    closed(client)
    client.close()
    bench.wait_until_ended(fault)


def status(bench):
    client = bench.client()
    fault = bench.start(kind="status", status="0L", at={"request": "MD", "nth": 2}, until="QT")
    client.ask("BM")
    assert client.ask("MD0000108000001").startswith(b"MD0000108000001\n00P\n")
    client.read_until(b"MD0000108000000\n99b\n")
    client.read_until(b"\n\n", client.got.index(b"MD0000108000000\n99b\n"))
    assert client.ask("MD0000108000002") == b"MD0000108000002\n0Ll\n\n"
    assert client.ask("VV").startswith(b"VV\n00P\n"), "other commands are answered"
    assert client.ask("MD0000108000003") == b"MD0000108000003\n0Ll\n\n"
    assert client.ask("QT") == b"QT\n00P\n\n"
    bench.wait_until_ended(fault)
    client.close()


def sleep(bench):
    client = bench.client()
    client.ask("BM")
    client.ask(ENDLESS)
    asked = time.monotonic()
    fault = bench.start(kind="sleep", **{"for": {"s": 0.5}})
    wait_for(lambda: bench.state(fault) == "ended", "it does not wake")
    begin = len(client.got)
    assert b"LASR:OFF" in client.ask("II", b"STAT") and len(client.got) > begin
    client.ask("BM")
    client.ask(ENDLESS)
    client.read_until(b"99b", len(client.got))
    assert time.monotonic() - asked > 3.2, "the motor is up to its speed at once"
    client.close()


def slow_start(bench):
    client = bench.client()
    client.ask("BM")
    begin = time.monotonic()
    fault = bench.start(kind="motor", spin_up_s=0.7, **{"for": {"s": 2}})
    client.ask(ENDLESS)
    client.read_until(b"99b")
    assert time.monotonic() - begin >= 0.6
    client.close()
    bench.wait_until_ended(fault)


def resend(bench):
    client = bench.client()
    fault = bench.start(kind="resend", what="twice", command="VV")
    answer = client.ask("VV").split(b"\n\n")[0] + b"\n\n"
    assert client.read_until(2 * answer) == 2 * answer
    client.ask("PP")
    bench.stop(fault)
    fault = bench.start(kind="resend", what="previous")
    client.ask("VV")
    assert client.ask("PP").startswith(b"VV\n00P\n")
    bench.stop(fault)
    assert client.ask("PP").startswith(b"PP\n00P\n")
    client.close()


def text_sums(bench):
    client = bench.client()
    fault = bench.start(kind="sums", of="text", command="VV")
    wrong = client.ask("VV")
    right = client.ask("PP")
    bench.stop(fault)
    again = client.ask("VV")
    differ = [i for i, (a, b) in enumerate(zip(wrong, again)) if a != b]
    assert len(wrong) == len(again) and len(differ) == 5 and all(wrong[i + 1:i + 2] == b"\n" for i in differ)
    assert client.ask("PP") == right
    client.close()


def late(bench):
    client = bench.client()
    client.ask("BM")
    fault = bench.start(kind="late", ms=600)
    begin = time.monotonic()
    client.ask("MD0000108000001")
    client.read_until(b"MD0000108000000\n99b\n")
    assert time.monotonic() - begin >= 0.55
    bench.stop(fault)
    client.close()


def tty_ask(descriptor, request):
    os.write(descriptor, request + b"\n")
    got = b""
    while b"\n\n" not in got:
        assert select.select([descriptor], [], [], PATIENCE_S)[0], f"nothing came after {got!r}"
        got += os.read(descriptor, 4096)
    return got


def file_in_its_place(bench):
    """A client that makes a file where it finds no tty."""
    tty = bench.lab.tty("serial")

    def unplugged():
        fault = bench.start("serial", kind="hangup", **{"for": {"s": 1000}})
        wait_for(lambda: not os.path.lexists(tty), "the link stays")
        return fault

    fault = unplugged()
    os.close(os.open(tty, os.O_RDWR | os.O_CREAT))
    bench.stop(fault, "serial")
    wait_for(lambda: os.path.islink(tty), "the tty does not take its place again")
    fault = unplugged()
    with open(tty, "w") as file:
        file.write("VV\n")
    bench.stop(fault, "serial")
    wait_for(lambda: f"{tty} is there and is no link; remove it" in bench.lab.errors_so_far(), "nobody says so")
    assert os.path.isfile(tty)
    os.remove(tty)
    wait_for(lambda: os.path.islink(tty), "the tty does not come back")


def hangup(bench):
    tty = bench.lab.tty("serial")
    descriptor = os.open(tty, os.O_RDWR | os.O_NOCTTY)
    os.write(descriptor, b"VV\n")
    assert os.read(descriptor, 2) == b"VV"
    fault = bench.start("serial", kind="hangup", **{"for": {"s": 0.5}})
    wait_for(lambda: not os.path.exists(tty), "the link stays")
    end = time.monotonic() + PATIENCE_S
    while True:
        assert time.monotonic() < end, "it is not hung up"
        try:
            if not os.read(descriptor, 4096):
                break
        except OSError as error:
            assert error.errno == errno.EIO, error
            break
    os.close(descriptor)
    bench.wait_until_ended(fault, "serial")
    wait_for(lambda: os.path.exists(tty), "the link does not come back")
    descriptor = os.open(tty, os.O_RDWR | os.O_NOCTTY)
    assert tty_ask(descriptor, b"VV").startswith(b"VV\n00P\n")
    os.close(descriptor)


def stamp_ms(client):
    client.ask("BM")
    return Scan(client.ask("GD0000001001")[:-2]).stamp_ms


def two_clocks(bench):
    """Faults of one kind add up, and the clock is right after the last one."""
    client, other = bench.client(), bench.beside()

    def ahead_ms():
        return min((stamp_ms(client) - stamp_ms(other) for _ in range(3)), key=abs)

    before_ms = ahead_ms()
    far = bench.start(kind="clock", jump_ms=10000)
    near = bench.start(kind="clock", jump_ms=1000)
    for _ in range(3):
        assert abs(ahead_ms() - before_ms - 11000) < 500, ahead_ms()
    bench.stop(far)
    assert abs(ahead_ms() - before_ms - 1000) < 500, ahead_ms()
    bench.stop(near)
    assert abs(ahead_ms() - before_ms) < 500, ahead_ms()
    client.close()


def two_states(bench):
    client = bench.client()
    abnormal = bench.start(kind="state", state="abnormal")
    bench.stop(bench.start(kind="state", state="laser"))
    assert client.ask("BM") == b"BM\n0Ll\n\n", "the worse one is still there"
    bench.stop(abnormal)
    assert client.ask("BM") == b"BM\n00P\n\n"
    client.close()


def spins_up_too_long(bench):
    client = bench.client()
    client.ask("BM")
    fault = bench.start(kind="motor", spin_up_s=3000, **{"for": {"s": 0.3}})
    bench.wait_until_ended(fault)
    client.ask("MD0000108000001")
    client.read_until(b"99b")
    client.close()


def sleeps_already(bench):
    client = bench.client()
    client.ask("%SL")
    asleep = client.ask("%ST")
    assert b"005" in asleep
    fault = bench.start(kind="sleep", **{"for": {"s": 0.2}})
    bench.wait_until_ended(fault)
    assert client.ask("%ST") == asleep, "the fault wakes whom a client has put to sleep"
    client.ask("BM")
    client.close()


def next_client(bench):
    """Nothing that a client was to get reaches the next one."""
    faults = [bench.start(kind="reorder"), bench.start(kind="resend", what="previous")]
    for _ in range(6):
        client = bench.client()
        client.ask("PP")
        client.ask("BM")
        client.say(ENDLESS)
        client.read_until(b"99b")
        client.close()
        client = bench.client()
        assert client.ask("II").startswith(b"II\n"), client.got[:60]
        client.close()
    for fault in faults:
        bench.stop(fault)


def stopped_while_it_holds(bench):
    """A scan that waits for the next one is not lost where the fault is stopped."""
    client = bench.client()
    client.ask("BM")
    client.ask(ENDLESS)
    for i in range(16):
        fault = bench.start(kind="reorder")
        time.sleep(0.05 + 0.007 * i)
        bench.stop(fault)
    client.say("QT")
    client.read_until(b"QT\n00P\n\n")
    scans = [Scan(m) for m in client.got.split(b"\n\n") if m.startswith(b"MD") and b"\n99b" in m]
    stamps = sorted(scan.stamp_ms for scan in scans)
    assert {b - a for a, b in zip(stamps, stamps[1:])} <= {24, 25, 26}, stamps
    client.close()


def keeps_its_lateness(bench):
    client = bench.client()
    client.ask("BM")
    client.ask(ENDLESS)
    fault = bench.start(kind="late", ms=800, **{"for": {"s": 1}})
    bench.wait_until_ended(fault)
    for _ in range(80):
        client.read_until(b"99b", len(client.got))
    lateness = bench.lab.control.ask("GET", "/sensors/robot/front")[1]["lateness_ms"]
    assert lateness["max"] < 700, lateness
    client.close()


def in_lockstep(bench):
    """Time goes on while the only driver is kept out, so that the fault ends."""
    for fault in ({"kind": "cut", "how": "rst"}, {"kind": "state", "state": "abnormal"}):
        fault = {"sensor": "robot/front", "at": {"scans": 30}, "for": {"s": 3}, **fault}
        with Lab(bench.scipd, bench.scene, sensors={"front": UST}, faults=[fault]) as lab:
            end = time.monotonic() + PATIENCE_S
            streams = 0
            while streams < 3:
                assert time.monotonic() < end, lab.faults("front")
                try:
                    client = Client(lab.address("front"))
                    client.socket.settimeout(5)
                    client.ask("BM")
                    client.say("MD0000108000040")
                    client.read_until(b"MD0000108000000\n99b\n")
                    streams += 1
                except (OSError, TimeoutError):
                    time.sleep(0.02)
                client.close()
            assert lab.faults("front")[0]["state"] == "ended"


def repeatable(bench):
    """The same scans are hit at the same bytes in another run, although a driver comes at another time."""
    fault = {"kind": "corrupt", "bytes": {"rate": 0.01}, "at": {"scan": 60}, "for": {"scans": 20}, "seed": 5}

    def hits(lab, wait_s):
        assert lab.control.ask("POST", "/sensors/robot/front/faults", fault)[0] == 201
        time.sleep(wait_s)
        client = Client(lab.address("front"))
        client.ask("BM")
        client.ask(ENDLESS)
        wait_for(lambda: lab.faults("front")[-1]["state"] == "ended" or not client.read(), "it does not end")
        client.close()
        return {entry["scan"]: entry["bytes"] for entry in lab.log("front") if entry["bytes"]}

    with Lab(bench.scipd, bench.scene, sensors={"front": UST}, lockstep=False) as one:
        first = hits(one, 0)
    with Lab(bench.scipd, bench.scene, sensors={"front": UST}, lockstep=False) as other:
        second = hits(other, 1.4)  # about when it begins
    both = first.keys() & second.keys()
    scans = first.keys() | second.keys()
    assert len(first) > 10 and min(scans) >= 60 and max(scans) < 80, (first.keys(), second.keys())
    assert all(first[scan] == second[scan] for scan in both)


CASES = {case.__name__: case for case in (
    delay, coalesce, split, stall, cut_by_fin, cut_by_rst, cut_silently, refuse, refuse_at_a_tty, mute, reboot, state,
    status, sleep, slow_start, resend, text_sums, late, hangup, file_in_its_place, two_clocks, two_states,
    spins_up_too_long, sleeps_already, next_client, stopped_while_it_holds, keeps_its_lateness, in_lockstep,
    repeatable)}


def main(scipd, scene, *names):
    failed = []
    for name in names or CASES:
        bench = Bench(scipd, scene)
        with bench.lab:
            try:
                CASES[name](bench)
                bench.finish()
                print(f"{name}: fine", flush=True)
            except (AssertionError, OSError, TimeoutError, ValueError) as error:
                failed.append(name)
                print(f"{name}: {type(error).__name__}: {str(error)[:400]}", flush=True)
    if failed:
        sys.exit(f"failed: {', '.join(failed)}")


if __name__ == "__main__":
    main(*sys.argv[1:])
