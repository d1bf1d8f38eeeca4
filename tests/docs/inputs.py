"""The files that pages name without making them: one table, each made by Ostia itself, by small_files, or taken from data/golden.

They are made once for a build of the program, and kept in the test's cache.
"""
import gzip
import re
import shutil
import struct
import subprocess

import other_programs
import small_files


class Missing(Exception):
    """An input that cannot be made here, and why."""


def golden_image(inputs, path):
    """An image with a real aorta in it, where the examples look for one."""
    header, _, voxels = (inputs.source / "data/golden/dataset00/image00.nrrd").read_bytes().partition(b"\n\n")
    path.write_bytes(re.sub(rb"space origin: .*", b"space origin: (-7.8,-210,672)", header) + b"\n\n" + voxels)


def dicom_of(image, path):
    """A NRRD file of ours as a CT series."""
    header, _, voxels = image.read_bytes().partition(b"\n\n")
    field = lambda name: re.search(rb"^" + name + rb": (.*)", header, re.M).group(1).decode()
    size, origin = [int(n) for n in field(b"sizes").split()], [float(x) for x in field(b"space origin").strip("()").split(",")]
    spacing = [sum(float(x) for x in row.split(",")) for row in re.findall(r"\(([^)]*)\)", field(b"space directions"))]
    small_files.write_dicom(path, struct.unpack(f"<{size[0] * size[1] * size[2]}h", gzip.decompress(voxels)), size, spacing, origin)


def golden_dicom(inputs, path):
    dicom_of(inputs.get("heart.nrrd", "--aorta"), path)


def heart_dicom(inputs, path):
    """A whole chest, for the search of a coronary tree."""
    suite = path.parent / "suite"
    inputs.ostia("phantom", "-o", suite, "--preset", "small", "--formats", "nrrd", "--no-report", "--surface-spacing", "1")
    dicom_of(suite / "dataset00" / "image00.nrrd", path)


def golden_results(inputs, path):
    """A folder with a lumen and its centerlines."""
    path.mkdir()
    shutil.copy(inputs.source / "data/golden/expected/dataset00/centerlines-left.vtp", path / "centerlines.vtp")
    shutil.copy(inputs.source / "data/golden/dataset00/lumen.vtp", path / "lumen.vtp")


def copy_of(where):
    def make(inputs, path):
        there = inputs.source / where
        (shutil.copytree if there.is_dir() else shutil.copy)(there, path)
    return make


def by(*words):
    """Made by Ostia; {} is the file, and words that are names of inputs are these."""
    def make(inputs, path):
        inputs.ostia(*[str(path) if word == "{}" else str(inputs.get(word)) if at and inputs.has(word) else word
                       for at, word in enumerate(words)])
    return make


def writes(function, *arguments):
    return lambda inputs, path: function(path, *arguments)


def text(content):
    return lambda inputs, path: path.write_text(content)


def shown(page, name):
    """A file that another page shows."""
    def make(inputs, path):
        path.write_text(inputs.shown(page, name))
    return make


def computed_flow(inputs, path):
    if not shutil.which("simpleFoam"):
        raise Missing("simpleFoam is not installed")
    inputs.ostia("case", inputs.get("mesh") / "mesh.vtu", "-o", path, "--outlets", "split")
    subprocess.run([path / "Allrun"], check=True, capture_output=True)


def phases(inputs, path):
    """A lumen that moves sidewards and stretches, at six phases."""
    path.mkdir()
    surface = inputs.get("lumen.stl").read_bytes()
    for n, shift in enumerate((0.0, 0.7, 1.3, 1.5, 1.0, 0.3)):
        other_programs.move_stl(surface, path / f"lumen-{15 * n:02}.stl", lambda p, s=shift: (p[0] + s, p[1], p[2] + 0.02 * s * (p[2] - 670)))


def begun_cohort(inputs, path):
    """A cohort whose table and scans are gone again."""
    for name in BESIDE["scans.csv"]:
        shutil.copy(inputs.get(name), path.parent)
    (path.parent / "scans.csv").write_text(inputs.shown("docs/tutorials/cohort.md", "scans.csv"))
    inputs.ostia("cohort", "init", path.parent / "scans.csv", "-o", path)


