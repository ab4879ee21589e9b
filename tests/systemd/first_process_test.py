# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# scipd as the first process of a container, where the kernel lets it ignore signals that it does not handle:
# first_process_test.py SCIPD SCENES
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile

from manager import PATIENCE_S

SKIPPED = 77


def namespace():
    """The command that makes one, in which the program that follows is the first process."""
    command = ["unshare", "--pid", "--fork", "--kill-child", *([] if os.geteuid() == 0 else ["--map-root-user"])]
    try:
        subprocess.run([*command, "true"], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError) as error:
        print("no namespace of processes can be had here:", getattr(error, "stderr", error))
        sys.exit(SKIPPED)
    return command


def ends_while_it_loads(inside, scipd, scenes, number, folder):
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as told:
        told.bind(f"{folder}/notify")
        told.settimeout(PATIENCE_S)
        environment = {**os.environ, "RUNTIME_DIRECTORY": folder, "NOTIFY_SOCKET": f"{folder}/notify"}
        arguments = ["--scene", scenes / "depot.sdf", "--tcp", "127.0.0.1:0", "--pty", "none"]
        outside = subprocess.Popen([*inside, scipd, *arguments], env=environment, stdout=subprocess.DEVNULL)
        try:
            while b"STATUS=loads" not in told.recv(65536):
                pass
            first = pathlib.Path(f"/proc/{outside.pid}/task/{outside.pid}/children").read_text().split()[0]
            os.kill(int(first), number)
            # 0: it was ready before the signal came.
            assert outside.wait(PATIENCE_S) in (0, 128 + number), outside.returncode
        finally:
            outside.kill()  # and what is in its namespace


command = namespace()
for wanted in (signal.SIGTERM, signal.SIGINT):
    with tempfile.TemporaryDirectory(prefix="scipd-first-") as run_directory:
        ends_while_it_loads(command, sys.argv[1], pathlib.Path(sys.argv[2]), wanted, run_directory)
