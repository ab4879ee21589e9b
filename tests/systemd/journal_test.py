# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What scipd logs where standard error is the journal: journal_test.py SCIPD SCENES
# The journal's socket has one name on a machine, so the test plays the journal in a mount namespace of its own.
import os
import pathlib
import socket
import subprocess
import sys
import tempfile

from manager import PATIENCE_S, Manager, run_all

SKIPPED = 77
INSIDE = "SCIPD_JOURNAL_NAMESPACE"
JOURNAL = "/run/systemd/journal/socket"


def fields_of(datagram):
    """Of an entry in the journal's own protocol."""
    fields = {}
    while datagram:
        line, _, datagram = datagram.partition(b"\n")
        name, equals, value = line.partition(b"=")
        if not equals:  # it has line ends
            size = int.from_bytes(datagram[:8], "little")
            value, datagram = datagram[8:8 + size], datagram[8 + size + 1:]
        fields[name.decode()] = value.decode()
    return fields


class Journal:
    def __init__(self):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind(JOURNAL)
        self.socket.settimeout(PATIENCE_S)
        self.entries = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()
        os.unlink(JOURNAL)

    def find(self, text):
        """The entry whose message has this text."""
        while True:
            self.entries.append(fields_of(self.socket.recv(1 << 20)))
            if text in self.entries[-1]["MESSAGE"]:
                return self.entries[-1]


def start(program, scenes, folder, *options, journal=True, stream=None, tcp="127.0.0.1:0", **more):
    """Its standard error is what systemd calls the journal."""
    document = {"scene": str(scenes / "square_room.sdf"), **more,
                "robots": {"rescue": {"sensors": {"front": {"model": "UST-10LX", "tcp": tcp}}}}}
    errors = pathlib.Path(folder, "stderr")
    errors.touch()
    status = errors.stat()
    stream = stream or f"{status.st_dev}:{status.st_ino}"
    wrapper = pathlib.Path(folder, "scipd")
    wrapper.write_text(f'#!/bin/sh\nexec {program} "$@" {" ".join(options)}\n')
    wrapper.chmod(0o755)
    return Manager(str(wrapper), folder, document, environment={"JOURNAL_STREAM": stream} if journal else {})


def logs_entries_with_fields(program, scenes, folder):
    with Journal() as journal, start(program, scenes, folder, tcp="0.0.0.0:0") as scipd:
        scipd.ready()
        warning = journal.find("every machine that reaches this one")
        assert warning["MESSAGE"].startswith("rescue/front listens on 0.0.0.0:"), warning
        assert warning["PRIORITY"] == "4" and warning["SYSLOG_IDENTIFIER"] == "scipd", warning
        assert "SCIPD_SENSOR" not in warning and "CODE_FILE" not in warning, warning
        choice = journal.find("chosen (")
        assert choice["SCIPD_SENSOR"] == "rescue/front" and choice["PRIORITY"] == "6", choice
        assert choice["MESSAGE"].startswith("rescue/front: backend "), choice
        scipd.configure("robots:\n  a: 1\nscene: nowhere\x1b\n")
        scipd.reload()
        fault = journal.find("SIGHUP: nothing was changed, since\n")
        assert fault["PRIORITY"] == "3" and "service.yaml:" in fault["MESSAGE"], fault
        assert "\x1b" not in fault["MESSAGE"], fault
    assert scipd.log() == "", scipd.log()


def says_there_why_it_cannot_start(program, scenes, folder):
    with Journal() as journal, start(program, scenes, folder, tcp="192.0.2.1:10940") as scipd:
        assert journal.find("192.0.2.1:10940")["PRIORITY"] == "2"
        assert scipd.process.wait(PATIENCE_S) == 1
    with tempfile.TemporaryDirectory(dir=folder) as life, Journal() as journal, \
            start(program, scenes, life, seed="no number") as scipd:
        assert journal.find("service.yaml:1: seed: ")["PRIORITY"] == "2"
        assert scipd.process.wait(PATIENCE_S) == 2 and scipd.log() == "", scipd.log()


def logs_text_where_standard_error_is_something_else(program, scenes, folder):
    for how in ({"stream": "1:2"}, {"journal": False}):
        with Journal() as journal, tempfile.TemporaryDirectory(dir=folder) as life, \
                start(program, scenes, life, tcp="0.0.0.0:0", **how) as scipd:
            scipd.ready()
            scipd.process.terminate()
            assert scipd.process.wait(PATIENCE_S) == 0
            assert " warning rescue/front listens on 0.0.0.0:" in scipd.log(), scipd.log()
            journal.socket.setblocking(False)
            try:
                raise AssertionError(journal.socket.recv(65536))
            except BlockingIOError:
                pass


def logs_json_where_that_is_asked_for(program, scenes, folder):
    with Journal(), start(program, scenes, folder, "--log-format", "json", tcp="0.0.0.0:0") as scipd:
        scipd.ready()
        scipd.process.terminate()
        assert scipd.process.wait(PATIENCE_S) == 0
        assert '"level":"warning"' in scipd.log(), scipd.log()


def goes_on_without_a_journal(program, scenes, folder):
    with start(program, scenes, folder) as scipd:
        scipd.ready()
        assert scipd.reload().startswith("1 sensor ")
    with tempfile.TemporaryDirectory(dir=folder) as life, start(program, scenes, life, tcp="192.0.2.1:1") as scipd:
        assert scipd.process.wait(PATIENCE_S) == 1
        assert scipd.log().startswith("cannot listen on 192.0.2.1:1: "), scipd.log()


def enter_namespace():
    """Runs this test again where nobody else sees what it mounts."""
    command = ["unshare", "--mount", *([] if os.geteuid() == 0 else ["--map-root-user"])]
    try:
        subprocess.run([*command, "mount", "-t", "tmpfs", "journal", "/run"], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError) as error:
        print("no mount namespace can be had here:", getattr(error, "stderr", error))
        sys.exit(SKIPPED)
    os.environ[INSIDE] = "1"
    os.execvp("unshare", [*command, sys.executable, *sys.argv])


def main():
    if INSIDE not in os.environ:
        enter_namespace()
    subprocess.run(["mount", "-t", "tmpfs", "journal", "/run"], check=True)
    os.makedirs(os.path.dirname(JOURNAL))
    tests = [logs_entries_with_fields, says_there_why_it_cannot_start,
             logs_text_where_standard_error_is_something_else, logs_json_where_that_is_asked_for,
             goes_on_without_a_journal]
    for test in tests:
        with tempfile.TemporaryDirectory(prefix="scipd-journal-") as folder:
            run_all([test], sys.argv[1], pathlib.Path(sys.argv[2]), folder)


if __name__ == "__main__":
    main()
