#!/usr/bin/env python3
"""Measures the workstation by real mouse events (xdotool) under Xvfb, from its own frame log.

Usage: measure_window.py BUILD_FOLDER CASE IMAGE [DICOM_FOLDER]
CASE is copied, not changed; IMAGE is the case's image. Prints a table; needs Xvfb and xdotool.
"""
import collections
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

MOVES = 80
PAUSE_S = 0.06
HURRY_S = 0.02  # less than any answer takes


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

    def settled(self, quiet_s=2.0, most_s=90.0):
        last, since, begin = -1, time.monotonic(), time.monotonic()
        while time.monotonic() - begin < most_s:
            count = len(lines_of(self.log))
            if count != last:
                last, since = count, time.monotonic()
            if count and time.monotonic() - since > quiet_s:
                return
            time.sleep(0.1)

    def place(self, view):
        found = [line for line in lines_of(self.log) if line.get("view") == view and "width" in line]
        return found[-1]

    def peak_mb(self):
        for line in pathlib.Path(f"/proc/{self.process.pid}/status").read_text().splitlines():
            if line.startswith("VmHWM"):
                return int(line.split()[1]) / 1024
        return 0.0

    def end(self):
        self.process.terminate()
        self.process.wait()


def drag(places, key=None, pause_s=PAUSE_S):
    if key:
        xdo("keydown", key)
    xdo("mousemove", *places[0])
    time.sleep(0.2)
    xdo("mousedown", 1)
    for place in places:
        xdo("mousemove", *place)
        time.sleep(pause_s)
    xdo("mouseup", 1)
    if key:
        xdo("keyup", key)
    time.sleep(2.0)


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


def table(name, log, first, kind):
    """For each event the time until each view was painted first, and until the last one was."""
    events = collections.defaultdict(dict)
    for line in lines_of(log)[first:]:
        if line.get("kind") == kind and line.get("after_ms") is not None:
            events[line["event"]].setdefault(line["view"], line["after_ms"])
    views = collections.defaultdict(list)
    for painted in events.values():
        for view, after in painted.items():
            views[view].append(after)
    print(f"\n{name}: {len(events)} events")
    for view, after in views.items():
        print(f"  {view:10} n {len(after):3}  median {percentile(after, 0.5):6.1f}  p95 {percentile(after, 0.95):6.1f} ms")
    # What a frame costs: the paintings of one event together.
    blocked = [line["blocked_ms"] for line in lines_of(log)[first:] if "blocked_ms" in line]
    print("  thread blocked for more than 50 ms:", ", ".join(f"{b:.0f}" for b in sorted(blocked, reverse=True)[:8]) or "never")


def main():
    build, case, image = map(pathlib.Path, sys.argv[1:4])
    binary = build / "bin/ostia-workstation"
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        display = f":{random.randint(200, 900)}"
        server = subprocess.Popen(["Xvfb", display, "-screen", "0", "1600x1200x24", "-nolisten", "tcp", "-noreset"],
                                  stderr=subprocess.DEVNULL)
        os.environ["DISPLAY"] = display
        time.sleep(1.0)
        try:
            state, log = work / "state", work / "frames.jsonl"
            first = Program(binary, state, log, image)  # the machine learns where the image is
            first.settled()
            first.end()
            if len(sys.argv) > 4:
                dicom = Program(binary, work / "other", log, sys.argv[4])
                dicom.settled(4.0)
                slices = pictures(log, "slice")
                blocked = [line["blocked_ms"] for line in lines_of(log) if "blocked_ms" in line]
                print(f"DICOM folder: first slice {slices[0]:.0f} ms, last {slices[-1]:.0f} ms after the start of the program; "
                      f"peak {dicom.peak_mb():.0f} MB; blocked at most {max(blocked, default=0):.0f} ms")
                dicom.end()
            copy = work / "case.ostia"
            shutil.copy(case, copy)
            program = Program(binary, state, log, copy)
            program.settled(3.0)
            shown = pictures(log, "cpr1")
            blocked = [line["blocked_ms"] for line in lines_of(log) if "blocked_ms" in line]
            print(f"case: CPR shown {shown[0]:.0f} ms after the start of the program; "
                  f"blocked at most {max(blocked, default=0):.0f} ms")
            cpr, profile = program.place("cpr1"), program.place("profile")
            middle, down = cpr["x"] + cpr["width"] // 2, cpr["y"] + cpr["height"] // 2
            xdo("mousemove", middle + 60, down, "click", 1)
            time.sleep(1.0)
            xdo("key", "e")
            time.sleep(1.0)
            at = len(lines_of(log))
            drag([(middle + 13 + i // 6, down + i // 8) for i in range(MOVES)])
            table("a contour pulled", log, at, "drag")
            at = len(lines_of(log))
            wave = [-min(i % 28, 28 - i % 28) for i in range(2 * MOVES)]  # from where it is
            drag([(middle + 26 + step, down + 9 + i // 16) for i, step in enumerate(wave)], pause_s=HURRY_S)
            table("a contour pulled without a rest", log, at, "drag")
            at = len(lines_of(log))
            drag([(middle - 60 + 2 * i, down) for i in range(MOVES)], "shift")
            table("CPRs turned", log, at, "drag")
            at = len(lines_of(log))
            left, line = profile["x"] + profile["width"] // 3, profile["y"] + profile["height"] // 2
            drag([(left + 4 * i, line) for i in range(MOVES)])
            table("cursor along the vessel", log, at, "profile")
            program.end()
        finally:
            server.terminate()


if __name__ == "__main__":
    main()
