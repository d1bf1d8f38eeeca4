#!/usr/bin/env python3
"""Makes the cases of data/golden anew: make_golden.py OSTIA [FOLDER]

Runs `ostia phantom --preset tiny` and keeps what the golden suite needs. The surface of the lumen is that of the whole tree; it is cut
to the image's box and 4 mm around it, so that the folder stays small. Cases made anew need new expected figures: golden_suite.sh --update.
"""
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

CASES = (0, 1)  # of the seeds 1, 2, ...
MARGIN_MM = 4.0
KEPT = ("case.json", "contours.json")


def run(*arguments):
    subprocess.run([str(a) for a in arguments], check=True)


def cut(source, target, low, high):
    """The triangles of a binary STL that lie in a box."""
    data = source.read_bytes()
    count = struct.unpack_from("<I", data, 80)[0]
    kept = []
    for i in range(count):
        record = data[84 + 50 * i:134 + 50 * i]
        points = struct.unpack_from("<9f", record, 12)
        if all(low[k % 3] <= value <= high[k % 3] for k, value in enumerate(points)):
            kept.append(record)
    target.write_bytes(b"\0" * 80 + struct.pack("<I", len(kept)) + b"".join(kept))


def main():
    ostia = pathlib.Path(sys.argv[1]).resolve()
    golden = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).parent.parent / "data" / "golden")
    for old in golden.glob("dataset*"):
        shutil.rmtree(old)
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        run(ostia, "phantom", "-o", work / "suite", "--preset", "tiny", "--seed", 1, "--cases", max(CASES) + 1, "--formats", "nrrd",
            "--surface-spacing", 0.5, "--no-report", "--quiet")
        for number in CASES:
            case = work / "suite" / f"dataset{number:02d}"
            target = golden / case.name
            target.mkdir(parents=True)
            for kept in (*KEPT, f"image{number:02d}.nrrd"):
                shutil.copy(case / kept, target)
            for vessel in sorted(case.glob("vessel*")):
                shutil.copytree(vessel, target / vessel.name)
            grid = json.loads((case / "case.json").read_text())["grid"]
            low = [o - MARGIN_MM for o in grid["origin_mm"]]
            high = [o + s * n + MARGIN_MM for o, s, n in zip(grid["origin_mm"], grid["spacing_mm"], grid["size"])]
            run(ostia, "convert", case / "lumen.vtp", work / "whole.stl", "--quiet")
            cut(work / "whole.stl", work / "part.stl", low, high)
            run(ostia, "convert", work / "part.stl", target / "lumen.vtp", "--quiet")


if __name__ == "__main__":
    main()
