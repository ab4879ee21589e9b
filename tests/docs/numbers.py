# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# How many products and firmwares pages name is how many scipd lists: numbers.py SCIPD SOURCES
import pathlib
import re
import subprocess
import sys

import links


def main():
    scipd, sources = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    listed = subprocess.run([scipd, "--list-models"], capture_output=True, text=True, check=True, timeout=60).stdout
    models = set(re.findall(r"^\S+@\S+", listed, flags=re.MULTILINE))
    true = {"products": len({model.split("@")[0] for model in models}), "firmwares": len(models)}
    found = [(page.relative_to(sources), int(number), what) for page in links.pages_of(sources)
             for number, what in re.findall(r"(\d+) (products|firmwares)", page.read_text())]
    wrong = [f"{page}: {number} {what}, not {true[what]}" for page, number, what in found if number != true[what]]
    print(*wrong, f"{len(found)} numbers, {len(wrong)} faults", sep="\n")
    sys.exit(bool(wrong) or {what for _, _, what in found} != set(true))


main()
