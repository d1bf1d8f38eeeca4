"""The notebooks are committed without outputs, and run; what each comes to is checked in its own kernel, in a last cell."""
import json
import pathlib

import pytest

import printed
from conftest import SOURCE

CHECKS = {
    "first-model": """
assert meshed.ok and len(meshed.mesh.prisms) > 1000 and len(tree.vessels) == 4
assert len(ostia.read_volume_mesh("mesh.vtu").tetrahedra) == len(meshed.mesh.tetrahedra)
assert pathlib.Path("openfoam/constant/polyMesh/points").exists()
""",
    "edit-by-script": """
assert same and len(ostia.find_stenoses(before, 1)) == 1
assert max([one.diameter_percent for one in ostia.find_stenoses(after, 1)], default=0) < 25
with ostia.Case.open("lad.ostia", read_only=True) as again:
    assert again.model == after and len(again.edits) == 5
""",
    "from-a-mask": """
assert meshed.ok and surface.closed and len(tree.vessels) == 2
# Two ends of three lose a radius of their length.
assert 0.75 < meshed.quality["volume"]["volume_mm3"] / (mask.array.sum() * spacing**3) < 1.02
""",
    "cohort-table": """
assert len(pd.read_csv("cohort.csv")) == 8
assert (abs(table.percent - table.drawn_percent) < 6).all()
assert table.ffr.corr(table.percent) < -0.5 and table.ffr.between(0.05, 1).all()
""",
    "moving-meshes": """
assert fit.ok and sorted(phases.origin) == ["at_rest"] + 3 * ["fitted"] and len(meshes) == 8
assert all(len(one.tetrahedra) == len(mesh.tetrahedra) for one in meshes) and all(row["inverted"] == 0 for row in exported)
assert max(off[::2]) < 0.3 and max(farthest) > 1.5
assert len(list(pathlib.Path("moving").glob("mesh_*.vtu"))) == 8
""",
    "pressure-with-uncertainty": """
ffr, drawn_ffr = told["lesions"][0]["ffr"], lesion["ffr"]
assert drawn_ffr["low"] < drawn_ffr["median"] < drawn_ffr["high"] and drawn_ffr["low"] < ffr < drawn_ffr["high"]
assert 0 <= drawn_ffr["probability"] <= 1 and 0.7 < shares.total.sum() < 1.5
assert (by_wall.high - by_wall.low).is_monotonic_increasing
""",
}


def test_each_has_a_check():
    assert {path.stem for path in printed.notebooks(SOURCE)} == CHECKS.keys()


@pytest.mark.parametrize("path", printed.notebooks(SOURCE), ids=lambda path: path.stem)
def test_it_is_kept_without_outputs(path):
    nbformat = pytest.importorskip("nbformat", reason="nbformat is not there: apt install python3-nbclient")
    nbformat.validate(nbformat.read(path, as_version=4))
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    assert all(cell["execution_count"] is None and cell["outputs"] == [] for cell in cells if cell["cell_type"] == "code")
    assert cells[0]["cell_type"] == "markdown" and "".join(cells[0]["source"]).startswith("# ")


@pytest.mark.parametrize("name", CHECKS)
def test_it_runs(tmp_path, monkeypatch, name):
    nbformat = pytest.importorskip("nbformat", reason="nbformat is not there: apt install python3-nbclient")
    nbclient = pytest.importorskip("nbclient", reason="nbclient is not there: apt install python3-nbclient python3-ipykernel")
    for variable in ("JUPYTER_RUNTIME_DIR", "IPYTHONDIR", "MPLCONFIGDIR"):  # nothing is left in the home
        monkeypatch.setenv(variable, str(tmp_path / variable))
        pathlib.Path(tmp_path / variable).mkdir()
    (tmp_path / "work").mkdir()
    notebook = nbformat.read(SOURCE / "examples" / "notebooks" / f"{name}.ipynb", as_version=4)
    notebook.cells.append(nbformat.v4.new_code_cell("import pathlib\n" + CHECKS[name]))
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(tmp_path / "work")}}).execute()
