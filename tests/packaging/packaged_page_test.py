#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
What the package and the container run has the live page, on loopback: packaged_page_test.py SCIPD SOURCES. Ports are
free ones here, and the worlds those of the sources.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import urllib.request

SCIPD, SOURCES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
LOOPBACK = "127.0.0.1:"


def here(text):
    """With the worlds of the sources, and free ports."""
    return re.sub(r":(10940|10980)\b", ":0", text.replace("/usr/share/scipd/scenes", str(SOURCES / "scenes")))


def check_page(*options):
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen([SCIPD, *options], stdout=subprocess.PIPE, text=True,
                                   env={"RUNTIME_DIRECTORY": folder})
        try:
            ready = json.loads(process.stdout.readline())
            assert ready["http"].startswith(LOOPBACK), ready
            with urllib.request.urlopen(f"http://{ready['http']}/", timeout=60) as page:
                assert b"<title>scipd" in page.read(), options
        finally:
            process.terminate()
            process.wait(60)


def main():
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "scipd.yaml"
        file.write_text(here((SOURCES / "packaging/scipd/scipd.yaml").read_text()))
        check_page("--config", file)
    command = re.search(r"^CMD (\[.*?\])$", (SOURCES / "Containerfile").read_text(), re.MULTILINE | re.DOTALL)[1]
    check_page(*json.loads(here(command.replace("\\\n", ""))))


main()
