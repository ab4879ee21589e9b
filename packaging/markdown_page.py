# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
A page of docs/ as the body of a man page. It knows what these pages have: headings, paragraphs, lists, fenced blocks
and tables. A row of a table becomes an entry: its first cell is the title, and the others follow.
"""
import re

import roff

# How some columns begin in an entry.
BEGINS = {"default": "Default: ", "example": "Example: "}


def cells(row):
    """A bar within `code` is no border."""
    parts = re.findall(r"((?:``.*?``|`[^`]*`|[^|`])*)\|", row.strip().removeprefix("|"))
    return [part.strip() for part in parts]


def table(rows):
    titles = cells(rows[0])
    lines = []
    for row in rows[2:]:
        first, *others = cells(row)
        text = []
        for title, cell in zip(titles[1:], others):
            if cell:
                sentence = BEGINS.get(title, "") + cell
                text.append(sentence if sentence.endswith(".") else sentence + ".")
        lines += roff.item(roff.inline(first), "\n".join(text))
    return lines


def listed(lines):
    """Lines of a list; one that is indented goes on with the item above."""
    entries = []
    for line in lines:
        if line.startswith("- "):
            entries.append(line[2:])
        else:
            entries[-1] += " " + line.strip()
    written = []
    for entry in entries:
        written += [".IP \\(bu 2", *roff.sentences(entry)]
    return written


def block(lines):
    """What stands between two empty lines."""
    first = lines[0]
    if first.startswith("#"):
        return [f".SH {roff.escaped(first.lstrip('# ').replace('`', ''))}"]
    if first.startswith("|"):
        return table(lines)
    if first.startswith("- "):
        return listed(lines)
    if first.startswith("<!--"):
        return block(lines[1:]) if lines[1:] else []
    return roff.paragraph(" ".join(lines))


def blocks(page):
    """Lists of lines; a fenced block is (None, lines)."""
    lines, fenced = [], None
    for line in [*page.splitlines(), ""]:
        if line.startswith("```"):
            if fenced is not None:
                yield None, fenced
            fenced = [] if fenced is None else None
        elif fenced is not None:
            fenced.append(line)
            continue
        if line and not line.startswith("```"):
            lines.append(line)
        elif lines:
            yield True, lines
            lines = []


def body(page):
    written = []
    for is_text, lines in list(blocks(page))[1:]:  # without the title
        written += block(lines) if is_text else roff.verbatim(lines)
    return written
