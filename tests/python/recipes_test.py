"""Twenty recipes, run as printed, one after the other in a folder; each result against what is known of it."""
import os
import re

import numpy as np
import pytest

import ostia
import printed
from conftest import SOURCE

RECIPES = {number: (title, names, code) for number, title, names, code in printed.recipes(SOURCE)}
# The vessel of recipe 1: a cylinder of radius 2 mm and 24 mm, its slices moved sideways, with half a ball at each end.
VOLUME_MM3 = np.pi * 4 * 24 + 4 / 3 * np.pi * 8
# ostia.example_surface: its main vessel, of 70 mm, gets thinner from 2.0 to 0.8 mm; branches of 125 mm leave it.
MAIN_MM, ALL_MM = 70.0, 195.0


def distance_from_vessel(points):
    """Of places from the wall of recipe 1, where it has no ends."""
    middle = points[(points[:, 2] > 6) & (points[:, 2] < 24)]
    return np.hypot(middle[:, 0] - 2 * np.sin(middle[:, 2] / 8), middle[:, 1]) - 2


def roughness_deg(surface):
    """Mean angle between triangles that share an edge."""
    corners = surface.points[surface.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    edges = np.sort(surface.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    order = np.lexsort(edges.T)
    first, second = (order // 3).reshape(-1, 2).T  # of a closed surface each edge stands there twice
    return np.degrees(np.arccos(np.clip((normals[first] * normals[second]).sum(axis=1), -1, 1))).mean()


def image(now):
    again = ostia.read_image("ct.nrrd")
    assert np.array_equal(again.array, now["image"].array) and again.size == (32, 32, 60)
    assert again.world((16, 16, 0)) == (0, 0, 0) and again.array[24, 16, 16] > 170


def lumen_between_points(now):
    assert now["found"].converged and not now["found"].left_out and now["found"].level_set.array.min() < -1


def level_set_surface(now):
    assert now["lumen"].closed and np.abs(distance_from_vessel(now["lumen"].points)).mean() < 0.15


def mask_surface(now):
    assert ostia.read_mask("mask.nii.gz").array.sum() * 0.125 == pytest.approx(VOLUME_MM3, rel=0.08)
    assert np.abs(distance_from_vessel(ostia.read_surface("of-mask.vtp").points)).mean() < 0.15


def known_of_surface(now):
    surface = now["surface"]
    assert surface.closed and surface.volume == pytest.approx(VOLUME_MM3, rel=0.12)
    assert surface.area == pytest.approx(2 * np.pi * 2 * 24 + 4 * np.pi * 4, rel=0.08) and 0.2 < now["edges"].mean() < 0.6


def smoother(now):
    rough, again, smooth = (roughness_deg(now[name]) for name in ("rough", "again", "smooth"))
    assert again < 0.6 * rough and again < 1.3 * smooth
    assert now["again"].volume == pytest.approx(now["smooth"].volume, rel=0.02)


def centerlines(now):
    lengths = [now["tree"].axis(vessel.id).length for vessel in now["tree"].vessels]
    assert len(lengths) == 4 and min(abs(length - MAIN_MM) for length in lengths) < 1
    assert now["tree"].axis(1).radius[5:20] == pytest.approx(2.0, abs=0.1)


def between_points(now):
    line, axis = now["line"], now["tree"].axis("vessel_1")
    assert line.length == pytest.approx(axis.length, abs=1.0) and np.linalg.norm(line.points[0] - axis.points[-1]) < 1
    assert line.radius[-20:].mean() > 2 * line.radius[:20].mean()


def curvature(now):
    assert now["curvature"][5:-5] == pytest.approx(20 / (20**2 + 5**2), rel=0.01)


def branches(now):
    table = now["branches"]
    assert len(table) == 7 and 0.92 * ALL_MM < table.length_mm.sum() < ALL_MM  # a branch runs in its parent for some millimetres
    assert table.radius_mm.between(0.75, 2.05).all() and set(table["from"]) & set(table["to"])


def angles(now):
    assert len(now["angles"]) == 3 and all(5 < angle < 70 for angle in now["angles"].values())


def sections(now):
    main = next(v for v in now["tree"].vessels if abs(now["tree"].axis(v.id).length - MAIN_MM) < 1)
    table = ostia.convert.to_pandas(ostia.lumen_profile(now["model"], main.id, step_mm=1.0))
    between_branches = table[(table.s_mm > 16) & (table.s_mm < 24)]
    assert between_branches.diameter_mm.to_numpy() == pytest.approx(2 * (2 - 1.2 * between_branches.s_mm.to_numpy() / MAIN_MM), abs=0.15)
    assert now["table"].found.mean() > 0.95 and now["table"].s_mm.diff().dropna().max() <= 1.0 + 1e-9


def distance(now):
    _, fields, _ = ostia.read_surface_fields("distance.vtp")
    assert np.array_equal(fields["DistanceToCenterlines"], now["distance"])
    assert 0.6 < now["distance"].min() < 0.9 and 1.9 < now["distance"].max() < 2.6


def equal_steps(now):
    steps = np.diff(now["even"].abscissa)
    assert len(now["even"]) == 50 and steps == pytest.approx(steps.mean(), rel=0.02)
    assert now["even"].length == pytest.approx(now["line"].length, rel=0.01)


def triangles(now):
    surface = ostia.read_surface("remeshed.stl")
    corners = surface.points[surface.triangles]
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean(axis=1)
    wide = corners.mean(axis=1)[:, 2] < 4  # near the root, of radius 2
    assert edges[wide].mean() == pytest.approx(0.5 * 2, rel=0.25) and edges[wide].mean() > 1.4 * np.percentile(edges, 10)


def tubes(now):
    closed = ostia.example_surface(0.4, open_ends=False)
    assert now["tubes"].closed and now["tubes"].volume == pytest.approx(closed.volume, rel=0.05)


def volume_mesh(now):
    meshed = now["meshed"]
    assert meshed.ok, meshed.reasons
    assert sorted(face.kind for face in meshed.mesh.faces) == ["inlet"] + 4 * ["outlet"] + ["wall"]
    assert meshed.quality["volume"]["volume_mm3"] == pytest.approx(meshed.surface.mesh.volume, rel=1e-6)


def extensions_and_layers(now):
    points, lumen = now["meshed"].mesh.points, now["lumen"].points
    assert len(now["meshed"].mesh.prisms) > 1000
    assert lumen[:, 2].min() - points[:, 2].min() == pytest.approx(3 * 4, abs=1)  # three diameters of 4 mm before the root


def areas_of_faces(now):
    areas = now["of_faces"]
    caps = [area for name, area in areas.items() if name != "wall"]
    assert max(caps) == pytest.approx(np.pi * 4, rel=0.1) and min(caps) == pytest.approx(np.pi * 0.8**2, rel=0.15)
    assert areas["wall"] > 20 * sum(caps)


def other_program(now):
    for name in ("mesh.msh", "case"):
        again = ostia.read_volume_mesh(name)
        assert len(again.tetrahedra) == len(now["mesh"].tetrahedra)
        assert again.points.min(axis=0) == pytest.approx(now["mesh"].points.min(axis=0), abs=1e-5)


CHECKS = [image, lumen_between_points, level_set_surface, mask_surface, known_of_surface, smoother, centerlines, between_points,
          curvature, branches, angles, sections, distance, equal_steps, triangles, tubes, volume_mesh, extensions_and_layers,
          areas_of_faces, other_program]


class Kitchen:
    """Runs recipes in their order, each once: a later one reads what an earlier one has written."""

    def __init__(self, folder):
        self.folder, self.done = folder, []

    def names_after(self, number):
        before = os.getcwd()
        os.chdir(self.folder)
        try:
            while len(self.done) < number:
                names = {}
                exec(compile(RECIPES[len(self.done) + 1][2], f"recipe {len(self.done) + 1}", "exec"), names)
                self.done.append(names)
        finally:
            os.chdir(before)
        return self.done[number - 1]


@pytest.fixture(scope="module")
def kitchen(tmp_path_factory):
    return Kitchen(tmp_path_factory.mktemp("recipes"))


def test_there_are_twenty_of_ten_lines():
    assert list(RECIPES) == list(range(1, 21)) and len(CHECKS) == 20
    page = (SOURCE / "docs" / "tutorials" / "python-recipes.md").read_text(encoding="utf-8")
    assert page.count("```python") == 20
    for number, (title, names, code) in RECIPES.items():
        assert len([line for line in code.splitlines() if line.strip()]) <= 10, f"{number}. {title}"
        assert re.fullmatch(r"`vmtk[a-z]+`(, `vmtk[a-z]+`)*", names), f"{number}. {title}"


@pytest.mark.parametrize("number", range(1, 21))
def test_its_result_is_right(kitchen, monkeypatch, number):
    names = kitchen.names_after(number)
    monkeypatch.chdir(kitchen.folder)
    CHECKS[number - 1](names)
