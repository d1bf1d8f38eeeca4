"""A job by functions and the same job by the command: the same bytes."""
import numpy as np
import pytest

import ostia
from ostia import commands


@pytest.fixture(scope="module")
def folder(tmp_path_factory, surface, tree):
    made = tmp_path_factory.mktemp("jobs")
    ostia.write_surface(made / "lumen.vtp", surface)
    ostia.write_centerlines(made / "lines.vtp", tree)
    return made


def same(a, b):
    assert a.stat().st_size > 0 and a.read_bytes() == b.read_bytes()


def test_a_surface_in_another_format(folder):
    commands.convert(folder / "lumen.vtp", folder / "by_command.stl")
    ostia.write_surface(folder / "by_python.stl", ostia.read_surface(folder / "lumen.vtp"))
    same(folder / "by_command.stl", folder / "by_python.stl")


def test_an_image_in_another_format(folder, ball):
    ostia.write_image(folder / "ball.nrrd", ball.astype("int16"))
    commands.convert(folder / "ball.nrrd", folder / "by_command.nii.gz")
    ostia.write_image(folder / "by_python.nii.gz", ostia.read_mask(folder / "ball.nrrd"))
    a, b = ostia.read_image(folder / "by_command.nii.gz"), ostia.read_image(folder / "by_python.nii.gz")
    assert np.array_equal(a.array, b.array) and a.origin == b.origin


def test_centerlines(folder, surface):
    commands.centerline(folder / "lumen.vtp", output=folder / "by_command.vtp")
    ostia.write_centerlines(folder / "by_python.vtp", ostia.extract_centerlines(surface).tree)
    same(folder / "by_command.vtp", folder / "by_python.vtp")


def test_the_surface_of_a_mask(folder, ball):
    ostia.write_image(folder / "mask.nrrd", ball)
    commands.segment(folder / "mask.nrrd", output=folder / "mask_command.stl")
    ostia.write_surface(folder / "mask_python.stl", ostia.segment_mask(ball))
    same(folder / "mask_command.stl", folder / "mask_python.stl")


def test_walls_of_tubes(folder):
    commands.lumen(folder / "lines.vtp", output=folder / "tube_command.vtp", case=folder / "tube.ostia")
    model = ostia.model_of_tubes(ostia.read_centerlines(folder / "lines.vtp"))
    ostia.write_surface(folder / "tube_python.vtp", model.surface())
    same(folder / "tube_command.vtp", folder / "tube_python.vtp")
    assert ostia.Case.open(folder / "tube.ostia", read_only=True).model == model


def test_walls_of_a_surface(folder, surface):
    commands.centerline(folder / "lumen.vtp", output=folder / "axes.vtp")
    commands.lumen(folder / "axes.vtp", surface=folder / "lumen.vtp", output=folder / "walls_command.vtp")
    model = ostia.model_of_surface(ostia.read_centerlines(folder / "axes.vtp"), surface)
    ostia.write_surface(folder / "walls_python.vtp", model.surface())
    same(folder / "walls_command.vtp", folder / "walls_python.vtp")


def test_edits(folder):
    lines = ['{"v":1,"op":"wall.push","vessel":1,"path":[[0,0,8],[0.9,0,8]],"radius_mm":1.0}',
             '{"v":1,"op":"vessel.rename","vessel":1,"name":"RCA"}']
    (folder / "edits.jsonl").write_text("\n".join(lines) + "\n")
    result = commands.lumen(folder / "lines.vtp", edits=folder / "edits.jsonl", output=folder / "edited_command.vtp")
    model = ostia.model_of_tubes(ostia.read_centerlines(folder / "lines.vtp"))
    for line in lines:
        model = ostia.apply_edit(model, line).model
    assert result.data["digest"] == model.digest
    ostia.write_surface(folder / "edited_python.vtp", model.surface())
    same(folder / "edited_command.vtp", folder / "edited_python.vtp")


def without_job(result):
    """What is computed: not what a person may have called it, nor when."""
    return {key: value for key, value in result.items() if key not in ("input", "seconds", "created")}


def test_pressure_of_a_tree(folder):
    by_command = commands.ffr(folder / "lines.vtp", output=folder / "pressure_tree").data
    by_python = ostia.pressure(ostia.read_centerlines(folder / "lines.vtp"))
    assert without_job(by_python) == without_job(by_command)


def test_pressure_of_a_case(folder):
    commands.lumen(folder / "lines.vtp", output=folder / "c.vtp", case=folder / "c.ostia")
    by_command = commands.ffr(folder / "c.ostia", output=folder / "pressure_case", lv_mass=140.0).data
    with ostia.Case.open(folder / "c.ostia", read_only=True) as case:
        by_python = ostia.pressure(case.model, conditions={"lv_mass_g": 140.0})
    assert without_job(by_python) == without_job(by_command)


def test_a_volume_mesh_in_another_format(folder, surface):
    tree = ostia.extract_centerlines(surface).tree
    mesh = ostia.mesh_lumen(surface, tree, sizing={"edge_ratio": 0.7}).mesh
    ostia.export_mesh(folder / "mesh.vtu", mesh)
    commands.convert(folder / "mesh.vtu", folder / "mesh_command.msh", format="gmsh4")
    ostia.export_mesh(folder / "mesh_python.msh", ostia.read_volume_mesh(folder / "mesh.vtu"), "gmsh4")
    same(folder / "mesh_command.msh", folder / "mesh_python.msh")


def test_a_mesh(folder, surface):
    result = commands.mesh(folder / "lumen.vtp", output=folder / "mesh", edge_ratio=0.7)
    tree = ostia.extract_centerlines(surface).tree
    meshed = ostia.mesh_lumen(surface, tree, sizing={"edge_ratio": 0.7})
    ostia.export_mesh(folder / "by_python.vtu", meshed.mesh)
    by_command = ostia.read_volume_mesh(folder / "mesh" / "mesh.vtu")
    assert result.quality_ok and np.array_equal(by_command.points, meshed.mesh.points)
    assert np.array_equal(by_command.tetrahedra, meshed.mesh.tetrahedra)
