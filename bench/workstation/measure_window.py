#!/usr/bin/env python3
"""Measures the workstation by real mouse events (xdotool) under Xvfb, from its own frame log.

Usage: measure_window.py [--busy] BUILD_FOLDER CASE IMAGE [DICOM_FOLDER]
CASE is copied, not changed; IMAGE is the case's image. Prints a table; needs Xvfb and xdotool. It waits until the
window has shown what it is to show and rests, however long that takes on a machine that others use, too.
--busy: searches for the tree run meanwhile, with as low a priority as the window's own.
"""
import argparse
import collections
import json
import os
import pathlib
import signal
import random
import shutil
import subprocess
import sys
import tempfile
import time

MOVES = 80
PULLS, PULL_PX = 92, 13  # to and fro, a pixel at a time; at the end the wall is where PULL_PX has brought it
PAUSE_S = 0.06
HURRY_S = 0.02  # less than any answer takes
REST_S = 1.5  # without a line of the log and without a thread that wants the processor
MOST_S = 600.0  # for any state


def xdo(*words):
    subprocess.run(["xdotool", *map(str, words)], check=True)


def lines_of(log):
    return [json.loads(line) for line in log.read_text().splitlines() if line.endswith("}")] if log.exists() else []


class Program:
    def __init__(self, binary, state, log, *what):
        self.log = log
        log.unlink(missing_ok=True)
        self.start = time.monotonic()
        self.process = subprocess.Popen([binary, "--no-tour", "--state-folder", state, "--frame-log", log, *what])

    def threads_at_work(self):
        at_work = 0
        for stat in pathlib.Path(f"/proc/{self.process.pid}/task").glob("*/stat"):
            try:
                at_work += stat.read_text().rpartition(")")[2].split()[0] in "RD"
            except OSError:  # it has just ended
                pass
        return at_work

    def wait(self, what, state):
        begin = time.monotonic()
        while not state():
            if self.process.poll() is not None:
                sys.exit(f"the program ended with code {self.process.returncode} before {what}")
            if time.monotonic() - begin > MOST_S:
                sys.exit(f"in {MOST_S:.0f} s there was no {what}; the log is {self.log}")
            time.sleep(0.05)

    def shows(self, *views):
        """Each of them, with its image."""
        for view in views:
            self.wait(f"picture of {view}", lambda: pictures(self.log, view))

    def rests(self):
        count, since = -1, time.monotonic()

        def quiet():
            nonlocal count, since
            now = len(lines_of(self.log))
            if now != count or self.threads_at_work():
                count, since = now, time.monotonic()
            return time.monotonic() - since > REST_S

        self.wait("rest", quiet)

    def place(self, view):
        def found():
            return [line for line in lines_of(self.log) if line.get("view") == view and "width" in line]

        self.wait(f"place of {view}", found)
        return found()[-1]

    def interface_ms(self):
        """For how long the interface's thread has run, and has waited for a processor."""
        run, waited, _ = pathlib.Path(f"/proc/{self.process.pid}/task/{self.process.pid}/schedstat").read_text().split()
        return int(run) / 1e6, int(waited) / 1e6

    def peak_mb(self):
        for line in pathlib.Path(f"/proc/{self.process.pid}/status").read_text().splitlines():
            if line.startswith("VmHWM"):
                return int(line.split()[1]) / 1024
        return 0.0

    def end(self):
        self.process.terminate()
        self.process.wait()


def drag(program, places, key, pause_s):
    """The log's lines from the first move on, all answers among them; what the interface's thread took for them."""
    if key:
        xdo("keydown", key)
    xdo("mousemove", *places[0])
    program.rests()
    first, before = len(lines_of(program.log)), program.interface_ms()
    xdo("mousedown", 1)
    for place in places:
        xdo("mousemove", *place)
        time.sleep(pause_s)
    xdo("mouseup", 1)
    if key:
        xdo("keyup", key)
    program.rests()
    took = [after - was for was, after in zip(before, program.interface_ms())]
    return lines_of(program.log)[first:], took


def pictures(log, view):
    """When each picture of a view was painted first."""
    first = {}
    for line in lines_of(log):
        if line.get("view") == view and line.get("picture", 0) > 0:
            first.setdefault(line["picture"], line["t_ms"])
    return sorted(first.values())


def percentile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))]


