#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Runs tests of the package `scipd` with Debian's pytest: run.py SCIPD FILE... Where there is none, it says so and ends
# with 77.
import os
import pathlib
import subprocess
import sys

SKIPPED = 77
ROOT = pathlib.Path(__file__).resolve().parents[2]


def python_with_pytest():
    """This one, or Debian's where this is another."""
    for python in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import pytest"], capture_output=True, check=False).returncode == 0:
            return python
    print("skipped: there is no pytest (apt-get install python3-pytest)")
    sys.exit(SKIPPED)


def main(scipd, *files):
    # The plugins of this machine, and a scipd that is installed there, have no say in it.
    environment = {**os.environ, "SCIPD": scipd, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTHONDONTWRITEBYTECODE": "1",
                   "PATH": f"{pathlib.Path(scipd).parent}:{os.environ['PATH']}",
                   "PYTHONPATH": str(ROOT / "python" / "src")}
    done = subprocess.run([python_with_pytest(), "-m", "pytest", "-q", "-p", "no:cacheprovider",
                           "--scipd-keep=scipd-failed", *files], env=environment, check=False)
    sys.exit(done.returncode)


main(*sys.argv[1:])
