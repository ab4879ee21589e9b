#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""
Writes a man page.

  make_man.py program PROGRAM VERSION OUT     from what it prints with --help; scipd's also from docs/running.md
  make_man.py page docs/NAME.md VERSION OUT   from a page of the documentation; OUT is scipd.yaml.5
"""
import itertools
import pathlib
import re
import sys

import markdown_page
import roff
from help_text import read_help

RUNNING = pathlib.Path(__file__).parents[1] / "docs/running.md"
OTHERS = [("scipd", 1), ("scipctl", 1), ("scipcat", 1), ("scipfit", 1), ("scipbench", 1), ("scipd.yaml", 5)]


def see_also(name):
    others = [f"\\fB{roff.escaped(other)}\\fR({section})" for other, section in OTHERS if other != name]
    return [".SH SEE ALSO", ", ".join(others),
            *roff.paragraph("The whole documentation is in `/usr/share/doc/scipd`.")]


def short(name, what):
    """What apropos shows: the first sentence, without its subject."""
    first = re.split(r"\.(\s|$)", what)[0].removeprefix(f"{name} is ")
    return first[:1].lower() + first[1:]


def option_lines(help_):
    lines = []
    for title, entries in help_.groups.items():
        if title not in ("Options", "Positionals"):
            lines += [f".SS {title}"]
        for entry in entries:
            names, _, value = entry.name.partition(" ")
            typed = re.sub("([^,]+)", lambda name: f"\\fB{roff.escaped(name[1])}\\fR", names)
            lines += roff.item(f"{typed} {roff.escaped(value)}".strip(), entry.what)
    return lines


def footer_lines(footer):
    """Examples stand as they are typed. Other lines run on, up to a blank one or to one that ends a sentence."""
    lines = []
    for typed, group in itertools.groupby(footer, lambda line: line.startswith("  ")):
        if typed:
            lines += roff.verbatim(group)
            continue
        for said in filter(str.strip, re.split(r"(?<=\.)\n|\n\n", "\n".join(group))):
            lines += roff.paragraph(" ".join(said.split()))
    return lines


def command_lines(help_):
    lines = [f".SS {roff.escaped(help_.usage.rstrip())}", *roff.sentences(help_.what)]
    lines += option_lines(help_) + footer_lines(help_.footer)
    for command in help_.commands:
        lines += command_lines(command)
    return lines


def running_lines():
    """What docs/running.md says that --help does not."""
    page = RUNNING.read_text()
    lines = []
    for title, sections in [("SIGNALS", ["Reload", "Stop"]), ("FILES", ["Files"]), ("ENVIRONMENT", ["Environment"])]:
        lines += [f".SH {title}"]
        for section in sections:
            text = page.partition(f"\n## {section}\n")[2].partition("\n## ")[0]
            assert text, f"docs/running.md has no section {section}"
            lines += markdown_page.body("# \n\n" + text)
    return lines


def program_page(program, version):
    name = pathlib.Path(program).name
    help_ = read_help(program, name=name)
    body = [".SH NAME", f"{name} \\- {roff.escaped(short(name, help_.what))}",
            ".SH SYNOPSIS", *[f".B {roff.escaped(help_.usage)}"],
            ".SH DESCRIPTION", *roff.sentences(help_.what),
            ".SH OPTIONS", *option_lines(help_)]
    if help_.commands:
        body += [".SH COMMANDS"]
        for command in help_.commands:
            body += command_lines(command)
    if name == "scipd":
        body += running_lines()
    body += [".SH NOTES", *footer_lines(help_.footer), *see_also(name)]
    return roff.page(name, 1, version, body)


def documentation_page(source, version, out):
    name, section = out.name.rsplit(".", 1)
    body = [".SH NAME", f"{name} \\- configuration of scipd",
            ".SH DESCRIPTION", *markdown_page.body(source.read_text()), *see_also(name)]
    return roff.page(name, section, version, body)


def main():
    kind, source, version, out = sys.argv[1:5]
    out = pathlib.Path(out)
    if kind == "program":
        out.write_text(program_page(source, version))
    else:
        out.write_text(documentation_page(pathlib.Path(source), version, out))


if __name__ == "__main__":
    main()