# Name, what of the command's text makes it this file ("" for any), how it is made. The first that fits is taken.
TABLE = (
    ("CT", "--aorta", golden_dicom),
    ("CT", "ostia extract", heart_dicom),
    ("CT", "", writes(small_files.write_dicom)),
    ("heart.nrrd", "--aorta", golden_image),
    ("heart.nrrd", "", writes(small_files.write_image)),
    ("scan.nrrd", "", writes(small_files.write_calcium_scan)),
    ("ct.nii.gz", "", by("convert", "heart.nrrd", "{}")),
    ("vessels.nrrd", "", writes(small_files.write_mask)),
    ("mask.nrrd", "", writes(small_files.write_mask)),
    ("mask.nii.gz", "", by("convert", "vessels.nrrd", "{}")),
    ("labels.nrrd", "", writes(small_files.write_mask, True)),
    ("truth.nrrd", "", writes(small_files.write_mask)),
    ("tree.swc", "", writes(small_files.write_swc)),
    ("tree.vtp", "ostia grow", by("convert", "twig.swc", "{}")),
    ("tree.vtp", "", by("convert", "tree.swc", "{}")),
    ("twig.swc", "", text("1 2 7 -182 690 0.03 -1\n2 2 7 -182 690.35 0.03 1\n3 2 7.15 -182.1 690.8 0.02 2\n4 2 6.85 -182.1 690.8 0.02 2\n")),
    ("grown.vtk", "", writes(other_programs.write_vtk_tree_in_metres)),
    ("grown.gxl", "", writes(other_programs.write_gxl)),
    ("grown.vtp", "", by("grow", "twig.swc", "-o", "{}")),
    ("myocardium.stl", "", writes(other_programs.write_ball, (7.0, -182.0, 690.5), 6.0)),
    ("isosurface.stl", "", by("convert", "lumen.vtp", "{}")),
    ("lumen.vtp", "", by("reconstruct", "tree.swc", "-o", "{}", "--level", "1")),
    ("lumen.stl", "", by("convert", "lumen.vtp", "{}")),
    ("truth.vtp", "", by("convert", "lumen.vtp", "{}")),
    ("lines.vtp", "", by("centerline", "lumen.vtp", "-o", "{}")),
    ("centerlines.vtp", "", by("centerline", "lumen.vtp", "-o", "{}")),
    ("heart.ostia", "", by("lumen", "lines.vtp", "-o", "surface.vtp", "--image", "heart.nrrd", "--case", "{}")),
    ("old.ostia", "", by("lumen", "lines.vtp", "-o", "surface.vtp", "--image", "heart.nrrd", "--edits", "edits.jsonl", "--case", "{}")),
    ("new.ostia", "", by("lumen", "lines.vtp", "-o", "surface.vtp", "--image", "heart.nrrd", "--edits", "edits.jsonl", "--case", "{}")),
    ("mesh", "", by("mesh", "lumen.vtp", "-o", "{}", "--edge-ratio", "0.7")),
    ("mesh.vtu", "", lambda inputs, path: shutil.copy(inputs.get("mesh") / "mesh.vtu", path)),
    ("flow", "", computed_flow),
    ("result.vtp", "", lambda inputs, path: shutil.copy(inputs.get("result", "ostia measure") / "wall.vtp", path)),
    ("result", "ostia (mesh|measure)", by("result", "flow", "-o", "{}")),
    ("phases", "", phases),
    ("beating", "", by("motion", "fit", "phases", "-o", "{}")),
    ("motion", "", by("motion", "fit", "phases", "-o", "{}")),
    ("100.hea", "", writes(other_programs.write_ecg)),
    ("100.dat", "", writes(other_programs.write_ecg)),
    ("suite", "", copy_of("data/golden")),
    ("golden", "", copy_of("data/golden/expected")),
    ("new", "", copy_of("data/golden/expected")),
    ("result", "ostia evaluate suite", copy_of("data/golden/expected")),
    ("result", "", golden_results),
    ("out", "", golden_results),
    ("tolerance.json", "", copy_of("data/golden/tolerance.json")),
    ("reference.txt", "", copy_of("data/golden/dataset00/vessel1/reference.txt")),
    ("contours.json", "", copy_of("data/golden/dataset00/contours.json")),
    ("LAD.mrk.json", "", writes(small_files.write_curve, [(8, -187, 675), (7, -182.6, 697), (6, -178, 720)], "LAD")),
    ("inlet.fcsv", "", writes(small_files.write_fcsv, [(8.2, -187.8, 671)])),
    ("outlets.mrk.json", "", writes(small_files.write_curve, [(5.9, -177.4, 723), (19.6, -180.1, 721.4)], "end", "Fiducial")),
    ("edits.jsonl", "", text('{"v":1,"op":"vessel.rename","vessel":0,"name":"LAD"}\n')),
    ("open.stl", "", lambda inputs, path: other_programs.write_open_stl(path, inputs.get("lumen.stl").read_bytes())),
    ("model.vtp", "", lambda inputs, path: other_programs.write_simvascular_model(path, inputs.get("lumen.stl").read_bytes())),
    ("vmtk-lines.vtp", "", writes(other_programs.write_vmtk_centerlines)),
    ("vessels.seg.nrrd", "", writes(small_files.write_segmentation)),
    ("truth.json", "", writes(other_programs.write_moving_points)),
    ("result.json", "", writes(other_programs.write_moving_points)),
    ("pipeline.json", r"--set ct=heart.nrrd$", text('{"v":1,"steps":[{"command":"info","input":"{ct}"}]}')),
    ("pipeline.json", "", shown("docs/reference/pipelines.md", "pipeline.json")),
    ("trial.csv", "", shown("docs/methods/compare.md", "trial.csv")),
    ("scans.csv", "", shown("docs/tutorials/cohort.md", "scans.csv")),
    ("study", "", begun_cohort),
    ("release-1", "", begun_cohort),
    ("release-2", "", begun_cohort),
    ("reviews.json", "", text('{"v":1,"kind":"cohort reviews","reviews":[]}\n')),
    ("patients.csv", "", shown("docs/reference/pipelines.md", "patients.csv")),
)

