#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Writes docs/models.md from what scipd says of its models: docs/make_models.py SCIPD [--check]. With --check it only
# tells whether they agree.
import pathlib
import re
import subprocess
import sys

import page

HEAD = """# Models

<!-- docs/make_models.py writes this page from `scipd --list-models`: change the models, and run it again. -->

These are the products that scipd can be. `--model` and `model:` take `MODEL`, or `MODEL@FIRMWARE`. Without a firmware
you get the first one of the model.

```sh
scipd --list-models
scipd --model URG-04LX@3.3.00 --tcp 127.0.0.1:0
```

For each figure scipd says how certain it is:

| word | meaning |
|---|---|
| seen | somebody saw it on the wire of a real unit |
| measured | it follows from recordings of real units of this product |
| documented | the maker documents it, or a driver whose author had a unit |
| deduced | it follows from the figures of a similar model |
| assumed | no source is known: it is as with the nearest relative, or of a usual size |

You can change any field of a model, or define one of your own:
[configuration.md](configuration.md#a-model-of-your-own).

## Optics

| model | range, mm | | steps | | scans | |
|---|---|---|---|---|---|---|
"""
OUTSIDE = """
A URG-04LX, URG-04LX-UG01 or UBG-04LX-F01 may also be asked for the steps 0 to 43 and 726 to 768, which it cannot
measure: they read 19. Real units do so, too: two URG-04LX in all of 661 recorded scans. urg_node and urg_node2 ask for
steps 0 to 725, and publish 44 beams of 19 mm; `angle_min: -2.08` and `angle_max: 2.09` leave them out.
"""
TIMES = """
## Codes and times

What a scanner sends in place of a distance, in brackets what comes now and then;
[errors.md](errors.md#causes-and-codes) says what causes which. How long a turn of the mirror really takes, when a scan
leaves after its last step, and how long the scanner boots.

| model | codes | | turn | | a scan leaves | | boot | |
|---|---|---|---|---|---|---|---|---|
"""
ERRORS = """
## Errors

How well the curves are known that make a range wrong. The accuracy of a data sheet bounds the bias of a unit, and is no
noise. *Light* is the spot of a beam, the wavelength, and how dark a target the scanner still sees.
`daemon/models/product_lines.h` names the recordings; [errors.md](errors.md) says what each curve does.

"""
WORDS = {"doc": "documented", "ded": "deduced"}


def tables(scipd):
    """The tables of --list-models, each by model: figures, commands, codes and times, and how all is known."""
    said = subprocess.run([scipd, "--list-models"], capture_output=True, text=True, check=True).stdout
    found = []
    for block in said.split("\n\n"):
        titles, *rows = [re.split(r"  +", line) for line in block.strip().splitlines()]
        if titles[0] == "MODEL":
            found.append({row[0]: dict(zip(titles[1:], row[1:], strict=True)) for row in rows})
    figures, commands, times, sure, sure_of_times = found
    if not all(table.keys() == figures.keys() for table in found):
        sys.exit("docs/make_models.py does not understand what --list-models prints")
    return figures, commands, times, {
        model: {title: WORDS.get(word, word) for title, word in {**row, **sure_of_times[model]}.items()}
        for model, row in sure.items()}


def models_page(scipd):
    figures, commands, times, sure = tables(scipd)
    text = HEAD
    for name, row in figures.items():
        text += (f"| {name} | {row['RANGE mm']} | {sure[name]['RANGE']} | {row['STEPS']} | {sure[name]['STEPS']} "
                 f"| {row['SCANS']} | {sure[name]['SCANS']} |\n")
    text += OUTSIDE
    text += "\n## Wire\n\n| model | links | | commands | | texts |\n|---|---|---|---|---|---|\n"
    for name, row in figures.items():
        text += (f"| {name} | {row['LINKS']} | {sure[name]['LINKS']} | {commands[name]['COMMANDS']} "
                 f"| {sure[name]['COMMANDS']} | {sure[name]['TEXTS']} |\n")
    text += TIMES
    for name, row in times.items():
        text += "| " + " | ".join([name, *(f"{value} | {sure[name][title]}" for title, value in row.items())]) + " |\n"
    text += ERRORS + "| model | noise | bias and drift | light |\n|---|---|---|---|\n"
    curves = {name: [row[title] for title in ("NOISE", "BIAS", "LIGHT")] for name, row in sure.items()}
    for name, words in curves.items():
        text += "| " + " | ".join([name, *words]) + " |\n"
    words = sum(curves.values(), [])
    unsure = words.count("deduced") + words.count("assumed")
    text += f"\nOf these {len(words)} entries {unsure} are deduced or assumed.\n"
    return text + "\n[protocol.md](protocol.md) says what the commands do.\n"


page.write_or_check(pathlib.Path(__file__).parent / "models.md", models_page(sys.argv[1]),
                    "docs/make_models.py SCIPD", check="--check" in sys.argv)
