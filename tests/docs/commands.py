# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Runs every command of README.md and docs/ as a reader would: commands.py BIN SOURCES [PAGE...]
#
# The commands stand in fenced `sh` and `console` blocks. A line of `sh` is a command. In a `console` block `$ ` begins
# a command, and its output must be what follows. A scipd that serves runs until the page starts another one. `export`
# holds for the rest of the page. A comment right above a block says what is special about it:
#   <!-- not run: WHY -->        the commands cannot be run here
#   <!-- beside: scipd ... -->   this scipd runs meanwhile
#   <!-- ends with 2 -->         the exit code of each command
#   <!-- file: NAME -->          the block is no commands, but this file
#   <!-- if built in: COMMAND --> they are run unless this one says that scipd was built without an optional part
# A drive is played in the world of its name, in which it meets no wall.
# Each page has a network namespace and an empty folder of its own, so that ports and names are free. What a command
# calls /tmp is in that folder.
import concurrent.futures
import contextlib
import dataclasses
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

SKIPPED = 77
COMMAND_S = 60
READY_S = 60
INSIDE = "SCIPD_DOCS_NAMESPACE"
SERVES = re.compile(r"(^|\|\s*)(\w+=\S+ )*scipd(?!.*--(check|map|list-models|list-backends|probe|help|version))\b")
DRIVE = re.compile(r"(?:pose play|--poses) (?:scenes/)?(\w+)\.tum")
MARKER = re.compile(r"<!-- (not run|beside|ends with|file|if built in):? (.*?) -->")
NOT_BUILT_IN = "was built without"


class Failure(Exception):
    pass


@dataclasses.dataclass
class Block:
    line: int
    language: str
    marker: tuple
    text: list

    def commands(self):
        """Each with its line and what it must print; None: anything."""
        line, commands = self.line, []
        for text in self.text:
            line += 1
            if self.language == "console" and not text.startswith("$ "):
                commands[-1][2].append(text)
            elif commands and commands[-1][1].endswith("\\"):
                commands[-1][1] = commands[-1][1][:-1] + text
            elif self.language == "console":
                commands.append([line, text[2:], []])
            elif text.strip() and not text.startswith("#"):
                commands.append([line, text, None])
        return commands


def blocks_of(page):
    found, block, above = [], None, ""
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if block:
            if line.startswith("```"):
                found.append(block)
                block, above = None, ""
            else:
                block.text.append(line)
        elif line.startswith("```"):
            marker = MARKER.fullmatch(above)
            block = Block(number, line[3:], marker.groups() if marker else ("", ""), [])
        else:
            above = line
    return found


class Reader:
    """Somebody who types what one page says."""

    def __init__(self, folder, programs, sources):
        self.folder = folder
        self.server = None
        for name in ("python", "scenes", "tests"):
            (folder / name).symlink_to(sources / name)
        for name in ("docs", "run", "tmp"):
            (folder / name).mkdir(mode=0o700)
        self.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "HOME": str(folder),
                            "XDG_RUNTIME_DIR": str(folder / "run"), "PYTHONDONTWRITEBYTECODE": "1"}
        for name in ("RUNTIME_DIRECTORY", "SCIPD", "PYTHONPATH", "PYTEST_ADDOPTS"):
            self.environment.pop(name, None)

    def start(self, command, errors, output):
        return subprocess.Popen(["bash", "-euo", "pipefail", "-c", command.replace("/tmp/", f"{self.folder}/tmp/")],
                                cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL, stdout=output,
                                stderr=errors, text=True, start_new_session=True)

    def serve(self, command):
        self.stop()
        with tempfile.TemporaryFile("w+") as errors:
            self.server = self.start(command, errors, subprocess.PIPE)
            alarm = threading.Timer(READY_S, os.killpg, (self.server.pid, signal.SIGKILL))
            alarm.start()
            line = self.server.stdout.readline()
            alarm.cancel()
            if '"ready":true' not in line:
                errors.seek(0)
                raise Failure(f"was not ready within {READY_S} s\n{line}{errors.read()}")

    def stop(self):
        if self.server is None:
            return
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.server.pid, signal.SIGTERM)
        self.server.wait(READY_S)
        self.server.stdout.close()
        self.server = None

    def run(self, command, code, expected):
        process = self.start(command, subprocess.STDOUT, subprocess.PIPE)
        try:
            output, _ = process.communicate(timeout=COMMAND_S)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            raise Failure(f"did not end within {COMMAND_S} s\n{process.communicate()[0]}") from None
        if process.returncode != code:
            raise Failure(f"ended with {process.returncode}, not {code}\n{output}")
        if expected is not None and output.splitlines() != expected:
            raise Failure(f"printed\n{output}")

    def export(self, command):
        """What it changes holds for all commands that follow."""
        process = self.start(f"{command}\nenv -0", subprocess.STDOUT, subprocess.PIPE)
        output, _ = process.communicate(timeout=COMMAND_S)
        if process.returncode != 0:
            raise Failure(f"ended with {process.returncode}\n{output}")
        self.environment.update(entry.split("=", 1) for entry in output.split("\0") if "=" in entry)

    def lacks(self, command):
        """An optional part."""
        return NOT_BUILT_IN in self.start(command, subprocess.STDOUT, subprocess.PIPE).communicate(timeout=COMMAND_S)[0]

    def check_drive(self, command):
        drive = DRIVE.search(command)
        if drive is None:
            return
        asked = self.start("scipctl status --json", subprocess.STDOUT, subprocess.PIPE)
        world = pathlib.Path(json.loads(asked.communicate(timeout=COMMAND_S)[0])["scene"]).stem
        if world != drive[1]:
            raise Failure(f"is a drive through another world than {world}")

    def follow(self, block):
        what, value = block.marker
        if what == "file":
            (self.folder / value).write_text("\n".join(block.text) + "\n")
        if block.language not in ("sh", "console") or what == "not run":
            return 0
        if what == "if built in" and self.lacks(value):
            return 0
        if what == "beside":
            self.serve(value)
        code = int(value) if what == "ends with" else 0
        commands = block.commands()
        for line, command, expected in commands:
            try:
                if command.startswith("export "):
                    self.export(command)
                elif SERVES.search(command):
                    self.serve(command)
                else:
                    self.run(command, code, expected)
                self.check_drive(command)
            except Failure as failure:
                raise Failure(f"{line}: {command}\n{failure}") from None
        return len(commands)


