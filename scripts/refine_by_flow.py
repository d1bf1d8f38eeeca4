#!/usr/bin/env python3
"""Meshes a vessel finer round by round where its flow needs it, until the shear stress on its wall stays as it is.

Usage: refine_by_flow.py SURFACE -o DIR [options]

Each round meshes (`ostia mesh --refine-from`), writes a case for OpenFOAM (`ostia case`), runs it (`Allrun`) and
reads it (`ostia result`). It ends when the wall shear stress changes by less than the tolerance from one round to the
next: its top (what 0.1 % of the wall exceeds), its root mean square and its mean over the wall. The largest value of a
single facet is told, too: it is one of thousands, so that chance alone lets it grow with their number. Each round is
asked for GROWTH times the elements of the one before, so that the mesh does change. With --uniform all edges are
shortened alike, for comparison.

DIR gets round-0, round-1, ... with mesh, flow and result, and rounds.csv. Needs numpy and OpenFOAM's simpleFoam.
"""
import argparse
import json
import pathlib
import re
import shlex
import subprocess
import sys

import numpy as np

TOP_SHARE = 0.001  # of the wall
CHANGES = ("top", "rms", "mean")
COLUMNS = ("round", "elements", "points", "max_wss_pa", "top_wss_pa", "rms_wss_pa", "mean_wss_pa", "pressure_drop_pa",
           "iterations", "converged", "change_top", "change_rms", "change_mean", "edge_ratio")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("surface", help="a lumen's surface with open or closed ends (STL, VTP, PLY)")
    parser.add_argument("-o", "--output", required=True, type=pathlib.Path)
    parser.add_argument("--ostia", default="ostia", help="the program")
    parser.add_argument("--by", default="velocity_m_s", help="the field that decides")
    parser.add_argument("--edge-ratio", type=float, default=0.4, help="of the first mesh")
    parser.add_argument("--mesh", default="", help="more options of `ostia mesh`, in one word")
    parser.add_argument("--case", default="", help="more options of `ostia case`, in one word")
    parser.add_argument("--growth", type=float, default=2.0, help="elements of a round over those of the one before")
    parser.add_argument("--tolerance", type=float, default=0.02)
    parser.add_argument("--rounds", type=int, default=8, help="at most")
    parser.add_argument("--most-elements", type=float, default=2e6)
    parser.add_argument("--probe", action="append", default=[], metavar="X,Y,Z",
                        help="a place, mm, whose speed is told; as often as wanted")
    parser.add_argument("--uniform", action="store_true", help="all edges alike, for comparison")
    parser.add_argument("--all-rounds", action="store_true", help="go on when the tolerance is met")
    return parser.parse_args()


def run(command, log):
    """Exit code 4 is a mesh or a result that a person should look at; it is used all the same."""
    with open(log, "a", encoding="utf-8") as out:
        out.write("$ " + " ".join(command) + "\n")
        out.flush()
        code = subprocess.run(command, stdout=out, stderr=subprocess.STDOUT, check=False).returncode
    if code not in (0, 4):
        tail = pathlib.Path(log).read_text(encoding="utf-8", errors="replace").splitlines()[-3:]
        sys.exit(f"{command[0]} {command[1] if len(command) > 1 else ''} failed ({code}): " + " | ".join(tail))
    return code


def numbers_in(text, columns):
    """The list between the outermost round brackets of an OpenFOAM file."""
    start = text.index("(", text.index("\n", text.index("FoamFile")))
    body = text[start + 1:text.rindex(")")]
    return np.array(re.sub(r"[()]", " ", body).split(), dtype=float).reshape(-1, columns)


def wall_patches(folder):
    """(name, first face, faces) of each patch of type wall."""
    text = (folder / "boundary").read_text(encoding="ascii")
    for name, body in re.findall(r"(\S+)\s*\{([^}]*)\}", text):
        if re.search(r"type\s+wall;", body):
            yield name, int(re.search(r"startFace\s+(\d+)", body)[1]), int(re.search(r"nFaces\s+(\d+)", body)[1])


