"""A job by functions and the same job by the command: the same bytes."""
import json

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


@pytest.fixture(scope="module")
def filled(surface):
    """A mesh of the surface, by functions."""
    return ostia.mesh_lumen(surface, ostia.extract_centerlines(surface).tree, sizing={"edge_ratio": 0.7}).mesh


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


def test_a_volume_mesh_in_another_format(folder, filled):
    ostia.export_mesh(folder / "mesh.vtu", filled)
    commands.convert(folder / "mesh.vtu", folder / "mesh_command.msh", format="gmsh4")
    ostia.export_mesh(folder / "mesh_python.msh", ostia.read_volume_mesh(folder / "mesh.vtu"), "gmsh4")
    same(folder / "mesh_command.msh", folder / "mesh_python.msh")


def test_a_mesh(folder, filled):
    result = commands.mesh(folder / "lumen.vtp", output=folder / "mesh", edge_ratio=0.7)
    by_command = ostia.read_volume_mesh(folder / "mesh" / "mesh.vtu")
    assert result.quality_ok and np.array_equal(by_command.points, filled.points)
    assert np.array_equal(by_command.tetrahedra, filled.tetrahedra)


def alike(figures, told, names=None):
    """Every figure that a function gives is the command's, to the last bit; what is none is null there."""
    for name, value in figures.items():
        name = (names or {}).get(name, name)
        if isinstance(value, float) and not np.isfinite(value):
            assert told[name] is None, name
        elif isinstance(value, (int, float, str, bool)):
            assert told[name] == value, name


def beating(surface):
    """A surface that goes to and fro along x over the beat: exact at each of eight phases."""
    return {k / 8: ostia.TriMesh(surface.points + [0.5 * np.sin(2 * np.pi * k / 8), 0, 0.3 * np.cos(2 * np.pi * k / 8)], surface.triangles) for k in range(8)}


@pytest.fixture(scope="module")
def motion(folder):
    surface = ostia.example_surface(1.0, False)
    phases = beating(surface)
    (folder / "phases").mkdir()
    for phase, mesh in phases.items():
        ostia.write_surface(folder / "phases" / f"lumen_{100 * phase}.vtp", mesh)
    result = commands.motion_fit(folder / "phases", output=folder / "beating", depth=2, template_phase=75)
    fit = ostia.fit_motion(phases, registration={"depth": 2}, template_phase=0.75)
    assert fit.ok == result.quality_ok
    return fit.motion


def test_a_motion(folder, motion):
    by_command = ostia.read_motion(folder / "beating")
    assert by_command.origins == motion.origins and by_command.cells == motion.cells
    np.testing.assert_allclose(by_command.phases, motion.phases, atol=1e-11)
    for phase in (0.0, 0.3, 0.75):
        np.testing.assert_allclose(by_command.control_points(phase), motion.control_points(phase), atol=1e-9)
    assert np.array_equal(by_command.surface.points, motion.surface.points)


def test_what_is_carried(folder, motion):
    commands.motion_apply(folder / "beating", folder / "lumen.vtp", output=folder / "moved_command.vtp", phase=37.5)
    moved = ostia.read_motion(folder / "beating").carried(ostia.read_faced_surface(folder / "lumen.vtp"), 0.375)
    ostia.write_surface(folder / "moved_python.vtp", moved)
    same(folder / "moved_command.vtp", folder / "moved_python.vtp")


def test_how_a_tree_moves(folder, motion):
    surface = ostia.example_surface(0.5)
    ostia.write_centerlines(folder / "moving.vtp", ostia.extract_centerlines(surface).tree)
    told = commands.motion_measure(folder / "beating", folder / "moving.vtp", output=folder / "moving", times=8).data
    measured = ostia.measure_motion(ostia.read_motion(folder / "beating"), ostia.read_centerlines(folder / "moving.vtp"), times=8)
    assert without_job(measured) == without_job(told)


def test_a_motion_time_by_time(folder, motion):
    told = commands.motion_export(folder / "beating", output=folder / "times_command", times=5, format=["vtp", "csv"]).data
    times = ostia.export_motion(folder / "times_python", ostia.read_motion(folder / "beating"), times=5, formats=["vtp", "csv"])
    assert [t["max_displacement_mm"] for t in times] == [t["max_displacement_mm"] for t in told["times"]]
    files = sorted(path.name for path in (folder / "times_python").iterdir())
    assert len(files) >= 11
    for name in files:
        same(folder / "times_command" / name, folder / "times_python" / name)


