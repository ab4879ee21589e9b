#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
What tools/run prints, and what it hands to scipd: run_test.py SOURCES. The programs that it calls are stand-ins.
"""
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile

SOURCES = pathlib.Path(sys.argv[1])
CHATTER = "for i in $(seq 900); do echo Unpacking $i; done\n"


class Tree:
    """A copy of the scripts, beside programs that stand in for those they call."""

    def __init__(self, folder):
        self.root = folder
        self.programs = folder / "stand-ins"
        self.programs.mkdir()
        (folder / "tools").mkdir()
        for name in ("run", "install"):
            shutil.copy(SOURCES / "tools" / name, folder / "tools")
        self.program("dpkg-query", "exit 1\n")
        self.program("sudo", 'exec "$@"\n')
        self.program("apt-get", CHATTER)
        self.program("apt-cache", "exit 0\n")
        scipd = "build/release/bin/scipd"
        self.program("cmake", "if [[ $1 == --preset ]]; then echo '-- Looking for Embree'; fi\n"
                              "mkdir -p build/release/bin\ntouch build/release/build.ninja\n"
                              f"printf '#!/bin/sh\\necho \"$@\"\\n' >{scipd}\nchmod +x {scipd}\n")

    def program(self, name, script):
        file = self.programs / name
        file.write_text(f"#!/bin/bash\n{script}")
        file.chmod(0o755)

    def run(self, *options):
        """(exit code, what it hands to scipd, what it prints besides)"""
        environment = {**os.environ, "PATH": f"{self.programs}:{os.environ['PATH']}"}
        done = subprocess.run([self.root / "tools/run", *options], cwd=self.root, env=environment, capture_output=True,
                              text=True, timeout=60, check=False)
        return done.returncode, done.stdout.strip(), done.stderr

    def handed(self, *options):
        code, handed, said = self.run(*options)
        assert code == 0, said
        return handed


def check_what_it_prints(tree):
    code, handed, said = tree.run()
    assert code == 0, said
    drive = "scenes/rescue_maze.tum"
    assert handed.startswith(f"--poses {tree.root / drive} --http 127.0.0.1:") and (SOURCES / drive).exists(), handed
    assert len(said.splitlines()) < 5 and "Unpacking" not in said and "Looking for" not in said, said
    assert "Unpacking 900" in (tree.root / "build/install.log").read_text()


def check_what_it_prints_of_a_failure(tree):
    tree.program("apt-get", f"{CHATTER}echo 'E: Unable to locate package' >&2\nexit 100\n")
    code, _, said = tree.run()
    assert code != 0
    assert "E: Unable to locate package" in said and str(tree.root / "build/install.log") in said, said
    assert len(said.splitlines()) < 30, said
    tree.program("apt-get", CHATTER)


def check_that_it_has_a_page(tree):
    with socket.socket() as taken:
        taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            taken.bind(("127.0.0.1", 8080))
        except OSError:
            pass  # somebody else has it
        taken.listen()
        assert tree.handed("--seed", "7") == "--seed 7 --http 127.0.0.1:0"
    page = " --http 127.0.0.1:"
    silent, spoken = tree.root / "silent.yaml", tree.root / "spoken.yaml"
    silent.write_text("# http: none\nscene: room.sdf\n")
    spoken.write_text("scene: room.sdf\nhttp: 127.0.0.1:9000\n")
    for options in (["--pose", "4.2,9,0.5"], ["--config", silent], [f"--config={silent}"]):
        said = " ".join(map(str, options))
        assert tree.handed(*options).startswith(said + page), options
    for options in (["--http", "127.0.0.1:9000"], ["--http=none"], ["--config", spoken], ["--check", silent],
                    ["--list-models"], ["--probe"], ["--help"], ["--version"], ["--completion", "bash"]):
        assert tree.handed(*options) == " ".join(map(str, options)), options


def main():
    with tempfile.TemporaryDirectory() as folder:
        tree = Tree(pathlib.Path(folder))
        check_what_it_prints(tree)
        check_what_it_prints_of_a_failure(tree)
        check_that_it_has_a_page(tree)


main()