def face_areas(folder, first, count):
    text = (folder / "faces").read_text(encoding="ascii")
    points = numbers_in((folder / "points").read_text(encoding="ascii"), 3)
    faces = re.findall(r"[34]\(([\d ]+)\)", text)[first:first + count]
    areas = np.empty(count)
    for i, face in enumerate(faces):
        p = points[[int(v) for v in face.split()]]
        areas[i] = 0.5 * np.linalg.norm(sum(np.cross(p[k] - p[0], p[k + 1] - p[0]) for k in range(1, len(p) - 1)))
    return areas


def wall_shear(flow):
    """Areas of the wall's facets and the kinematic shear stress on them."""
    text = (last_time(flow) / "wallShearStress").read_text(encoding="ascii")
    mesh = flow / "constant" / "polyMesh"
    areas, shear = [], []
    for name, first, count in wall_patches(mesh):
        block = re.search(r"\n\s*" + re.escape(name) + r"\s*\{(.*?)\n\s*\}", text, re.S)[1]
        rows = re.findall(r"\(([-\d.e+]+ [-\d.e+]+ [-\d.e+]+)\)", block)
        shear.append(np.linalg.norm(np.array([r.split() for r in rows], dtype=float).reshape(count, 3), axis=1))
        areas.append(face_areas(mesh, first, count))
    return np.concatenate(areas), np.concatenate(shear)


def exceeded_by(areas, shear, share):
    order = np.argsort(shear)[::-1]
    return shear[order][np.searchsorted(np.cumsum(areas[order]), share * areas.sum())]


def last_time(flow):
    times = [d for d in flow.iterdir() if d.is_dir() and re.fullmatch(r"[\d.]+", d.name) and float(d.name) > 0]
    return max(times, key=lambda d: float(d.name))


def cell_centres(mesh):
    """Means of their faces' centres."""
    points = numbers_in((mesh / "points").read_text(encoding="ascii"), 3)
    faces = re.findall(r"[34]\(([\d ]+)\)", (mesh / "faces").read_text(encoding="ascii"))
    middles = np.array([points[[int(v) for v in face.split()]].mean(axis=0) for face in faces])
    owner = numbers_in((mesh / "owner").read_text(encoding="ascii"), 1)[:, 0].astype(int)
    neighbour = numbers_in((mesh / "neighbour").read_text(encoding="ascii"), 1)[:, 0].astype(int)
    cells = np.concatenate([owner, neighbour])
    middles = np.concatenate([middles, middles[:len(neighbour)]])
    sums = np.stack([np.bincount(cells, middles[:, k]) for k in range(3)], axis=1)
    return sums / np.bincount(cells)[:, None]


def speeds_at(flow, places_mm):
    """Means of the eight nearest cells, the nearer the heavier."""
    text = (last_time(flow) / "U").read_text(encoding="ascii")
    rows = text[text.index("internalField"):text.index("boundaryField")]
    speed = np.linalg.norm(np.array(re.sub(r"[()]", " ", rows[rows.index("("):rows.rindex(")")]).split(),
                                    dtype=float).reshape(-1, 3), axis=1)
    centres = 1e3 * cell_centres(flow / "constant" / "polyMesh")
    values = []
    for place in places_mm:
        squared = ((centres - place) ** 2).sum(axis=1)
        nearest = np.argsort(squared)[:8]
        values.append(np.average(speed[nearest], weights=1 / (squared[nearest] + 1e-9)))
    return values


def pressure_drop(result):
    mean = {kind: np.mean([face["pressure_Pa"] for face in result["faces"] if face["kind"] == kind])
            for kind in ("inlet", "outlet")}
    return mean["inlet"] - mean["outlet"]


def places(options):
    return [np.array(text.split(","), dtype=float) for text in options.probe]


