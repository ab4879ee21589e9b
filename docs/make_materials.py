#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Writes the table of docs/materials.md from scenes/materials.yaml: docs/make_materials.py [--check]. With --check it
# only tells whether they agree.
import pathlib
import sys

import page
import yaml

HERE = pathlib.Path(__file__).parent
BEGIN = "<!-- docs/make_materials.py writes what follows from scenes/materials.yaml. -->\n"
WAVELENGTHS_NM = (785, 830, 905)
NUMBERS = ("specular", "gloss", "retro", "transmission", "roughness", "texture")


def at(reflectance, wavelength_nm):
    """As sim/world/material_library.cpp has it: linear, and constant beyond the ends."""
    known = sorted(reflectance)
    below = [nm for nm in known if nm <= wavelength_nm] or known[:1]
    above = [nm for nm in known if nm >= wavelength_nm] or known[-1:]
    low, high = below[-1], above[0]
    part = 0 if low == high else (wavelength_nm - low) / (high - low)
    return reflectance[low] + part * (reflectance[high] - reflectance[low])


def is_assumed(entry, *names):
    assumed = entry.get("assumed", [])
    return assumed is True or any(name in assumed for name in names)


def shown(number, assumed):
    text = f"{number:.3g}" if number < 1000 else f"{number:.0f}"
    return f"*{text}*" if assumed else text


def cells_of(name, entry):
    reflectance = entry["reflectance"]
    yield f"`{name}`"
    for nm in WAVELENGTHS_NM:
        given = nm if nm in reflectance else min(reflectance, key=lambda other: abs(other - nm))
        yield shown(at(reflectance, nm), is_assumed(entry, "reflectance", given))
    for key in NUMBERS:
        yield shown(entry[key], is_assumed(entry, key)) if key in entry else ""


def counts(entry):
    numbers = [("reflectance", nm) for nm in entry["reflectance"]] + [(key,) for key in NUMBERS if key in entry]
    return len(numbers), sum(is_assumed(entry, *names) for names in numbers)


def table_of(materials):
    numbers = sum(counts(entry)[0] for entry in materials.values())
    assumed = sum(counts(entry)[1] for entry in materials.values())
    text = (f"\nIt has {len(materials)} materials with {numbers} numbers, of which {round(100 * assumed / numbers)} % "
            "are assumed: these stand\n*slanted*. Between two wavelengths of the file the reflectance is interpolated."
            "\n\n"
            "| material | 785 nm | 830 nm | 905 nm | " + " | ".join(NUMBERS) + " |\n" + "|---" * 10 + "|\n")
    for name, entry in materials.items():
        text += "| " + " | ".join(cells_of(name, entry)) + " |\n"
    text += "\n| material | where its numbers come from | other names |\n|---|---|---|\n"
    for name, entry in materials.items():
        aliases = ", ".join(f"`{alias}`" for alias in entry.get("aliases", []))
        text += f"| `{name}` | {entry.get('source', '')} | {aliases} |\n"
    return text


def materials_page():
    library = yaml.safe_load((HERE.parent / "scenes/materials.yaml").read_text())["materials"]
    written, begin, _ = (HERE / "materials.md").read_text().partition(BEGIN)
    if not begin:
        sys.exit(f"docs/materials.md has no line {BEGIN}")
    return written + begin + table_of(library)


page.write_or_check(HERE / "materials.md", materials_page(), "docs/make_materials.py", check="--check" in sys.argv)
