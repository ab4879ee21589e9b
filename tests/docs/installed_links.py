# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Each relative link of an installed page leads to an installed file, and to a heading of it: installed_links.py BUILD
import pathlib
import subprocess
import sys
import tempfile

import links

FEWEST_PAGES = 25


def main():
    with tempfile.TemporaryDirectory() as folder:
        install = ["cmake", "--install", sys.argv[1], "--prefix", folder, "--component", "scipd"]
        subprocess.run(install, stdout=subprocess.DEVNULL, check=True, timeout=60)
        tree = pathlib.Path(folder).resolve()
        faults = list(links.link_faults(tree))
        pages = len(links.pages_of(tree))
    print("\n".join(faults))
    print(f"{pages} installed pages, {len(faults)} faults")
    sys.exit(bool(faults) or pages < FEWEST_PAGES)


main()
