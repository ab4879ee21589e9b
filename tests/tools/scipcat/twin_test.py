#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
scipcat twin, with scanners of scipd: twin_test.py SCIPD SCIPCAT. The twin is held against the scanner by scipcat
compare, which knows nothing of fitting. What a terminal asks is asked on a terminal.
"""
import json
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

SCIPD, SCIPCAT = sys.argv[1:3]

# x, y, length, width in m, and how bright: four walls, of which each is another one.
WALLS = [(5, 0, 0.2, 8, 0.9), (-3, 0, 0.2, 8, 0.5), (1, 3, 8.2, 0.2, 0.6), (1, -3, 8.2, 0.2, 0.8)]
BOX = (2.5, -1.5, 0.6, 0.8, 0.3)


def world(boxes):
    models = "".join(
        f'<model name="m{i}"><static>true</static><pose>{x} {y} 1 0 0 0</pose><link name="l"><visual name="v">'
        f"<geometry><box><size>{long} {wide} 2</size></box></geometry><laser_retro>{retro}</laser_retro>"
        f"</visual></link></model>" for i, (x, y, long, wide, retro) in enumerate(boxes))
    return f'<sdf version="1.9"><world name="w">{models}</world></sdf>'


SCANNERS = {
    "urg": "{model: URG-04LX, accuracy: sensor, pty: TTY}",
    "ust": "{model: UST-10LX, accuracy: material}",
}


class Scipd:
    """A scipd with this configuration; `targets` by the names of its scanners."""

    def __init__(self, config, *words):
        self.process = subprocess.Popen([SCIPD, "--config", config, "--http", "none", "--control",
                                         config.with_suffix(".sock"), "--log-level", "error", *words],
                                        stdout=subprocess.PIPE, text=True)
        ready = json.loads(self.process.stdout.readline())
        self.targets = {}
        for sensor in ready["sensors"]:
            name = sensor["name"].split("/")[1]
            self.targets[name] = "tcp://" + sensor["tcp"]
            self.targets[name + "_tty"] = sensor["pty"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        assert self.process.wait(timeout=60) == 0


def configuration(folder, boxes):
    (folder / "real.sdf").write_text(world(boxes))
    place = "mount: {xyz: [0, 0, 0.3], rpy: [0, 0, 0.2]}, tcp: '127.0.0.1:0'"
    sensors = "".join(f"      {name}: {{{place}, {words[1:]}\n"
                      for name, words in SCANNERS.items())
    sensors = sensors.replace("TTY", str(folder / "urg.tty"))
    config = folder / "real.yaml"
    config.write_text(f"scene: real.sdf\nseed: 7\nrobots:\n  r:\n    sensors:\n{sensors}")
    return config


def twins(folder, targets, seconds):
    """Of all of them at once, so that it takes no longer than one."""
    makers = {name: subprocess.Popen([SCIPCAT, "twin", target, "-o", folder / name, "--seconds", str(seconds),
                                      "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                     stdin=subprocess.DEVNULL)
              for name, target in targets.items()}
    documents = {}
    for name, maker in makers.items():
        out, err = maker.communicate(timeout=300)
        assert maker.returncode == 0, err
        documents[name] = json.loads(out)
    return documents


def compared(a, b, scans):
    done = subprocess.run([SCIPCAT, "compare", a, b, "-n", str(scans), "--intensity", "--json"], capture_output=True,
                          text=True, timeout=300)
    if done.returncode == 2:  # no intensities
        done = subprocess.run([SCIPCAT, "compare", a, b, "-n", str(scans), "--json"], capture_output=True, text=True,
                              timeout=300)
    assert done.returncode in (0, 1), done.stderr
    return json.loads(done.stdout)


def check_is_the_same(name, real, twin, scans):
    """What compare says in one number is within its floor; of the steps at most one in forty differs."""
    document = compared(real, twin, scans)
    floor = document["floor"]
    summary = (name, document["mean_mm"], document["sd_a_mm"], document["sd_b_mm"], floor, document["differ"])
    assert abs(document["mean_mm"]) < min(1, floor["mean_mm"]), summary
    assert abs(document["sd_b_mm"] - document["sd_a_mm"]) < min(0.5, floor["sd_mm"]), summary
    assert abs(document["neighbours_b"] - document["neighbours_a"]) < 0.03, summary
    steps = set()
    for one in document["differ"]:
        if one["what"] in ("clock", "rate"):  # as the host's load has it; no twin is made of them
            continue
        assert one["what"] != "neighbours", summary
        steps |= set(range(one["from"], one["to"] + 1))
    assert len(steps) <= document["a"]["steps"] / 40, (sorted(steps), summary)
    print(name, document["verdict"], len(steps), "steps,", f"{document['mean_mm']:+.2f} mm", flush=True)
    return document


def check_report(file):
    """It is sound, needs nothing else, and its words are text."""
    page = xml.etree.ElementTree.parse(file)
    drawings = list(page.iter("svg"))
    assert len(drawings) > 7, file
    assert all(any(text.text for text in drawing.iter("text")) for drawing in drawings), file
    for element in page.iter():
        assert element.tag not in ("script", "img", "link", "iframe"), element.tag
        assert not any("nan" in value or "://" in value for value in element.attrib.values()), element.attrib


def check_twins(folder):
    scans = {"urg": 80, "ust": 320}
    with Scipd(configuration(folder, WALLS)) as real:
        targets = {name: real.targets[name] for name in SCANNERS} | {"urg": real.targets["urg_tty"]}
        for name, document in twins(folder, targets, 8).items():
            assert document["twin"] == str(folder / name / "twin.yaml"), document
            assert document["recordings"] == [str(folder / name / "standing.mcap")], document
            assert document["fit"]["room"]["explained"] > 0.95 * document["fit"]["room"]["beams"], document
            assert document["fit"]["unknown"], document
            check_report(folder / name / "report.html")
            config = folder / name / "twin.yaml"
            with Scipd(config, "--free-ports") as twin:
                check_is_the_same(name, real.targets[name], twin.targets["scanner"], scans[name])


def on_a_terminal(words, answer):
    """What it writes on a terminal on which this is answered to the question."""
    pid, terminal = pty.fork()
    if pid == 0:
        os.execv(words[0], [str(word) for word in words])
    text = b""
    asked = False
    while True:
        try:
            text += os.read(terminal, 4096)
        except OSError:
            break
        if not asked and b"Enter: " in text:
            os.write(terminal, answer)
            asked = True
    os.close(terminal)
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]), text.decode()


def check_terminal(folder):
    words = [SCIPCAT, "twin", None, "-o", folder / "asked", "--seconds", "2"]
    with Scipd(configuration(folder, [*WALLS, BOX])) as real:
        words[2] = real.targets["ust"]
        code, text = on_a_terminal(words, b"\n")
        assert code == 0, text
        assert (folder / "asked" / "turned.mcap").exists(), text
        assert "90 degrees" in text and "the twin: scipd --config" in text, text
        code, text = on_a_terminal(words, b"n\n")
        assert code == 0, text
        assert not (folder / "asked" / "turned.mcap").exists(), text


def check_interrupted(folder):
    with Scipd(configuration(folder, WALLS)) as real:
        maker = subprocess.Popen([SCIPCAT, "twin", real.targets["ust"], "-o", folder / "cut", "--seconds", "600"],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        recording = folder / "cut" / "standing.mcap"
        until = time.monotonic() + 60
        while not (recording.exists() and recording.stat().st_size > 50_000) and time.monotonic() < until:
            time.sleep(0.05)
        maker.send_signal(signal.SIGINT)
        _, err = maker.communicate(timeout=60)
        assert maker.returncode == 1 and "interrupted" in err, err
        info = subprocess.run([SCIPCAT, "info", recording, "--json"], capture_output=True, check=True).stdout
        assert json.loads(info)["scans"] > 10, info
        assert not (folder / "cut" / "twin.yaml").exists()


def check_interrupted_fit(folder):
    """Nothing of the fit is left, and the recording is."""
    slow, temporary = folder / "slow" / "scipcat", folder / "temporary"
    slow.parent.mkdir()
    temporary.mkdir()
    shutil.copy(SCIPCAT, slow)
    scipfit = slow.with_name("scipfit")
    scipfit.write_text("#!/bin/sh\nexec sleep 600\n")
    scipfit.chmod(0o755)
    with Scipd(configuration(folder, WALLS)) as real:
        maker = subprocess.Popen([slow, "twin", real.targets["ust"], "-o", folder / "unfitted", "--seconds", "1"],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                 env={**os.environ, "TMPDIR": str(temporary)})
        until = time.monotonic() + 60
        while not list(temporary.glob("*/scipfit.err")) and time.monotonic() < until:
            time.sleep(0.05)
        maker.send_signal(signal.SIGINT)
        _, err = maker.communicate(timeout=60)
    assert maker.returncode == 1 and "interrupted during the fit" in err, (maker.returncode, err)
    assert not list(temporary.iterdir()), list(temporary.iterdir())
    assert (folder / "unfitted" / "standing.mcap").exists()


def check_without_scipfit(folder):
    alone = folder / "alone" / "scipcat"
    alone.parent.mkdir()
    shutil.copy(SCIPCAT, alone)
    done = subprocess.run([alone, "twin", "tcp://127.0.0.1:1", "-o", folder / "none"], capture_output=True, text=True)
    assert done.returncode == 2 and "scipd-tools" in done.stderr, done
    assert not (folder / "none").exists()


def check_out_of_reach(folder):
    """Nothing is left of a scanner that does not answer, and what was there before stays."""
    for output in (folder / "far" / "away", folder / "far" / "with a slash/", folder):
        done = subprocess.run([SCIPCAT, "twin", "tcp://127.0.0.1:1", "-o", output], capture_output=True, text=True)
        assert done.returncode not in (0, 2) and "127.0.0.1 port 1" in done.stderr, done
    assert folder.exists() and not (folder / "far").exists()


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_without_scipfit(folder)
        check_out_of_reach(folder)
        check_twins(folder)
        check_terminal(folder)
        check_interrupted(folder)
        check_interrupted_fit(folder)


if __name__ == "__main__":
    main()
