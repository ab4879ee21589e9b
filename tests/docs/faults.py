# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Holds docs/faults.md against scipd: faults.py SCIPD SOURCES
#
# The tables under ### have a row for each kind and each member that `GET /faults/kinds` tells, in the table of its
# layer, and no others. scipd takes the example of each kind. Those that are over at once are called momentary.
import http.client
import json
import pathlib
import re
import socket
import subprocess
import sys
import tempfile

import yaml

PATIENCE_S = 60


class Control(http.client.HTTPConnection):
    def __init__(self, path):
        super().__init__("localhost", timeout=PATIENCE_S)
        self.path = path

    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX)
        self.sock.settimeout(self.timeout)
        self.sock.connect(self.path)

    def ask(self, method, target, body=None):
        self.request(method, target, body)
        answer = self.getresponse()
        return answer.status, answer.read().decode()


def code_of(cell):
    span = re.fullmatch(r"`(.+)`", cell.strip())
    return span.group(1) if span else ""


def rows_of(page):
    """(layer, kind, member or "", what it is)"""
    layer = kind = ""
    for line in page.read_text().splitlines():
        if line.startswith("#"):
            layer = line[4:].lower() if line.startswith("### ") else ""
        elif layer and line.startswith("| ") and not line.startswith("| kind |"):
            cells = re.split(r" *\| *", line)[1:-1]
            kind = code_of(cells[0]) or kind
            yield layer, kind, code_of(cells[1]), cells[2]


def examples_of(page):
    """(kind, fault): the example of each kind."""
    for _, kind, member, what in rows_of(page):
        found = None if member else re.search(r"`(\{.+\})`", what)
        if found:
            yield kind, yaml.safe_load(found.group(1))


def example_fails(control, kind, what):
    example = re.search(r"`(\{.+\})`", what)
    if not example:
        return f"{kind} has no example"
    fault = yaml.safe_load(example.group(1))
    if fault["kind"] != kind:
        return f"the example of {kind} is one of {fault['kind']}"
    status, said = control.ask("POST", "/sensors/robot/scanner/faults", json.dumps(fault))
    return f"the example of {kind} gets {status}: {said}" if status != 201 else None


def failures_of(control, rows):
    kinds = json.loads(control.ask("GET", "/faults/kinds")[1])
    known = {(kind["layer"], kind["kind"], member) for kind in kinds for member in ["", *kind["members"]]}
    documented = [row[:3] for row in rows]
    for row in known ^ set(documented):
        yield f"documented or known, but not both: {', '.join(row)}"
    for row in documented:
        if documented.count(row) > 1:
            yield f"more than one row: {', '.join(row)}"
    momentary = {kind["kind"] for kind in kinds if kind["momentary"]}
    for _, kind, member, what in rows:
        if member == "":
            yield example_fails(control, kind, what)
            if ("momentary" in what) != (kind in momentary):
                yield f"whether {kind} is momentary is wrong"


def main():
    scipd, sources = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    rows = list(rows_of(sources / "docs/faults.md"))
    with tempfile.TemporaryDirectory() as folder:
        control = f"{folder}/control.sock"
        server = subprocess.Popen([scipd, "--scene", sources / "scenes/square_room.sdf", "--tcp", "127.0.0.1:0",
                                   "--pty", f"{folder}/tty", "--control", control], stdout=subprocess.PIPE)
        try:
            if not server.stdout.readline():
                sys.exit("scipd did not start")
            failures = [failure for failure in failures_of(Control(control), rows) if failure]
        finally:
            server.terminate()
            server.wait(PATIENCE_S)
    print("\n".join(failures))
    print(f"{len(rows)} rows, {len(failures)} failures")
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