def measure_drag(name, program, places, kind="drag", key=None, pause_s=PAUSE_S):
    """For each event the time until each view was painted first, and until the last one was."""
    lines, (ran_ms, waited_ms) = drag(program, places, key, pause_s)
    events = collections.defaultdict(dict)
    for line in lines:
        if line.get("kind") == kind and line.get("after_ms") is not None:
            events[line["event"]].setdefault(line["view"], line["after_ms"])
    if not events:
        sys.exit(f"{name}: the drag was none, there is no event of the kind {kind}")
    views = collections.defaultdict(list)
    for painted in events.values():
        for view, after in painted.items():
            views[view].append(after)
    print(f"\n{name}: {len(events)} events")
    for view, after in views.items():
        print(f"  {view:10} n {len(after):3}  median {percentile(after, 0.5):6.1f}  p95 {percentile(after, 0.95):6.1f} ms")
    print(f"  the interface's thread, an event: {ran_ms / len(events):.1f} ms of a processor, for which it waited "
          f"{waited_ms / len(events):.1f} ms")
    # What a frame costs: the paintings of one event together.
    blocked = [line["blocked_ms"] for line in lines if "blocked_ms" in line]
    print("  thread blocked for more than 50 ms:", ", ".join(f"{b:.0f}" for b in sorted(blocked, reverse=True)[:8]) or "never")


class Searches:
    """One after the other, as long as it is held open."""

    def __init__(self, build, image, folder):
        again = 'rm -rf "$2"; while :; do "$0" extract "$1" -o "$2/found.ostia" --force --progress none; done'
        words = ["nice", "-n", "10", "sh", "-c", f'mkdir -p "$2"; {again}', build / "bin/ostia", image, folder]
        self.process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)

    def end(self):
        os.killpg(self.process.pid, signal.SIGTERM)
        self.process.wait()


def drags(program):
    cpr, profile = program.place("cpr1"), program.place("profile")
    middle, down = cpr["x"] + cpr["width"] // 2, cpr["y"] + cpr["height"] // 2
    xdo("mousemove", middle + 60, down, "click", 1)
    program.rests()
    xdo("key", "e")
    program.rests()
    pulled = [(middle + 13 + min(i % (2 * PULL_PX), -i % (2 * PULL_PX)), down + i // 8) for i in range(PULLS)]
    measure_drag("a contour pulled", program, pulled)
    wave = [-min(i % 28, 28 - i % 28) for i in range(2 * MOVES)]  # from where it is
    hurried = [(middle + 26 + step, down + 9 + i // 16) for i, step in enumerate(wave)]
    measure_drag("a contour pulled without a rest", program, hurried, pause_s=HURRY_S)
    measure_drag("CPRs turned", program, [(middle - 60 + 2 * i, down) for i in range(MOVES)], key="shift")
    left, line = profile["x"] + profile["width"] // 3, profile["y"] + profile["height"] // 2
    measure_drag("cursor along the vessel", program, [(left + 4 * i, line) for i in range(MOVES)], kind="profile")


def measure(options, work):
    binary, state, log = options.build / "bin/ostia-workstation", work / "state", work / "frames.jsonl"
    first = Program(binary, state, log, options.image)  # the machine learns where the image is
    first.shows("slice")
    first.end()
    if options.dicom:
        dicom = Program(binary, work / "other", log, options.dicom)
        dicom.shows("slice")
        dicom.rests()
        slices = pictures(log, "slice")
        blocked = [line["blocked_ms"] for line in lines_of(log) if "blocked_ms" in line]
        print(f"DICOM folder: first slice {slices[0]:.0f} ms, last {slices[-1]:.0f} ms after the start of the program; "
              f"peak {dicom.peak_mb():.0f} MB; blocked at most {max(blocked, default=0):.0f} ms")
        dicom.end()
    copy = work / "case.ostia"
    shutil.copy(options.case, copy)
    program = Program(binary, state, log, copy)
    program.shows("cpr1", "cpr2", "section", "slice")
    program.rests()
    shown = pictures(log, "cpr1")
    blocked = [line["blocked_ms"] for line in lines_of(log) if "blocked_ms" in line]
    print(f"case: CPR shown {shown[0]:.0f} ms after the start of the program; "
          f"blocked at most {max(blocked, default=0):.0f} ms")
    searches = Searches(options.build, options.image, work / "found") if options.busy else None
    try:
        drags(program)
    finally:
        if searches:
            searches.end()
        program.end()


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--busy", action="store_true")
    for name in ("build", "case", "image"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("dicom", type=pathlib.Path, nargs="?")
    return parser.parse_args()


def display_server(display):
    server = subprocess.Popen(["Xvfb", display, "-screen", "0", "1600x1200x24", "-nolisten", "tcp", "-noreset"],
                              stderr=subprocess.DEVNULL)
    os.environ["DISPLAY"] = display
    begin = time.monotonic()
    while subprocess.run(["xdotool", "getmouselocation"], capture_output=True).returncode:
        if server.poll() is not None or time.monotonic() - begin > MOST_S:
            sys.exit(f"no display could be opened as {display}")
        time.sleep(0.1)
    return server


def main():
    options = arguments()
    with tempfile.TemporaryDirectory() as folder:
        server = display_server(f":{random.randint(200, 900)}")
        try:
            measure(options, pathlib.Path(folder))
        finally:
            server.terminate()
            server.wait()


if __name__ == "__main__":
    main()
