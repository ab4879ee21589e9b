# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""Text in the language of man pages, man(7)."""
import os
import re
import textwrap
import time


def escaped(text):
    """Letters as they are."""
    return text.replace("\\", "\\e").replace("-", "\\-")


def folded(line):
    """Pieces of at most 80 letters, as man pages want them. None begins like a request."""
    pieces = textwrap.wrap(line, 78, break_long_words=False, break_on_hyphens=False)
    return [re.sub(r"^(['.])", r"\\&\1", piece) for piece in pieces]


def inline(text):
    """A sentence of Markdown: `code` and **bold** become bold, links their text."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    parts = re.split(r"(`[^`]+`|\*\*[^*]+\*\*)", text)
    marked = [f"\\fB{escaped(part.strip('`*'))}\\fR" if part[:1] in "`*" and part[1:] else escaped(part)
              for part in parts if part]
    return "".join(marked)


def paragraph(text):
    return [".PP", *sentences(text)]


def sentences(text):
    """Marked text; every sentence begins a line, as man pages want it."""
    lines = re.sub(r"(?<=[a-z0-9`)][.?!]) +(?=[A-Z`])", "\n", text).split("\n")
    return [short for line in lines for short in folded(inline(line.strip()))]


def item(title, text):
    return [".TP", title, *(sentences(text) or ["\\ "])]


def verbatim(lines):
    return [".PP", ".in +4n", ".nf", *[re.sub(r"^(['.])", r"\\&\1", escaped(line)) for line in lines], ".fi", ".in"]


def page(name, section, version, body):
    """A paragraph right below a heading needs no request."""
    body = [line for above, line in zip(["", *body], body)
            if not (line == ".PP" and above.startswith((".SH", ".SS")))]
    # It dates a build that others shall repeat byte for byte.
    date = time.strftime("%Y-%m-%d", time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))))
    title = f'.TH "{name.upper()}" "{section}" "{date}" "scipd {version}" "scipd"'
    written = ".\\\" Generated from the program's own texts and docs/: do not edit."
    return "\n".join([written, title, *body]) + "\n"