def one_round(number, options, ratio, before, wanted):
    folder = options.output / f"round-{number}"
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / "log"
    mesh = [options.ostia, "mesh", options.surface, "-o", str(folder / "mesh"), "--edge-ratio", f"{ratio:.6g}",
            *shlex.split(options.mesh)]
    if before and not options.uniform:
        mesh += ["--refine-from", str(before / "result" / "result.vtu"), "--by", options.by,
                 "--refine-elements", f"{wanted:.0f}"]
    run(mesh, log)
    run([options.ostia, "case", str(folder / "mesh" / "mesh.vtu"), "-o", str(folder / "flow"), "--solver", "openfoam",
         *shlex.split(options.case)], log)
    run([str(folder / "flow" / "Allrun")], log)
    run([options.ostia, "result", str(folder / "flow"), "-o", str(folder / "result")], log)
    quality = json.loads((folder / "mesh" / "quality.json").read_text(encoding="utf-8"))["volume"]
    result = json.loads((folder / "result" / "result.json").read_text(encoding="utf-8"))
    areas, shear = wall_shear(folder / "flow")
    shear = shear * result["density_kg_m3"]
    return {"round": number, "elements": quality["tetrahedra"] + quality["prisms"], "points": quality["points"],
            "max_wss_pa": shear.max(), "top_wss_pa": exceeded_by(areas, shear, TOP_SHARE),
            "rms_wss_pa": np.sqrt((areas * shear**2).sum() / areas.sum()),
            "mean_wss_pa": (areas * shear).sum() / areas.sum(), "pressure_drop_pa": pressure_drop(result),
            "iterations": result["run"]["iterations"], "converged": result["run"]["converged"], "edge_ratio": ratio,
            "speeds_m_s": speeds_at(folder / "flow", places(options)) if options.probe else []}


def line_of(row):
    text = f"{row['round']:5d} {row['elements']:9d}"
    for column in ("max_wss_pa", "top_wss_pa"):
        text += f" {row[column]:9.3f}"
    text += f" {row['rms_wss_pa']:9.4f} {row['mean_wss_pa']:9.4f} {row['pressure_drop_pa']:9.2f}  "
    changes = [f"{row[f'change_{name}']:7.2%}" for name in CHANGES] if row["round"] else [" " * 7] * 3
    text += " " * 6 + " ".join(changes)
    if row["speeds_m_s"]:
        text += "   m/s: " + " ".join(f"{v:.4f}" for v in row["speeds_m_s"])
    return text + ("" if row["converged"] else "   solver not converged")


def main():
    options = arguments()
    if options.output.exists() and any(options.output.iterdir()):
        sys.exit(f"{options.output} holds something already; name another folder")
    rows, before, ratio = [], None, options.edge_ratio
    print("round  elements   max WSS   top WSS   rms WSS  mean WSS      drop  change of top  of rms of mean  (Pa)")
    for number in range(options.rounds):
        wanted = options.growth * rows[-1]["elements"] if rows else 0
        if wanted > options.most_elements:
            print(f"the next round would have more than {options.most_elements:.0f} elements")
            break
        row = one_round(number, options, ratio, before, wanted)
        for name in CHANGES:
            now, old = row[f"{name}_wss_pa"], rows[-1][f"{name}_wss_pa"] if rows else np.nan
            row[f"change_{name}"] = now / old - 1
        rows.append(row)
        print(line_of(row), flush=True)
        with open(options.output / "rounds.csv", "w", encoding="ascii") as table:
            probes = [f"speed_m_s at {text.replace(',', ' ')}" for text in options.probe]
            table.write(",".join([*COLUMNS, *probes]) + "\n")
            table.writelines(",".join(str(v) for v in [*(r[c] for c in COLUMNS), *r["speeds_m_s"]]) + "\n"
                             for r in rows)
        before = options.output / f"round-{number}"
        met = number > 0 and max(abs(row[f"change_{name}"]) for name in CHANGES) < options.tolerance
        if met and not options.all_rounds:
            print(f"the wall shear stress changed by less than {100 * options.tolerance:g} %")
            return 0
        if options.uniform:
            ratio *= options.growth ** (-1 / 3)
    return 0 if options.all_rounds else 4


if __name__ == "__main__":
    sys.exit(main())