def test_a_reconstructed_surface(folder):
    told = commands.reconstruct(folder / "lines.vtp", output=folder / "quads_command.vtp", level=2, sides=4, hexahedra=folder / "hexahedra_command.vtu").data
    made = ostia.reconstruct_surface(ostia.read_graph(folder / "lines.vtp"), level=2, sides=4)
    assert ostia.write_quad_surface(folder / "quads_python.vtp", made) == []
    same(folder / "quads_command.vtp", folder / "quads_python.vtp")
    assert (len(made.quads), made.closed) == (told["quads"], told["closed"])
    swept = ostia.sweep_hexahedra(made)
    ostia.write_hex_mesh(folder / "hexahedra_python.vtu", swept.mesh)
    same(folder / "hexahedra_command.vtu", folder / "hexahedra_python.vtu")
    assert swept.least_jacobian == told["hexahedra"]["least_scaled_jacobian"]


def test_a_grown_tree(folder, ball):
    ostia.write_surface(folder / "domain.stl", ostia.segment_mask(ball))
    ostia.write_graph(folder / "twig.vtp", ostia.VesselGraph([(0, 0, -1), (0, 0, 0), (0, 0, 1)], [(0, 1), (1, 2)], 0.03))
    told = commands.grow(folder / "twig.vtp", output=folder / "grown_command.vtp", domain=folder / "domain.stl", artery="rca", seed=7).data
    grown = ostia.grow_tree(ostia.read_graph(folder / "twig.vtp"), ostia.read_surface(folder / "domain.stl"), artery="right", seed=7)
    assert ostia.write_graph(folder / "grown_python.vtp", grown.graph, {"Order": grown.order, "Element": grown.element}) == []
    same(folder / "grown_command.vtp", folder / "grown_python.vtp")
    assert (grown.elements, grown.elements_left_out) == (told["elements"], told["elements_left_out"])


def test_measures_of_a_tree(folder):
    told = commands.measure(folder / "lines.vtp", output=folder / "measures").data
    assert without_job(ostia.measure_tree(ostia.read_graph(folder / "lines.vtp")).measures) == without_job(told)


def test_a_skeleton(folder):
    z, y, x = np.mgrid[0:60, 0:30, 0:30]
    mask = ostia.Volume(((x - 15) ** 2 + (y - 15) ** 2 <= 25) & (z > 4) & (z < 56), spacing=(0.5, 0.5, 0.5))
    ostia.write_image(folder / "rod.nrrd", mask)
    told = commands.skeleton(folder / "rod.nrrd", output=folder / "skeleton_command.vtp", prune=2.0, sections=folder / "sections.csv").data
    found = ostia.skeleton_of(ostia.read_mask(folder / "rod.nrrd"), prune={"length_mm": 2.0})
    ostia.write_centerlines(folder / "skeleton_python.vtp", found.tree)
    same(folder / "skeleton_command.vtp", folder / "skeleton_python.vtp")
    assert (folder / "sections.csv").read_text() == found.sections_csv
    assert (found.length_mm, found.loops) == (told["length_mm"], told["loops"])


def test_distances_of_surfaces(folder):
    other = ostia.example_surface(0.5)
    ostia.write_surface(folder / "other.vtp", other)
    told = commands.evaluate_surface(folder / "lumen.vtp", folder / "other.vtp").data
    alike(ostia.evaluate_surface(ostia.read_surface(folder / "lumen.vtp"), ostia.read_surface(folder / "other.vtp")), told, {"max_sd_mm": "hausdorff_mm"})


def test_overlap_of_masks_and_surfaces(folder, ball):
    shifted = ostia.Volume(np.roll(ball.array, 2, axis=2), spacing=ball.spacing, origin=ball.origin)
    ostia.write_image(folder / "a.nrrd", ball)
    ostia.write_image(folder / "b.nrrd", shifted)
    told = commands.evaluate_volume(folder / "a.nrrd", folder / "b.nrrd").data
    found = ostia.evaluate_volume(ball, shifted)
    alike(found["overlap"], told)
    assert found["boundary"]["hd95_mm"] == told["hd95_mm"] and len(found["labels"]) == len(told["labels"]) == 1
    closed = ostia.example_surface(0.5, False)
    ostia.write_surface(folder / "closed.vtp", closed)
    ostia.write_surface(folder / "wide.vtp", ostia.example_surface(0.7, False))
    told = commands.evaluate_volume(folder / "closed.vtp", folder / "wide.vtp").data
    alike(ostia.evaluate_volume(ostia.read_surface(folder / "closed.vtp"), ostia.read_surface(folder / "wide.vtp")), told)


