#!/usr/bin/env python3
"""Checks the documentation: links, pictures, anchors, sources that are named, the index, and the keys of the bibliography.

Usage: check_docs.py ROOT. Prints each fault as FILE:LINE: TEXT and exits with 1 when there is one.
"""
import pathlib
import re
import sys

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
MENTION = re.compile(r"\bdocs/[A-Za-z0-9_./-]+\.(?:md|png|svg|json)\b")
KEY = re.compile(r"(?<![\w\])])\[([A-Z][a-z]+)(?: et al\.)?(?: \d[\d.]*(?:, \d[\d.]*)*)?\](?!\()")
SOURCE = re.compile(r"`([\w./-]+\.(?:cpp|h|cmake|sh))`")
CODE = {".h", ".cpp", ".py", ".sh", ".cmake", ".txt"}
FOLDERS_OF_CODE = ["libs", "apps", "bindings", "tests", "bench", "scripts", "cmake", "examples", "packaging"]


def pages(root):
    found = [root / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md") if (root / name).exists()]
    return found + sorted((root / "docs").rglob("*.md"))


def without_code(text):
    """The text with blocks and spans of code blanked, lines kept."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group(0))
    return re.sub(r"`[^`\n]*`", blank, re.sub(r"^```.*?^```", blank, text, flags=re.S | re.M))


def anchors(page):
    """As GitHub makes them of headings."""
    made = set()
    for line in without_code(page.read_text(encoding="utf-8")).splitlines():
        heading = re.match(r"#+\s+(.*)", line)
        if heading:
            made.add(re.sub(r"[^\w\- ]", "", heading.group(1).lower()).strip().replace(" ", "-"))
    return made


def numbered(text):
    return enumerate(text.splitlines(), 1)


def check_links(root, page, faults):
    """Returns the pages that this one leads to."""
    leads_to = set()
    for number, line in numbered(without_code(page.read_text(encoding="utf-8"))):
        for target in LINK.findall(line):
            if re.match(r"[a-z]+:", target):
                continue
            path, _, anchor = target.partition("#")
            there = (page.parent / path).resolve() if path else page
            if not there.exists():
                faults.append(f"{page.relative_to(root)}:{number}: nothing is at {target}")
            elif anchor and anchor not in anchors(there):
                faults.append(f"{page.relative_to(root)}:{number}: no heading makes #{anchor}")
            leads_to.add(there)
    return leads_to


def check_index(root, links, faults):
    index = root / "docs" / "index.md"
    reached, open_ends = set(), [index]
    while open_ends:
        page = open_ends.pop()
        if page not in reached:
            reached.add(page)
            open_ends.extend(links.get(page, ()))
    for page in sorted((root / "docs").rglob("*.md")):
        if page not in reached:
            faults.append(f"{page.relative_to(root)}:1: docs/index.md does not lead here")


def check_mentions(root, faults):
    for folder in FOLDERS_OF_CODE:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in CODE or not path.is_file() or path.name.startswith("check_docs"):
                continue
            for number, line in numbered(path.read_text(encoding="utf-8")):
                for mention in MENTION.findall(line):
                    if not (root / mention).exists():
                        faults.append(f"{path.relative_to(root)}:{number}: there is no {mention}")


def check_sources(root, page, files, faults):
    """A source that a text names is there: `libs/a/src/b.cpp`, or the end of a path, `b.cpp`."""
    for number, line in numbered(page.read_text(encoding="utf-8")):
        for name in SOURCE.findall(line):
            if not any(("/" + path).endswith("/" + name.removeprefix("./")) for path in files.get(pathlib.Path(name).name, ())):
                faults.append(f"{page.relative_to(root)}:{number}: there is no {name}")


def sources_by_name(root):
    files = {}
    for folder in FOLDERS_OF_CODE:
        for path in (root / folder).rglob("*"):
            files.setdefault(path.name, []).append(path.relative_to(root).as_posix())
    return files


def check_keys(root, faults):
    bibliography = (root / "docs" / "bibliography.md").read_text(encoding="utf-8")
    known = set(re.findall(r"\*\*\[([A-Za-z]+)\]\*\*", bibliography))
    texts = [p for p in (root / "docs").rglob("*.md")]
    texts += [p for p in (root / "libs").rglob("*") if p.suffix in {".h", ".cpp"}]
    for path in sorted(texts):
        text = path.read_text(encoding="utf-8")
        if path.suffix == ".md":
            lines = without_code(text).splitlines()
        else:  # comments alone: what stands in brackets elsewhere is code
            lines = [line.partition("//")[2] for line in text.splitlines()]
        for number, line in enumerate(lines, 1):
            for key in KEY.findall(line):
                if key not in known:
                    faults.append(f"{path.relative_to(root)}:{number}: [{key}] is not in docs/bibliography.md")


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    faults = []
    links = {page: check_links(root, page, faults) for page in pages(root)}
    files = sources_by_name(root)
    for page in links:
        if page.name != "CHANGELOG.md":  # which tells of what was
            check_sources(root, page, files, faults)
    check_index(root, links, faults)
    check_mentions(root, faults)
    check_keys(root, faults)
    print("\n".join(faults) if faults else f"{len(links)} pages, no fault")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
