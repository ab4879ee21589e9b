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

For each figure scipd says how sure it is:

| word | meaning |
|---|---|
| seen | somebody saw it on the wire of a real unit |
| documented | the maker documents it, or a driver whose author had a unit |
| deduced | it follows from the figures of a similar model |

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
ERRORS = """
## Errors

How well the curves are known that make a range wrong. *Light* is the spot of a beam, the wavelength, and how dark a
target the scanner still sees. A curve that no source is named for in `daemon/models/product_lines.h` is assumed;
[errors.md](errors.md) says what each curve does.

"""
LINE = re.compile(r"(\S+)  (\S+) mm \((\w+)\), steps (.+) \((\w+)\), (\S+ Hz) \((\w+)\); (.+) \((\w+)\); "
                  r"(.+) \((\w+)\); texts (\w+), noise (\w+), "
                  r"bias (\w+), light (\w+)")


def models_page(scipd):
    said = subprocess.run([scipd, "--list-models"], capture_output=True, text=True, check=True).stdout
    models = []
    for line in said.splitlines():
        match = LINE.fullmatch(line)
        if not match:
            sys.exit(f"docs/make_models.py does not understand: {line}")
        models.append(match.groups())
    text = HEAD
    for name, range_mm, range_sure, steps, steps_sure, rate, rate_sure, *_ in models:
        text += f"| {name} | {range_mm} | {range_sure} | {steps} | {steps_sure} | {rate} | {rate_sure} |\n"
    text += OUTSIDE
    text += "\n## Wire\n\n| model | links | | commands | | texts |\n|---|---|---|---|---|---|\n"
    for model in models:
        links, links_sure, commands, commands_sure, texts = model[7:12]
        text += f"| {model[0]} | {links} | {links_sure} | {commands} | {commands_sure} | {texts} |\n"
    text += ERRORS + "| model | noise | bias and drift | light |\n|---|---|---|---|\n"
    for model in models:
        text += "| " + " | ".join([model[0], *model[12:]]) + " |\n"
    sure = [word for model in models for word in model[12:]]
    text += f"\nOf these {len(sure)} entries {sure.count('deduced')} are deduced or assumed.\n"
    return text + "\n[protocol.md](protocol.md) says what the commands do.\n"


page.write_or_check(pathlib.Path(__file__).parent / "models.md", models_page(sys.argv[1]),
                    "docs/make_models.py SCIPD", check="--check" in sys.argv)
