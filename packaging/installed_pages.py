#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
Writes the pages that are installed: installed_pages.py SOURCES SHARE. SHARE is what becomes share/ of the prefix. Links
lead to where things are installed. One to what is only in the sources becomes text that says so.
"""
import os
import pathlib
import re
import sys

# Where what lies there in the sources is installed, below share/.
PLACES = {"README.md": "doc/scipd/README.md", "docs": "doc/scipd/docs", "scenes": "scipd/scenes"}
LINK = re.compile(r"\[((?:[^\[\]]|\[[^\]]*\])*)\]\((?!\w+:|#)([^)\s#]+)(#[^)\s]*)?\)")


def installed(path):
    """Where a file or folder of the sources is installed, or None."""
    for source, place in PLACES.items():
        inside = pathlib.PurePath(path).is_relative_to(source)
        if inside and not path.endswith(".py"):
            return os.path.normpath(os.path.join(place, os.path.relpath(path, source)))
    return None


def rewritten(link, page):
    text, target, heading = link.group(1, 2, 3)
    path = os.path.normpath(os.path.join(os.path.dirname(page), target))
    place = installed(path)
    if place:
        there = os.path.relpath(place, os.path.dirname(installed(page)))
        return f"[{text}]({there}{'/' if target.endswith('/') else ''}{heading or ''})"
    text = text.removeprefix("../")
    return text if text.strip("`").rstrip("/") in path else f"{text} (`{path}` in the sources)"


def installed_text(text, page):
    """Fenced blocks have no links."""
    parts = re.split(r"(^```.*?^```)", text, flags=re.MULTILINE | re.DOTALL)
    parts[::2] = [LINK.sub(lambda link: rewritten(link, page), part) for part in parts[::2]]
    return "".join(parts)


def main():
    sources, share = map(pathlib.Path, sys.argv[1:])
    for source in PLACES:
        place = sources / source
        for file in [place] if place.is_file() else sorted(place.rglob("*.md")):
            page = str(file.relative_to(sources))
            to = share / installed(page)
            to.parent.mkdir(parents=True, exist_ok=True)
            to.write_text(installed_text(file.read_text(), page))


main()
