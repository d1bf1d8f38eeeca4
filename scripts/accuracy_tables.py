#!/usr/bin/env python3
"""Renews the tables of docs/experiments/accuracy.md from the figures of the golden suite.

Usage: accuracy_tables.py FIGURES DOCUMENT. What stands between the marks <!-- figures --> and <!-- end of figures --> is replaced.
"""
import json
import pathlib
import sys

BEGIN, END = "<!-- figures -->", "<!-- end of figures -->"


def number(value, digits=3):
    return "-" if value is None else f"{value:.{digits}f}"


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def centerline_table(cases):
    rows = []
    for name, figures in cases.items():
        for v in figures["centerline"]["vessels"]:
            rows.append([name, v["vessel"], number(v.get("length_mm"), 1), number(v["ov"]), number(v["of"]), number(v["ot"]),
                         number(v["ai_mm"])])
    return table(["case", "vessel", "length (mm)", "OV", "OF", "OT", "AI (mm)"], rows)


def lumen_table(cases):
    rows = []
    for name, figures in cases.items():
        for s in figures["lumen"]["sections"]:
            if s["observer"] != "truth":
                continue
            rows.append([name, s["section"], s["vessel"], s["health"], number(s.get("length_mm"), 1), number(s["dice"]), number(s["msd_mm"]),
                         number(s["rms_sd_mm"]), number(s["max_sd_mm"]), number(s.get("floor_mm"))])
    return table(["case", "section", "vessel", "lumen", "length (mm)", "Dice", "MSD (mm)", "RMS SD (mm)", "max. SD (mm)", "floor (mm)"], rows)


def observer_table(cases):
    rows = []
    for name, figures in cases.items():
        for o in sorted(figures["lumen"]["summary"], key=lambda row: (row["health"] != "healthy", row["compared"])):
            rows.append([name, o["compared"], o["health"], o["sections"], number(o["dice"]), number(o["msd_mm"]), number(o["max_sd_mm"])])
    return table(["case", "compared", "lumen", "sections", "Dice", "MSD (mm)", "max. SD (mm)"], rows)


def surface_table(cases):
    rows = []
    for name, figures in cases.items():
        s = figures["surface"]
        rows.append([name, number(s["msd_mm"]), number(s["rms_sd_mm"]), number(s["hd95_mm"]), number(s["hausdorff_mm"]),
                     number(s["signed_mean_mm"]), number(s["signed_sd_mm"])])
    return table(["case", "MSD (mm)", "RMS (mm)", "95 % (mm)", "Hausdorff (mm)", "signed mean (mm)", "signed SD (mm)"], rows)


def main():
    figures, document = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    cases = {}
    for folder in sorted(figures.glob("dataset*")):
        cases[folder.name] = {kind: json.loads((folder / f"{kind}.json").read_text()) for kind in ("centerline", "lumen", "surface")}
    parts = ["### Centerlines", centerline_table(cases), "### Lumen sections, result against the exact truth", lumen_table(cases),
             "### Lumen sections, pooled: result and observers", observer_table(cases), "### Surfaces, where the model's vessels run",
             surface_table(cases)]
    text = document.read_text()
    if BEGIN not in text or END not in text:
        sys.exit(f"{document} lacks the marks {BEGIN} and {END}")
    head, rest = text.split(BEGIN, 1)
    tail = rest.split(END, 1)[1]
    document.write_text(head + BEGIN + "\n" + "\n\n".join(parts) + "\n" + END + tail)


if __name__ == "__main__":
    main()
