# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# All pages hang together: links.py SOURCES. Each relative link of a page leads to a file, and to a heading of it where
# the link names one. Each page of docs/ is in its table of contents. A page that runs scipbench, which tools/run does
# not build, says how it is built or leads there. README.md stays short, and so does what CHANGELOG.md says of a
# release.
import pathlib
import re
import sys

MOST_WORDS = 1200
MOST_COLUMNS = 120
SKIPPED_FOLDERS = {"build", ".git"}


def pages_of(sources):
    return [page for page in sorted(sources.rglob("*.md")) if page.relative_to(sources).parts[0] not in SKIPPED_FOLDERS]


def text_of(page):
    """Without what stands in fences."""
    return re.sub(r"^```.*?^```", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)


def anchors_of(page):
    titles = re.findall(r"^#+ (.*)$", text_of(page), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}


def links_of(page):
    """Relative ones, as (file, heading)."""
    for target in re.findall(r"\]\(([^)\s]+)\)", text_of(page)):
        if not re.match(r"\w+:", target):
            name, _, heading = target.partition("#")
            yield target, (page.parent / name).resolve() if name else page, heading


def link_faults(sources):
    for page in pages_of(sources):
        for target, file, heading in links_of(page):
            if not file.exists():
                yield f"{page.relative_to(sources)}: {target} leads nowhere"
            elif heading and heading not in anchors_of(file):
                yield f"{page.relative_to(sources)}: {target}: no such heading"


def content_faults(sources):
    listed = {file for _, file, _ in links_of(sources / "docs/README.md")}
    for page in sorted((sources / "docs").glob("*.md")):
        if page.name != "README.md" and page not in listed:
            yield f"docs/README.md does not list {page.name}"


def scipbench_faults(sources):
    for page in pages_of(sources):
        text = page.read_text()
        if re.search(r"^(\$ )?scipbench ", text, re.MULTILINE):
            if not re.search(r"tools\.md#scipbench|--target scipbench|-DSCIPD_TESTS=ON", text):
                yield f"{page.relative_to(sources)}: does not say how scipbench is built"


def readme_faults(sources):
    text = (sources / "README.md").read_text()
    if len(text.split()) > MOST_WORDS:
        yield f"README.md has {len(text.split())} words, more than {MOST_WORDS}: move something to docs/"
    for number, line in enumerate(text.splitlines(), 1):
        if len(line) > MOST_COLUMNS:
            yield f"README.md:{number}: has {len(line)} columns, more than {MOST_COLUMNS}"


def release_faults(sources):
    """The version of the sources has its section."""
    version = re.search(r"project\(scipd VERSION ([\d.]+)", (sources / "CMakeLists.txt").read_text())[1]
    _, *releases = re.split(r"^## ", (sources / "CHANGELOG.md").read_text(), flags=re.MULTILINE)
    if not any(release.startswith(f"{version}\n") for release in releases):
        yield f"CHANGELOG.md has no section {version}"
    for release in releases:
        if len(release.split()) > MOST_WORDS:
            yield f"CHANGELOG.md says more than {MOST_WORDS} words of {release.splitlines()[0]}: shorten it"


def main():
    sources = pathlib.Path(sys.argv[1]).resolve()
    faults = [*link_faults(sources), *content_faults(sources), *scipbench_faults(sources), *readme_faults(sources),
              *release_faults(sources)]
    print("\n".join(faults))
    print(f"{len(pages_of(sources))} pages, {len(faults)} faults")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