def follow(page, programs, sources):
    """How many commands were run, and how many were not."""
    run = skipped = 0
    folder = pathlib.Path(tempfile.mkdtemp(prefix="scipd-docs-"))
    reader = Reader(folder, programs, sources)
    try:
        for block in blocks_of(page):
            run += reader.follow(block)
            if block.language in ("sh", "console") and block.marker[0] == "not run":
                skipped += len(block.commands())
                print(f"{page.relative_to(sources)}:{block.line}: not run: {block.marker[1]}")
    finally:
        reader.stop()
        shutil.rmtree(folder)
    return run, skipped


def pages_of(sources):
    folders = ["", "daemon", "docs", "docs/howto", "protocol", "scenes", "scenes/faults", "sim", "tests/bench/results",
               "tests/protocol/dialogues", "tests/soak"]
    pages = [page for folder in folders for page in sorted((sources / folder).glob("*.md"))]
    return [page for page in pages if page.name != "CHANGELOG.md"]


def alone(command):
    """The command in a network namespace of its own, whose loopback it must bring up."""
    return ["unshare", "--map-root-user", "--net", *command]


def follow_alone(page, programs, sources):
    """What there is to say of the page, and (run, not run), or None where it failed."""
    begin = time.monotonic()
    done = subprocess.run(alone([sys.executable, __file__, programs, sources, page]), capture_output=True, text=True,
                          env={**os.environ, INSIDE: "1"}, check=False)
    *said, counts = done.stdout.splitlines() or [""]
    if done.returncode != 0:
        return f"{done.stdout}{done.stderr}", None
    run, skipped = map(int, counts.split())
    if run:
        said.append(f"{page.relative_to(sources)}: {run} commands in {time.monotonic() - begin:.1f} s")
    return "\n".join(said), (run, skipped)


def inside(page, programs, sources):
    subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
    try:
        run, skipped = follow(page, programs, sources)
    except Failure as failure:
        sys.exit(f"{page.relative_to(sources)}:{failure}")
    print(run, skipped)


def main():
    programs, sources, *pages = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    if INSIDE in os.environ:
        return inside(pages[0], programs, sources)
    lo_up = alone(["ip", "link", "set", "lo", "up"])
    if shutil.which("unshare") is None or subprocess.run(lo_up, check=False).returncode != 0:
        print("skipped: this machine lets nobody have a network namespace (unshare --map-root-user --net)")
        sys.exit(SKIPPED)
    # Readers mostly wait.
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        results = list(pool.map(lambda page: follow_alone(page, programs, sources), pages or pages_of(sources)))
    print("\n".join(said for said, _ in results if said))
    counts = [count for _, count in results if count]
    failed = len(results) - len(counts)
    print(f"{sum(run for run, _ in counts)} commands were run, {sum(skipped for _, skipped in counts)} were not; "
          f"{failed} pages failed")
    sys.exit(failed > 0)


main()
