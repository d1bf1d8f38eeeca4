"""What a workflow left in a cohort, so that two runs can be held against each other."""
import json
import pathlib
import sqlite3
import tempfile

import small_files

FOLDERS = ("inputs", "cases", "lumens", "meshes", "measures", "flow")


def write_grown_mask(path, spacing_mm):
    """The vessel of small_files with larger voxels."""
    with tempfile.TemporaryDirectory() as folder:
        small = pathlib.Path(folder) / "mask.nrrd"
        small_files.write_mask(small)
        head, _, voxels = small.read_bytes().partition(b"\n\n")
    directions = f"space directions: ({spacing_mm:g},0,0) (0,{spacing_mm:g},0) (0,0,{spacing_mm:g})".encode()
    lines = [directions if line.startswith(b"space directions") else line for line in head.split(b"\n")]
    path.write_bytes(b"\n".join(lines) + b"\n\n" + voxels)


def names_of(cohort):
    """Ids by pseudonym."""
    sources = sqlite3.connect(f"{cohort}.private/sources.sqlite")
    names = dict(sources.execute("SELECT pseudonym, id FROM source"))
    sources.close()
    return names


def content_of_case(file):
    """All but when its steps were done."""
    case = sqlite3.connect(file)
    lines = [line for line in case.iterdump() if not line.startswith('INSERT INTO "step_stamp"')]
    case.close()
    return "\n".join(lines)


def results(cohort):
    """By a scan's id and folder what was made: digests, and the content of cases. Manifests have times in them."""
    names, found = names_of(cohort), {}
    for folder in FOLDERS:
        for manifest in sorted((cohort / folder).glob("*/manifest.json")):
            outputs = json.loads(manifest.read_text())["outputs"]
            found[names[manifest.parent.name], folder] = {
                name: content_of_case(manifest.parent / name) if name.endswith(".ostia") else digest
                for name, digest in outputs.items() if not name.endswith("manifest.json")}
    return found


def half_made(cohort):
    return [str(p) for folder in FOLDERS for p in (cohort / folder).iterdir() if p.name.startswith(".") and ".part-" in p.name]