@pytest.fixture(scope="module")
def patient(folder):
    """A synthetic patient without its image; the surface and the contours are coarse, so that it is soon made."""
    told = commands.phantom(output=folder / "suite", preset="tiny", truth_only=True, no_report=True, seed=3, surface_spacing=0.5, contour_spacing=2)
    assert told.quality_ok
    return folder / "suite" / "dataset00"


def test_a_phantom(folder, patient):
    options = {"seed": 3, "preset": "tiny", "surface_spacing_mm": 0.5, "contours": {"spacing_mm": 2}}
    case = ostia.phantom_case(**options)
    ostia.write_contours(folder / "contours_python.json", case.contours)
    same(patient / "contours.json", folder / "contours_python.json")
    ostia.write_centerlines(folder / "axes_python.vtp", case.tree)
    same(patient / "centerlines.vtp", folder / "axes_python.vtp")
    ostia.write_surface(folder / "truth_python.vtp", case.lumen())
    same(patient / "lumen.vtp", folder / "truth_python.vtp")
    ostia.write_phantom(folder / "suite_python", first=options, truth_only=True, report=False)
    same(patient / "case.json", folder / "suite_python" / "dataset00" / "case.json")


def test_scores_of_lines(folder, patient):
    reference = sorted(patient.glob("vessel*/reference.txt"))[0]
    told = commands.evaluate_centerline(reference, patient / "centerlines.vtp").data["vessels"][0]
    found = ostia.evaluate_centerline(ostia.ReferenceLine.read(reference), ostia.read_centerlines(patient / "centerlines.vtp"))
    alike({name: found[name] for name in ("result", "length_mm", "ov", "of", "ot", "ai_mm", "ai_score", "tpr", "fn", "tpm", "fp")}, told)
    assert 0 < found["ov"] < 1 and found["ai_mm"] < 0.5


def test_scores_of_sections(folder, patient):
    told = commands.evaluate_lumen(patient / "contours.json", patient / "lumen.vtp").data
    found = ostia.evaluate_lumen(ostia.read_contours(patient / "contours.json"), ostia.read_surface(patient / "lumen.vtp"))
    assert len(found["sections"]) == len(told["sections"]) > 3
    for one, other in zip(found["sections"], told["sections"]):
        alike({name: one[name] for name in ("section", "vessel", "health", "observer", "length_mm", "dice", "msd_mm", "max_sd_mm", "floor_mm")}, other)
    truth = [section for section in found["sections"] if section["observer"] == "truth"]
    a = np.concatenate([section["reference_radius_mm"] for section in truth])
    b = np.concatenate([section["result_radius_mm"] for section in truth])
    agreement = ostia.bland_altman(a, b)
    assert (agreement["bias"], agreement["sd"], agreement["count"]) == tuple(told["agreement"][name] for name in ("bias_mm", "sd_mm", "contours"))


def test_walls_of_contours(folder, patient):
    commands.lumen(patient / "centerlines.vtp", contours=patient / "contours.json", observer="truth", cell=0.5, output=folder / "drawn_command.vtp")
    drawn = [section for section in ostia.read_contours(patient / "contours.json").sections if section.observer == "truth"]
    model = ostia.model_of_contours(ostia.read_centerlines(patient / "centerlines.vtp"), ostia.ContourSet(drawn))
    ostia.write_surface(folder / "drawn_python.vtp", model.surface(0.5))
    same(folder / "drawn_command.vtp", folder / "drawn_python.vtp")


def test_moving_surfaces(folder, motion):
    surface = ostia.example_surface(1.0, False)
    phases = beating(surface)
    (folder / "late").mkdir()
    late = {}
    for k, (phase, mesh) in enumerate(phases.items()):
        late[k] = ostia.TriMesh(mesh.points + [0.1, 0, 0], mesh.triangles)
        ostia.write_surface(folder / "late" / f"lumen_{100 * phase}.vtp", late[k])
    told = commands.evaluate_motion(folder / "phases", folder / "late").data
    found = ostia.evaluate_motion(list(phases.values()), list(late.values()))
    alike({name: found[name] for name in ("corresponding", "displacement_mm", "path_difference_mm", "msd_mm", "dice")}, told)


def test_pressure_with_uncertainty_and_what_if(folder):
    commands.lumen(folder / "lines.vtp", output=folder / "u.vtp", case=folder / "u.ostia")
    told = commands.ffr(folder / "u.ostia", output=folder / "unsure", uncertainty=True, open=["LAD:16-24"]).data
    with ostia.Case.open(folder / "u.ostia", read_only=True) as case:
        found = ostia.pressure(case.model, uncertainty={}, what_ifs=[{"vessel": 1, "from_mm": 16, "to_mm": 24, "kind": "open"}])
    assert found["uncertainty"] == told["uncertainty"] and found["what_if"] == told["what_if"]


