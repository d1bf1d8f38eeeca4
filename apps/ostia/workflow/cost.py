#!/usr/bin/env python3
"""What a large cohort would cost, from the steps that a small one has done: node hours, storage, files.

Usage: cost.py COHORT --scans N --nodes N [--cores N] [--memory-mb N] [--json]

From the manifests of each stage come seconds, memory, bytes and files of a scan (means), and the share of scans that get so far. A node
works at as many steps at once as its cores and its memory (by the most that a step of the stage has taken, times 1.25) allow;
what a step takes beside the command is OVERHEAD_S. Network and disks are taken to keep up: what they would have to
carry is told.
"""
import argparse
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.dont_write_bytecode = True
import steps_done  # noqa: E402

OVERHEAD_S, MEMORY_MARGIN = 0.4, 1.25
DAY_S = 86400


def at_once(cores, memory_mb, most_mb):
    """Steps that a node works at side by side."""
    return max(1, min(cores, int(memory_mb // (MEMORY_MARGIN * most_mb)))) if most_mb else cores


def of_stage(done, all_scans, scans, cores, memory_mb):
    count = len(done)
    expected = scans * count / all_scans
    side_by_side = at_once(cores, memory_mb, max(one.peak_mb for one in done))
    seconds = sum(one.seconds for one in done) / count + OVERHEAD_S
    return {"measured": count, "steps": round(expected), "seconds": seconds, "peak_mb": max(one.peak_mb for one in done), "at_once": side_by_side,
            "node_hours": expected * seconds / side_by_side / 3600, "gb": expected * sum(one.bytes for one in done) / count / 1e9, "files": round(expected * sum(one.files for one in done) / count)}


def cost(done, all_scans, scans, nodes, cores, memory_mb):
    """`done`: by stage what its steps took."""
    stages = {stage: of_stage(some, all_scans, scans, cores, memory_mb) for stage, some in done.items() if some}
    total = {what: sum(one[what] for one in stages.values()) for what in ("steps", "node_hours", "gb", "files")}
    seconds = 3600 * total["node_hours"] / nodes
    return {"v": 1, "kind": "cohort cost", "scans": scans, "nodes": nodes, "cores": cores, "memory_mb": memory_mb, "stages": stages, **total, "days": seconds / DAY_S,
            "written_mb_s": 1000 * total["gb"] / seconds if seconds else 0.0, "files_s": total["files"] / seconds if seconds else 0.0}


def text_of(told):
    lines = [f"{told['scans']} scans on {told['nodes']} nodes of {told['cores']} cores and {told['memory_mb'] / 1000:.0f} GB", "",
             "| stage | measured | s a step | MB at most | at once on a node | node hours | GB | files |", "|---|---|---|---|---|---|---|---|"]
    for stage, one in told["stages"].items():
        lines.append(f"| {stage} | {one['measured']} | {one['seconds']:.1f} | {one['peak_mb']:.0f} | {one['at_once']} | {one['node_hours']:.0f} | {one['gb']:.1f} | {one['files']} |")
    lines += [f"| all | | | | | {told['node_hours']:.0f} | {told['gb']:.1f} | {told['files']} |", "",
              f"{told['days']:.2f} days; {told['written_mb_s']:.1f} MB and {told['files_s']:.0f} new files a second are written."]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description="What a large cohort would cost, from the steps that a small one has done")
    parser.add_argument("cohort", type=pathlib.Path)
    parser.add_argument("--scans", type=int, required=True)
    parser.add_argument("--nodes", type=int, required=True)
    parser.add_argument("--cores", type=int, default=32, help="of a node")
    parser.add_argument("--memory-mb", type=float, default=128000, help="of a node")
    parser.add_argument("--json", action="store_true")
    told = parser.parse_args()
    if min(told.scans, told.nodes, told.cores, told.memory_mb) <= 0:
        parser.error("scans, nodes, cores and memory are more than nothing")
    if not (told.cohort / "cohort.sqlite").is_file():
        parser.error(f"{told.cohort} is no cohort; `ostia cohort init` makes one")
    all_scans, done = steps_done.measured(told.cohort)
    if not any(done.values()):
        sys.exit(f"cost.py: {told.cohort} has no step that is done; let the workflow do some scans first")
    found = cost(done, all_scans, told.scans, told.nodes, told.cores, told.memory_mb)
    print(json.dumps(found, indent=1) if told.json else text_of(found))
    return 0


if __name__ == "__main__":
    sys.exit(main())
