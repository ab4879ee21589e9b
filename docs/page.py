# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What the scripts that write pages of docs/ share.
import difflib
import re
import sys
import textwrap


def wrapped(text, indent=""):
    """Lines of at most 118 columns; what stands between backticks stays in one of them."""
    whole = re.sub("`[^`]*`", lambda code: code.group().replace(" ", "\0"), text)
    filled = textwrap.fill(whole, 118, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
    return filled.replace("\0", " ")


def write_or_check(file, text, command, check):
    if not check:
        file.write_text(text)
        return
    old = file.read_text() if file.exists() else ""
    if old != text:
        sys.stdout.writelines(
            difflib.unified_diff(old.splitlines(True), text.splitlines(True), str(file), "as it must be"))
        sys.exit(f"{file} is out of date: run {command}")
    print(f"{file} is up to date")