def test_a_network_for_other_solvers(folder):
    commands.ffr(folder / "lines.vtp", output=folder / "exported", export=["svzerod", "openbf"])
    for format in ("svzerod", "openbf"):
        files = ostia.export_network(ostia.read_centerlines(folder / "lines.vtp"), format)
        assert files
        for name, text in files.items():
            assert [path.read_text() for path in (folder / "exported").rglob(name)] == [text]
    case = next((folder / "exported").rglob("*svzerod*.json"))
    told = commands.ffr(case, output=folder / "solved").data
    found = ostia.solve_network(case)
    assert found["vessels"] == told["vessels"] and found["inlet_pressure"] == told["inlet_pressure"]
    assert (folder / "solved" / "network.csv").read_text() == found["csv"]


def test_a_case_of_a_solver(folder, filled):
    ostia.export_mesh(folder / "flow.vtu", filled)
    commands.case(folder / "flow.vtu", output=folder / "flow_command", outlets="split", flow=["1.5"])
    made = ostia.write_openfoam_case(folder / "flow_python", ostia.read_volume_mesh(folder / "flow.vtu"), flow={"outlets": "split", "flow_ml_s": 1.5})
    assert made["mean_flow_ml_s"] == 1.5 and sum(outlet["share"] for outlet in made["outlets"]) == pytest.approx(1)
    files = sorted(path.relative_to(folder / "flow_python") for path in (folder / "flow_python").rglob("*") if path.is_file())
    assert len(files) > 10
    for name in files:
        same(folder / "flow_command" / name, folder / "flow_python" / name)
    ostia.continue_openfoam_case(folder / "flow_python", iterations=4000)
    commands.case(folder / "flow_command", iterations=4000)
    same(folder / "flow_command" / "system" / "controlDict", folder / "flow_python" / "system" / "controlDict")


def test_a_report(folder):
    commands.lumen(folder / "lines.vtp", output=folder / "r.vtp", case=folder / "r.ostia")
    with ostia.Case.open(folder / "r.ostia") as case:
        case.annotate("measure.add", kind="distance", points=[(0, 0, 0), (0, 0, 10)], name="ten")
    told = commands.report(folder / "r.ostia", output=folder / "report_command").data
    with ostia.Case.open(folder / "r.ostia", read_only=True) as case:
        found = ostia.write_report(folder / "report_python", case)
    assert without_job(found) == without_job(told)
    same(folder / "report_command" / "stenoses.csv", folder / "report_python" / "stenoses.csv")
    assert "ten" in (folder / "report_python" / "measurements.csv").read_text()


def test_a_mended_surface(folder):
    noisy = ostia.example_surface(0.8)
    ostia.write_surface(folder / "noisy.vtp", noisy)
    told = commands.convert(folder / "noisy.vtp", folder / "fine_command.stl", repair=True, smooth=10, subdivide=1).data
    fixed, done = ostia.repair_surface(noisy)
    ostia.write_surface(folder / "fine_python.stl", ostia.loop_subdivided(ostia.smoothed_in_volume(fixed, filter={"iterations": 10}, borders_move=True)))
    same(folder / "fine_command.stl", folder / "fine_python.stl")
    assert done == told["repair"]


def test_labels_of_a_case(folder):
    grid = ostia.Volume(np.zeros((90, 20, 20), np.uint8), spacing=(0.5, 0.5, 0.5), origin=(-5, -5, -2))
    ostia.write_image(folder / "grid.nrrd", grid)
    commands.lumen(folder / "lines.vtp", output=folder / "l.vtp", case=folder / "l.ostia")
    told = commands.convert(folder / "l.ostia", folder / "labels_command.nrrd", grid=folder / "grid.nrrd").data
    with ostia.Case.open(folder / "l.ostia", read_only=True) as case:
        labels, counts = ostia.label_volume(case.model, grid)
    ostia.write_image(folder / "labels_python.nrrd", labels)
    same(folder / "labels_command.nrrd", folder / "labels_python.nrrd")
    assert counts == told["labels"] and counts[0]["voxels"] > 1000


def test_an_experiment(folder):
    told = commands.experiment_wall_spread(output=folder / "spread", fitting=2, judged=1).data
    assert ostia.experiment_wall_spread(fitting=2, judged=1) == told


def test_two_runs(folder):
    for run, value in {"golden": 0.9, "new": 0.8}.items():
        (folder / run).mkdir()
        (folder / run / "scores.json").write_text(json.dumps({"dice": value}))
    told = commands.evaluate_suite(folder / "golden", folder / "new").data
    assert ostia.evaluate_suite(folder / "golden", folder / "new") == told