# What lies beside a file that names it.
BESIDE = {"scans.csv": ("vessels.nrrd", "mask.nrrd", "heart.nrrd"), "trial.csv": ("old.ostia", "new.ostia"), "patients.csv": ("heart.nrrd", "ct.nii.gz"), "100.hea": ("100.dat",)}


class Inputs:
    def __init__(self, program, source, cache, shown):
        self.program, self.source, self.cache, self.shown = program, source, cache, shown

    def has(self, name):
        return any(name == row[0] for row in TABLE)

    def ostia(self, *words):
        done = subprocess.run([self.program, "--quiet", *map(str, words)], cwd=self.cache, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=300, check=False)
        if done.returncode not in (0, 4):
            raise RuntimeError(f"an input was not made: ostia {' '.join(map(str, words))}: {done.stderr.strip()}")

    def get(self, name, command=""):
        """The file's place in the cache, made where it is not there yet."""
        number, (_, _, make) = next((n, row) for n, row in enumerate(TABLE) if row[0] == name and re.search(row[1], command))
        path = self.cache / f"{number}" / name
        if not path.exists():
            path.parent.mkdir(exist_ok=True)
            try:
                make(self, path)
            except BaseException:  # what is half made must not be taken for it
                shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
                raise
        return path

    def place(self, name, command, folder, given):
        """Puts what the name, or a folder above it, stands for where the command looks for it. Returns (name, rule)."""
        parts = name.removeprefix("./").split("/")
        for end in range(len(parts), 0, -1):
            there = "/".join(parts[:end])
            known = next((n for n, row in enumerate(TABLE) if row[0] == there and re.search(row[1], command)), None)
            if known is None or given.get(there) == known or ((folder / there).exists() and there not in given):
                continue
            target = folder / there
            if target.is_dir():
                shutil.rmtree(target)
            target.parent.mkdir(parents=True, exist_ok=True)
            made = self.get(there, command)
            (shutil.copytree if made.is_dir() else shutil.copy)(made, target)
            return there, known
        return None
