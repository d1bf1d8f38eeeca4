#!/usr/bin/env python3
"""An example in a text is a test: runs the commands that README, the documentation and `--help` quote, page by page.

Usage: examples_test.py PROGRAMS SOURCE CACHE [--slow] [--only PART|PAGE ...] [--keep FOLDER] [--times]
PROGRAMS is the folder of the programs; PART is tutorials, pages or help. Each page has a folder of its own, with what its
earlier commands made; what it only names comes from inputs.py. How a text says that something cannot be run is in quoted.py.
"""
import argparse
import fcntl
import hashlib
import os
import pathlib
import re
import shutil
import signal
import sys
import tempfile

from inputs import Inputs
from quoted import commands_of, examples_of_help
from run_page import Page
from usage import Usage

# Examples of `--help` that are not run, or by the slow test alone: a help text has no room for marks.
HELP_MARKS = {r"ostia experiment (editing|orientations|smoothness)|ostia phantom|ostia extract CT|--video": ("slow", "minutes of computing"),
              r"ostia experiment (extraction|motion|pressure|sensitivity|robustness|certainty|hard|reading|wall-spread)|--waveform": ("not run", "hours of computing"),
              r"ostia experiment (chain|carotid)": ("not run", "needs data that are not in the repository"),
              r"ostia carry": ("not run", "needs two scans of one patient"),
              r"ostia cohort serve": ("not run", "serves until it is interrupted"),
              r"ostia cohort (crate|reproduce|statistics)": ("not run", "needs a cohort that the workflow has worked on"),
              r"ostia pacs": ("not run", "needs a server of one's own"),
              r"ostia plugin run": ("not run", "needs a plug-in in a folder of its own"),
              r"Allrun": ("needs", "simpleFoam")}


def texts(source):
    """Pages by their name, with their text, as they are read: README first."""
    paths = [source / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")]
    paths += sorted((source / "docs").rglob("*.md")) + sorted((source / "examples").rglob("*.md"))
    return {str(path.relative_to(source)): path.read_text(encoding="utf-8") for path in paths if path.exists()}


def part_of(name):
    if "--help" in name:
        return "help"
    return "pages" if name.startswith(("docs/methods", "docs/reference", "docs/experiments")) else "tutorials"


def helps(usage, program):
    """Examples of a program and of all its commands."""
    made, open_ends = {}, [(program,)]
    while open_ends:
        words = open_ends.pop(0)
        examples = examples_of_help(" ".join(words), usage.help(*words))
        for quoted in examples:
            quoted.marks.update(mark for what, mark in HELP_MARKS.items() if re.search(what, quoted.text))
        made[f"`{' '.join(words)} --help`"] = examples
        open_ends += [words + (word,) for word in usage.below(*words)]
    return made


def cache_of(folder, programs):
    """A folder for the inputs of this build; those of earlier ones go. Kept open by the lock that is returned."""
    folder.mkdir(parents=True, exist_ok=True)
    lock = open(folder / "lock", "w")
    fcntl.flock(lock, fcntl.LOCK_EX)
    digest = hashlib.sha256()
    for path in sorted(pathlib.Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    built = (programs / "ostia").stat()
    mine = folder / f"{built.st_mtime_ns}-{built.st_size}-{digest.hexdigest()[:12]}"
    for old in folder.iterdir():
        if old.is_dir() and old != mine:
            shutil.rmtree(old)
    mine.mkdir(exist_ok=True)
    return mine, lock


class LockedInputs(Inputs):
    """Two tests at a time do not make one input twice."""

    def __init__(self, *arguments, lock):
        super().__init__(*arguments)
        self.lock = lock

    def place(self, *arguments):
        fcntl.flock(self.lock, fcntl.LOCK_EX)
        try:
            return super().place(*arguments)
        finally:
            fcntl.flock(self.lock, fcntl.LOCK_UN)


def report(pages, times):
    print(f"{'ran':>5} {'checked':>8} {'mentioned':>10}   page")
    for page in pages:
        if page.ran or page.checked or page.faults:
            print(f"{page.ran:5} {page.checked:8} {page.mentioned:10}   {page.name}")
            for reason, count in sorted(page.reasons.items()):
                print(f"{'':28}{count} not run: {reason}")
    if times:
        for seconds, text in sorted((t for page in pages for t in page.times), reverse=True)[:25]:
            print(f"{seconds:6.1f} s  {text}")
    faults = [fault for page in pages for fault in page.faults]
    print(*faults, sep="\n")
    print(f"{sum(p.ran for p in pages)} commands ran, {sum(p.checked for p in pages)} were checked and not run, "
          f"{sum(p.mentioned for p in pages)} mentions checked; {len(faults)} faults; "
          f"{sum(seconds for p in pages for seconds, _ in p.times):.0f} s of processor time")
    return bool(faults)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("cache", type=pathlib.Path)
    parser.add_argument("--slow", action="store_true")
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--times", action="store_true")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that what runs is ended
    programs, source = options.programs.resolve(), options.source.resolve()
    usage, all_texts = Usage(str(programs)), texts(source)
    wanted = {name: (commands_of(name, text), text) for name, text in all_texts.items()}
    for program in ("ostia", "ostia-live"):
        wants_help = not options.only or any("help" in word for word in options.only)
        if wants_help and (programs / program).exists():
            wanted.update({name: (examples, "") for name, examples in helps(usage, program).items()})
    shown = lambda page, name: next(q.text for q in commands_of(page, all_texts[page]) if q.file == name)
    cache, lock = cache_of(options.cache, programs)
    fcntl.flock(lock, fcntl.LOCK_UN)
    inputs = LockedInputs(programs / "ostia", source, cache, shown, lock=lock)
    scratch = options.keep or pathlib.Path(tempfile.mkdtemp(prefix="ostia-examples-"))
    scratch.mkdir(parents=True, exist_ok=True)
    pages = []
    try:
        for number, (name, (quoted, text)) in enumerate(wanted.items()):
            if options.only and part_of(name) not in options.only and not any(word == name for word in options.only):
                continue
            folder = scratch / f"{number:03}"
            (folder / "build" / "release").mkdir(parents=True)
            (folder / "build" / "release" / "bin").symlink_to(programs)
            (folder / "scripts").symlink_to(source / "scripts")
            # Debian's own Python has the modules that scripts need.
            environment = {**os.environ, "PATH": f"{programs}:/usr/bin:{os.environ['PATH']}", "HOME": str(folder), "LC_ALL": "C.UTF-8"}
            page = Page(name, usage, inputs, options.slow)
            page.run(quoted, text, folder, environment, 1800 if options.slow else 240)
            pages.append(page)
            if not options.keep:
                shutil.rmtree(folder)
    finally:
        if not options.keep:
            shutil.rmtree(scratch, ignore_errors=True)
    return report(pages, options.times)


if __name__ == "__main__":
    sys.exit(main())
