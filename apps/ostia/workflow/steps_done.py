"""What the steps of a cohort that are done have taken, by their manifests."""
import os
import typing

import step as steps


class Taken(typing.NamedTuple):
    seconds: float
    peak_mb: float
    bytes: int  # of its folder
    files: int  # likewise, with the record and the log


def measured(cohort):
    """How many scans there are of which something was begun; and by stage what their steps took."""
    begun, done = 0, {stage: [] for stage in steps.STAGES}
    for scan, in steps.asked_of(cohort, "SELECT pseudonym FROM scan ORDER BY number"):
        if not (cohort / "logs" / scan).is_dir():
            continue
        begun += 1
        for stage, (folder, _) in steps.STAGES.items():
            manifest = steps.manifest_of(cohort, stage, scan)
            if "peak_mb" in manifest:
                sizes = [entry.stat().st_size for entry in files_below(cohort / folder / scan)]
                done[stage].append(Taken(manifest["seconds"], manifest["peak_mb"], sum(sizes), len(sizes) + 2))
    return begun, done


def files_below(folder):
    for entry in os.scandir(folder):
        if entry.is_dir(follow_symlinks=False):
            yield from files_below(entry.path)
        else:
            yield entry
