"""Memory and time that a step asks for: a line over the size of what it reads, fitted to what this cohort's steps have taken so far,
or, where few are done, a rule of thumb. Both are doubled with each further attempt.

A fit is the least-squares line, stretched until it lies above all but the 2 % that took the most, times a margin.
"""
import json
import statistics

FEWEST, MOST = 12, 500  # steps that are fitted
MARGIN = {"mb": 1.25, "minutes": 3.0}
LEAST = {"mb": 80, "minutes": 5}
# (always, for each MB of what is read), and the size that is taken where it is not known
THUMB = {"mb": {"import": (500, 6), "extract": (600, 12), "lumen": (300, 100), "mesh": (1500, 300), "measures": (800, 100), "pressure": (300, 50)},
         "minutes": {"import": (10, 0.02), "extract": (30, 0.2), "lumen": (10, 1), "mesh": (60, 10), "measures": (20, 5), "pressure": (20, 5)}}
THUMB_SIZE_MB = {"import": 200, "extract": 200, "lumen": 5, "mesh": 5, "measures": 5, "pressure": 5}


def line_above(sizes, values):
    """(always, each), neither of them negative: the least-squares line, times what brings 98 % of the values to or below it."""
    mean_size, mean_value = statistics.fmean(sizes), statistics.fmean(values)
    spread = sum((size - mean_size) ** 2 for size in sizes)
    each = max(0.0, sum((size - mean_size) * (value - mean_value) for size, value in zip(sizes, values)) / spread) if spread > 1e-9 else 0.0
    always = mean_value - each * mean_size
    if always < 0:
        always, each = 0.0, sum(size * value for size, value in zip(sizes, values)) / sum(size * size for size in sizes)
    shares = sorted(value / max(1e-9, always + each * size) for size, value in zip(sizes, values))
    share = shares[min(len(shares) - 1, int(0.98 * len(shares)))]
    return share * always, share * each


def fitted(taken):
    """Of (size MB, MB, seconds) of steps that are done; nothing where they are too few."""
    if len(taken) < FEWEST:
        return None
    sizes = [size for size, _, _ in taken]
    lines = {"mb": line_above(sizes, [mb for _, mb, _ in taken]), "minutes": line_above(sizes, [seconds / 60 for _, _, seconds in taken])}
    return {"size_mb": statistics.median(sizes), "steps": len(taken), **{what: [MARGIN[what] * part for part in line] for what, line in lines.items()}}


def of_thumb(stage):
    return {"size_mb": THUMB_SIZE_MB[stage], "steps": 0, **{what: list(THUMB[what][stage]) for what in THUMB}}


def asked(model, what, size_mb, attempt):
    always, each = model[what]
    size = model["size_mb"] if size_mb is None else size_mb
    return int(max(LEAST[what], always + each * size) * 2 ** (attempt - 1)) + 1


def models(cohort, stages, source_of, manifest_of):
    """By stage. `source_of(stage, scan)` is the file that a step reads, or nothing."""
    found = {}
    for stage, (folder, _) in stages.items():
        taken = []
        for at in sorted((cohort / folder).glob("p-*"))[:MOST]:
            manifest, source = manifest_of(cohort, stage, at.name), source_of(stage, at.name)
            if "peak_mb" in manifest:
                taken.append((source.stat().st_size / 2**20 if source and source.is_file() else 0.0, manifest["peak_mb"], manifest["seconds"]))
        found[stage] = fitted(taken) or of_thumb(stage)
    return found


def kept(file, make, is_main):
    """The jobs of a run ask for what its beginning found."""
    if not is_main and file.is_file():
        return json.loads(file.read_text())
    found = make()
    if is_main:
        file.write_text(json.dumps(found, indent=1) + "\n")
    return found
