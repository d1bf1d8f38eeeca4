"""Values and functions of the rooms above the mesh, against truth that is known beforehand."""
import copy
import json
import math
import pickle

import numpy as np
import pytest

import ostia


def same_bits(a, b):
    if isinstance(a, np.ndarray):
        return np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
    if isinstance(a, (list, tuple)):
        return len(a) == len(b) and all(same_bits(x, y) for x, y in zip(a, b))
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same_bits(a[key], b[key]) for key in a)
    return a == b or (a != a and b != b)


def members(value):
    """All arrays and numbers of a value, and of the values in it."""
    found = {}
    for name in dir(value):
        if name.startswith("_"):
            continue
        one = getattr(value, name)
        if callable(one):
            continue
        found[name] = members(one) if type(one).__module__ == "ostia" else [members(x) if type(x).__module__ == "ostia" else x for x in one] if isinstance(one, list) else one
    return found


@pytest.fixture(scope="module")
def meshed():
    surface = ostia.example_surface(0.6)
    tree = ostia.extract_centerlines(surface)
    return surface, tree, ostia.mesh_lumen(surface, tree.tree, sizing={"edge_ratio": 0.9}, volume={"layers": {"layers": 1}})


@pytest.fixture(scope="module")
def moving():
    still = ostia.example_surface(1.0, False)
    shift = lambda phase: np.array([math.sin(2 * math.pi * phase), 0.0, 0.0])
    fit = ostia.fit_motion({k / 6: ostia.TriMesh(still.points + shift(k / 6), still.triangles) for k in range(6)}, registration={"depth": 2}, template_phase=0.0)
    return still, shift, fit


@pytest.fixture(scope="module")
def contours():
    angles = np.linspace(0, 2 * np.pi, 32, endpoint=False)
    ring = lambda z, r: np.column_stack([-r * np.sin(angles), r * np.cos(angles), np.full(32, z)])[:, [1, 0, 2]]
    section = ostia.ContourSection("s01", "LAD", [10.0, 12.0, 14.0], [ring(z, 1.5) for z in (10.0, 12.0, 14.0)], observer="truth")
    return ostia.ContourSet([section])


def test_meshes_and_results_can_be_pickled(meshed, model, moving, contours):
    surface, lines, result = meshed
    walls = model.solve()
    profile = ostia.lumen_profile(model, 1, walls)
    values = [result, result.mesh, lines, walls.surface(1), profile, *ostia.find_stenoses(model, 1, walls, profile), moving[2].motion, contours,
              ostia.Frame((0, 0, 1), (1, 0, 0)), ostia.VesselGraph.of_tree(lines.tree)]
    faced = result.surface
    values.append(ostia.tetrahedralize(faced))
    for value in values:
        again = pickle.loads(pickle.dumps(value))
        assert type(again) is type(value) and same_bits(members(again), members(value)), value
    again = pickle.loads(pickle.dumps(walls))
    places = np.array([[0.0, 0, 5], [1, 1, 20]])
    assert np.array_equal(again.values(1, places), walls.values(1, places))
    for value in values[:2] + [profile, walls.surface(1)]:
        assert copy.copy(value) is value and copy.deepcopy(value) is value


def test_a_segmentation_can_be_pickled():
    image, truth, branches, stenosis = ostia.builtin_case(spacing_mm=0.8)
    found = ostia.segment_vessels(image, branches)
    again = pickle.loads(pickle.dumps(found))
    assert np.array_equal(again.level_set.array, found.level_set.array) and again.iterations == found.iterations
    assert 0.3 < stenosis["diameter_stenosis"] < 0.8 and truth.closed and image.array.max() > 250


def test_a_motion_goes_through_its_phases(moving):
    still, shift, fit = moving
    assert fit.ok and fit.motion.phases.shape == (6,) and fit.motion.origins[0] == "at_rest"
    for k in range(6):
        moved = fit.motion.carried(still, k / 6).points
        assert np.abs(moved - (still.points + shift(k / 6))).max() < 0.1
    between = fit.motion.carried(still.points, 0.25)
    assert np.abs(between - (still.points + shift(0.25))).max() < 0.15
    assert np.array_equal(fit.motion.carried(still.points, 1.25), between)
    speed = fit.motion.velocity(still.points, 0.0)[:, 0]
    assert abs(speed.mean() - 2 * math.pi) < 0.5


def test_every_kind_of_value_is_carried_alike(moving, meshed):
    still, shift, fit = moving
    _, lines, result = meshed
    places = result.mesh.points
    expected = fit.motion.carried(places, 0.25)
    assert np.array_equal(fit.motion.carried(result.mesh, 0.25).points, expected)
    assert np.array_equal(fit.motion.carried(result.mesh, 0.25).tetrahedra, result.mesh.tetrahedra)
    moved = fit.motion.carried(result.surface, 0.25)
    assert [face.name for face in moved.faces] == [face.name for face in result.surface.faces]
    tree = fit.motion.carried(lines.tree, 0.25)
    assert np.array_equal(tree.segments[0].axis.points, fit.motion.carried(lines.tree.segments[0].axis.points, 0.25))


def test_a_motion_is_written_and_read(moving, tmp_path):
    motion = moving[2].motion
    ostia.write_motion(tmp_path / "beat.json", motion)
    again = ostia.read_motion(tmp_path / "beat.json")
    assert np.allclose(again.control_points(0.4), motion.control_points(0.4), atol=1e-9)
    assert np.array_equal(again.surface.triangles, motion.surface.triangles)


def test_an_implicit_surface_is_what_its_centres_say():
    surface = ostia.ImplicitSurface([(0, 0, 0)], [1.0], 2.0, polynomial=[0.5, 0, 0, 1])
    x = 0.25
    phi = (1 - x) ** 4 * (4 * x + 1)
    assert surface.values([(0.5, 0, 0), (0, 0, 3)]) == pytest.approx([phi + 0.5, 3.5])
    step = 1e-5
    numeric = (surface.values([(0.5 + step, 0.2, 0.1)]) - surface.values([(0.5 - step, 0.2, 0.1)])) / (2 * step)
    assert surface.gradients([(0.5, 0.2, 0.1)])[0, 0] == pytest.approx(numeric[0], abs=1e-8)
    assert surface.kernel == "wendland-c2" and surface.support_radius_mm == 2


def test_a_wall_is_an_implicit_surface(model):
    wall = model.solve().surface(1)
    assert abs(wall.values([(1.5, 0, 8)])[0]) < 0.02 and wall.values([(0, 0, 8)])[0] < -0.5
    assert len(wall.centres) == len(wall.weights) > 100


def test_frames_and_curves(tree):
    curve = ostia.AxisCurve(tree.axis("LAD"))
    assert curve.length == pytest.approx(40) and curve.point(13) == pytest.approx((0, 0, 13))
    place = curve.place(13, math.pi / 3, 1.2)
    assert curve.foot(place) == pytest.approx((13, math.pi / 3, 1.2))
    frame = curve.frame(13)
    assert frame.tangent == pytest.approx((0, 0, 1))
    assert np.cross(frame.tangent, frame.normal) == pytest.approx(frame.binormal)
    assert frame.angle(frame.direction(0.7)) == pytest.approx(0.7)
    assert curve.radius(20) == pytest.approx(0.75, abs=0.01)


def test_contours_are_a_lumen(contours, tree, tmp_path):
    ostia.write_contours(tmp_path / "c.json", contours)
    again = ostia.read_contours(tmp_path / "c.json")
    assert np.allclose(again.sections[0].contours[1], contours.sections[0].contours[1], atol=1e-6)
    wide = ostia.model_of_tubes(tree, 1.5)
    scores = ostia.evaluate_lumen(contours, wide.surface(0.2))
    assert scores["sections"][0]["dice"] > 0.97 and scores["summary"][0]["sections"] == 1


def test_cones_have_the_measures_of_cones():
    graph = ostia.VesselGraph([(0, 0, 0), (0, 0, 10), (5, 0, 18), (-5, 0, 18)], [(0, 1), (1, 2), (1, 3)], [2.0, 1.5, 1.5])
    measured = ostia.measure_tree(graph)
    length = 10 + 2 * math.sqrt(25 + 64)
    assert measured.measures["length_mm"] == pytest.approx(length)
    segments = measured.tables["segments"]
    assert segments["length_mm"].sum() == pytest.approx(length) and len(segments["length_mm"]) == 3
    assert graph.facts["forks"] == 1 and graph.faults == [] and len(graph.tree()) == 2


def test_a_network_is_mended():
    graph = ostia.VesselGraph([(0, 0, 0), (0, 0, 10), (0, 0, 10), (0, 0, 20)], [(0, 1), (2, 3)], 1.0)
    assert {fault["what"] for fault in graph.faults} >= {"duplicate_point"}
    fixed, done = ostia.repair_graph(graph)
    assert len(fixed.points) == 3 and done and fixed.faults == []


def test_a_grown_tree_begins_with_what_was_given(ball):
    graph = ostia.VesselGraph([(0, 0, -1), (0, 0, 0), (0, 0, 1)], [(0, 1), (1, 2)], 0.03)
    grown = ostia.grow_tree(graph, ostia.segment_mask(ball), artery="right", seed=2)
    assert len(grown.graph) > len(graph) and np.array_equal(grown.graph.edges[: len(graph)], graph.edges)
    assert (grown.order[: len(graph)] == 0).all() and (grown.element[: len(graph)] == -1).all() and grown.order.max() > 1


def test_a_tube_reconstructed_has_its_volume():
    graph = ostia.VesselGraph([(0, 0, z) for z in range(0, 41, 2)], [(i, i + 1) for i in range(20)], 2.0)
    made = ostia.reconstruct_surface(graph, level=2)
    assert made.closed and made.surface.mesh.volume == pytest.approx(math.pi * 4 * 40, rel=0.02)
    swept = ostia.sweep_hexahedra(made)
    assert swept.folded == 0 and swept.volume_mm3 == pytest.approx(made.surface.mesh.volume, rel=0.02)
    cones = ostia.frusta(graph, sides=24)
    assert cones.normals.shape == cones.mesh.points.shape and cones.texture.shape == (len(cones.normals), 2)


def test_a_surface_against_itself_moved():
    z = np.linspace(0, 30, 61)
    tube = ostia.model_of_tubes(ostia.VesselTree.single(np.column_stack([0 * z, 0 * z, z]), np.full(61, 2.0))).surface(0.2)
    wide = ostia.model_of_tubes(ostia.VesselTree.single(np.column_stack([0 * z, 0 * z, z]), np.full(61, 2.2))).surface(0.2)
    scores = ostia.evaluate_surface(tube, wide)
    assert scores["signed_mean_mm"] == pytest.approx(0.2, abs=0.03) and scores["msd_mm"] == pytest.approx(0.2, abs=0.03)
    overlap = ostia.evaluate_volume(tube, wide)
    assert overlap["dice"] == pytest.approx(2 * 4 / (4 + 4.84), abs=0.02)
    assert ostia.surface_shape(tube)["closed"]


def test_agreement_of_known_numbers():
    found = ostia.bland_altman([1.0, 2.0, 3.0, 4.0], [1.5, 2.5, 3.5, 4.5])
    assert found["bias"] == 0.5 and found["sd"] == 0 and found["count"] == 4
    detected = ostia.detect_stenoses([0.7, 0.2, 0.6, 0.1], [0.8, 0.6, 0.3, 0.0])
    assert (detected["true_positive"], detected["false_positive"], detected["false_negative"], detected["true_negative"]) == (1, 1, 1, 1)
    motion = np.zeros((3, 2, 3))
    assert ostia.evaluate_motion_points([0, 30, 60], motion, motion + [0, 0, 2])["mean_mm"] == 2


def test_a_line_against_its_reference():
    z = np.arange(0, 40, 0.03)
    reference = ostia.ReferenceLine(np.column_stack([0 * z, 0 * z, z]), np.full(len(z), 1.5))
    beside = np.column_stack([0 * z + 0.2, 0 * z, z])
    scores = ostia.evaluate_centerline(reference, beside)
    assert scores["ov"] == 1 and scores["ai_mm"] == pytest.approx(0.2, abs=5e-3)
    assert scores["along"]["matched"].all() and scores["along"]["s_mm"].shape == (len(z),)


def test_layers_and_planes(meshed):
    surface, lines, result = meshed
    mesh, layers = ostia.fill_with_layers(result.surface, layers=2, inside={"min_dihedral_deg": 8.0})
    assert len(mesh.prisms) == layers["prisms"] > 0 and layers["inverted"] == 0
    assert layers["thickness_mm"].shape == layers["wanted_mm"].shape
    planes = ostia.end_planes(lines.tree, 4.0)
    assert {plane["end"] for plane in planes} == {face.name for face in result.surface.faces if face.kind != "wall"}
    outlet = next(plane for plane in planes if plane["end"].startswith("outlet"))
    moved = {key: outlet[key] for key in ("end", "origin", "normal")}
    cut = ostia.mesh_lumen(surface, lines.tree, sizing={"edge_ratio": 0.9}, clip={"planes": [moved]})
    face = next(face for face in cut.surface.faces if face.name == outlet["end"])
    points = cut.surface.mesh.points[cut.surface.mesh.triangles[cut.surface.face_ids == face.id].ravel()]
    assert np.abs((points - np.array(outlet["origin"])) @ np.array(outlet["normal"])).max() < 1e-6


def test_sizes_in_space(meshed):
    _, _, result = meshed
    mesh = ostia.tetrahedralize(result.surface).mixed()
    sizes = ostia.sizes_from_field(mesh, np.exp(-((mesh.points - mesh.points.mean(axis=0)) ** 2).sum(axis=1) / 20))
    assert sizes["sizes"]["points"].shape == mesh.points.shape and (sizes["sizes"]["edge_mm"] > 0).all()
    even = {**sizes["sizes"], "edge_mm": np.full(len(mesh.points), 0.11)}
    lengths = ostia.target_edge_lengths(result.surface.mesh, result.tree, field=even)
    assert lengths.max() <= 0.11 + 1e-9 and np.median(lengths) == pytest.approx(0.11)


def test_notes_of_a_case(model, tmp_path):
    with ostia.Case.create(tmp_path / "a.ostia", model) as case:
        first = case.annotate("measure.add", kind="distance", points=[(0, 0, 0), (3, 4, 0)], name="five")
        case.annotate("vessel.mark", vessel=1, visible=True, checked=True, color=[1.0, 0.5, 0.0], note="seen")
        case.annotate("pressure.inputs", inputs={"lv_mass_g": 140.0})
        case.annotate("pressure.what_if", stretches=[{"vessel": 1, "from_mm": 16.0, "to_mm": 24.0, "kind": "open", "percent": 0.0}])
        assert case.measurements[0]["id"] == first and case.measurements[0]["points"][1] == [3, 4, 0]
        assert case.marks[0]["note"] == "seen" and case.marks[0]["checked"]
        assert case.pressure_inputs == {"lv_mass_g": 140.0} and case.what_ifs[0]["to_mm"] == 24
        told = ostia.pressure(case.model, conditions=case.pressure_inputs, what_ifs=case.what_ifs)
        assert told["what_if"]["lesions"][0]["ffr"] > told["lesions"][0]["ffr"]
        case.annotate("report.modifiers", ischaemia="positive", stent=True, agatston=120.0)
        case.annotate("report.features", features=[{"vessel": 1, "from_mm": 16.0, "to_mm": 24.0, "feature": "napkin ring", "state": "accepted"}])
        case.annotate("report.impression", text="No obstructive disease.")
        case.annotate("calcium.places", words=[{"centre": [1.0, 2.5, -3.0], "place": "LAD"}])
        case.annotate("report.sign", date="2026-03-01", signer="Dr. A", digest=case.report_notes["digest"])
        notes = case.report_notes
        assert notes["impression"] == "No obstructive disease." and notes["modifiers"]["ischaemia"] == "positive"
        assert notes["calcium"] == [{"centre": [1.0, 2.5, -3.0], "place": "LAD"}]
        assert notes["features"][0]["feature"] == "napkin ring" and notes["versions"][0]["number"] == 1
        assert notes["versions"][0]["digest"] == notes["digest"] and notes["digest_with_image"] is None
        case.annotate("measure.delete", id=first)
        assert case.measurements == [] and case.undo() and len(case.measurements) == 1
        with pytest.raises(ostia.InvalidInput):
            case.annotate("measure.add", kind="length")


def test_pressure_knows_how_sure_it_is(model):
    few = ostia.pressure(model, uncertainty={"samples": 64, "indices": False})
    lesion = few["uncertainty"]["lesions"][0]["ffr"]
    assert lesion["low"] < few["lesions"][0]["ffr"] < lesion["high"]
    tight = ostia.pressure(model, uncertainty={"samples": 64, "indices": False, "wall": {"radius_sd_mm": 0.01}},
                           uncertainty_inputs={key: 0 for key in few["uncertainty"]["inputs"]} if isinstance(few["uncertainty"].get("inputs"), dict) else None)
    narrow = tight["uncertainty"]["lesions"][0]["ffr"]
    assert narrow["high"] - narrow["low"] < lesion["high"] - lesion["low"]
    surface, fields = ostia.pressure_wall(model)
    assert fields["ffr"].shape == (len(surface.points),) and fields["ffr"].min() < 0.97 < fields["ffr"].max()
    assert {row["key"] for row in ostia.condition_inputs()} >= {"systolic_mmhg", "lv_mass_g"}


def test_plaque_between_two_walls():
    """A tube of contrast in a wall of soft plaque, in fat: its thickness is known."""
    step = 0.25
    z, y, x = np.meshgrid(np.arange(-2, 32, step), np.arange(-6, 6, step), np.arange(-6, 6, step), indexing="ij")
    rho = np.hypot(x, y)
    hu = np.where(rho < 1.5, 400, np.where(rho < 2.6, 60, -90)).astype(np.int16)
    image = ostia.Volume(hu, spacing=(step,) * 3, origin=(-6, -6, -2))
    axis = np.arange(0, 30.1, 0.5)
    model = ostia.model_of_tubes(ostia.VesselTree.single(np.column_stack([0 * axis, 0 * axis, axis]), np.full(len(axis), 1.5), "LAD"))
    walls = ostia.find_plaque(model, 1, image)
    volumes = walls.between(10, 20)
    assert volumes["lumen_mm3"] == pytest.approx(math.pi * 1.5**2 * 10, rel=0.05)
    assert volumes["vessel_mm3"] == pytest.approx(math.pi * 2.6**2 * 10, rel=0.12)
    assert volumes["type"] == "non-calcified" and walls.slabs["plaque_mm2"].shape == walls.slabs["s_mm"].shape
    assert np.hypot(*walls.ring(15.0)[:, :2].T).mean() == pytest.approx(2.6, abs=0.15)


def test_two_cases_compared(tmp_path, source):
    """A tube narrowed to half its diameter since the former scan, and moved: the areas are known."""
    z = np.arange(0, 30.1, 0.5)

    def narrowed(share, shift):
        radius = 1.5 * (1 - share * np.where(np.abs(z - 15) < 4, 0.5 + 0.5 * np.cos(np.pi * (z - 15) / 4), 0))
        tree = ostia.VesselTree.single(np.column_stack([0 * z + shift, 0 * z, z]), radius, "LAD")
        return ostia.Case.create(tmp_path / f"{shift}.ostia", ostia.model_of_tubes(tree))

    with narrowed(0.3, 0) as old, narrowed(0.6, 8) as new:
        found = ostia.compare_cases(old, new)
        cohort = tmp_path / "cohort.json"
        cohort.write_text('{"repeatability": {"lesion": {"mla_mm2": {"sd": 0.2, "share": 0}}}}')
        told = ostia.compare_cases(old, new, repeatability=cohort)
        with pytest.raises(ostia.InvalidInput, match="cohort"):
            ostia.compare_cases(old, new, repeatability=source / "docs/schemas/cohort.schema.json")
    area = found["lesions"][0]["measures"]["mla_mm2"]
    assert area["after"] / area["before"] == pytest.approx((0.4 / 0.7) ** 2, rel=0.15)
    assert area["verdict"] == "not known" and told["lesions"][0]["measures"]["mla_mm2"]["verdict"] == "less"
    assert found["map"]["rigid"]["shift_mm"] == pytest.approx([8, 0, 0], abs=1e-3)
    jsonschema = pytest.importorskip("jsonschema")
    jsonschema.Draft202012Validator(json.loads((source / "docs/schemas/comparison.schema.json").read_text())).validate(found)


def test_a_tree_carried_to_the_next_scan(tmp_path, source):
    """A heart of balls with one straight artery, scanned again 8 mm aside: where the artery lies is known."""
    step, count = 2.0, 48
    place = (np.arange(count) - count / 2) * step
    z, y, x = np.meshgrid(place, place, place, indexing="ij")

    def ball(centre, half):
        return np.sqrt(sum(((a - c) / h) ** 2 for a, c, h in zip((x, y, z), centre, half))) < 1

    hu = np.full(x.shape, -800.0)
    for centre, half, value in [((0, 0, 0), (44, 40, 38), -90), ((0, 2, -4), (36, 32, 30), 70), ((14, 4, -8), (14, 12, 18), 350),
                                ((-15, 2, -6), (11, 14, 15), 270), ((8, 14, 14), (12, 9, 8), 350)]:
        hu[ball(centre, half)] = value
    rho = np.hypot(x, y + 33)
    hu = np.where((rho < 2.6) & (np.abs(z) < 30), 420, hu)
    noise = np.random.default_rng(1)

    def scan(shift):
        voxels = (hu + noise.normal(0, 12, hu.shape)).astype(np.int16)
        return ostia.Volume(voxels, spacing=(step,) * 3, origin=(place[0] + shift, place[0], place[0]))

    s = np.arange(-25, 25.1, 0.5)
    tree = ostia.VesselTree.single(np.column_stack([0 * s, 0 * s - 33, s]), np.full(len(s), 2.6), "LAD")
    with ostia.Case.create(tmp_path / "old.ostia", ostia.model_of_tubes(tree)) as old:
        told = ostia.carry_case(old, scan(0), scan(8), tmp_path / "new.ostia", search=False, anyway=True)
        with pytest.raises(ostia.InvalidInput, match="reach_mm"):
            ostia.carry_case(old, scan(0), scan(8), reach_mm=50)
    assert told["vessels"][0]["how"] == "followed"
    with ostia.Case.open(tmp_path / "new.ostia") as new:
        axis = np.asarray(new.model.tree.axis("LAD").points)
        assert "not checked" in new.marks[0]["note"]
    assert np.hypot(axis[:, 0] - 8, axis[:, 1] + 33).mean() < 0.5 * step
    jsonschema = pytest.importorskip("jsonschema")
    jsonschema.Draft202012Validator(json.loads((source / "docs/schemas/carried-case.schema.json").read_text())).validate(told)


def test_filters_of_itk():
    """A spike goes by a median, a box is parted and measured; what is not known is refused with the nearest name."""
    values = np.zeros((10, 12, 14), np.int16)
    values[2:6, 3:8, 4:9] = 300
    values[8, 10, 12] = 300
    image = ostia.Volume(values, spacing=(0.5, 0.5, 0.5), origin=(1, 2, 3))
    clean = ostia.filter_image(image, "median:radius_mm=0.5")
    assert clean.dtype == "float32" and clean.origin == image.origin and clean.array[8, 10, 12] == 0 and clean.array[3, 5, 6] == 300
    parts = ostia.filter_image(image, ["threshold:lower=150", "components:least_voxels=2"])
    assert set(np.unique(parts.array)) == {0, 1} and (parts.array == 1).sum() == 4 * 5 * 5
    matched = ostia.filter_image(image, "match-histogram:above_mean=no", reference=ostia.Volume(values * np.int16(2)))
    assert abs(matched.array.max() - 600) < 5
    facts = {one["name"]: one for one in ostia.list_filters()}
    assert facts["gaussian"]["parameters"][0]["unit"] == "mm" and facts["n4"]["companion"] == "mask"
    with pytest.raises(ostia.InvalidInput, match="the nearest name is \"median\""):
        ostia.filter_image(image, "medain")
    with pytest.raises(ostia.InvalidInput, match="reference"):
        ostia.filter_image(image, "match-histogram")


def test_calcium_fat_and_territories():
    """Calcium on a ball of a heart, fat about a tube, a wall between two arteries: each is known."""
    z, y, x = np.meshgrid(np.arange(44) * 3.0, np.arange(80) * 2.0, np.arange(80) * 2.0, indexing="ij")
    away = np.sqrt((x - 80) ** 2 + (y - 80) ** 2 + (z - 66) ** 2)
    hu = np.where(away < 45, 45, np.where(away < 54, -90, np.where(np.hypot(x - 80, y - 80) < 72, -850, 50)))
    for spot in ((0.8, -0.47, 0.46), (-1.1, -0.1, -0.2)):
        a, b, c = (m + 45 * p for m, p in zip((80, 80, 66), spot))
        hu[(abs(x - a) < 3) & (abs(y - b) < 3) & (abs(z - c) < 3)] = 450
    scan = ostia.Volume(hu.astype(np.int16), spacing=(2, 2, 3))
    score = ostia.score_calcium(scan, calibration=0.8)
    assert [lesion["place"] for lesion in score["lesions"]] == ["LAD", "RCA"] and score["total"]["mass_mg"] > 0
    rca = ostia.score_calcium(scan, places={1: "none"})
    assert rca["total"]["agatston"] == score["vessels"]["RCA"]["agatston"] and rca["lesions"][0]["assigned"]
    with pytest.raises(ostia.InvalidInput, match="no lesion 7"):
        ostia.score_calcium(scan, places={7: "LAD"})

    step = 0.4
    z, y, x = np.meshgrid(np.arange(-2, 32, step), np.arange(-10, 10, step), np.arange(-10, 10, step), indexing="ij")
    rho = np.hypot(x, y)
    image = ostia.Volume(np.where(rho < 1.5, 400, np.where(rho < 2.0, 60, -85)).astype(np.int16), spacing=(step,) * 3, origin=(-10, -10, -2))
    axis = np.arange(0, 30.1, 0.5)
    tree = ostia.VesselTree.single(np.column_stack([0 * axis, 0 * axis, axis]), np.full(len(axis), 1.5), "LAD")
    fat = ostia.measure_fat(ostia.model_of_tubes(tree), image, tube_kv=100.0)
    assert fat["vessels"][0]["name"] == "LAD" and fat["vessels"][0]["mean_hu"] == pytest.approx(-85, abs=1)

    muscle = ostia.Volume(np.ones((30, 10, 10), np.uint8), origin=(4, 0, 0.5))
    labels, found = ostia.find_territories(tree, muscle, behind=[(1, 15.0)])
    assert found["mass_g"] == pytest.approx(3.15) and found["behind_g"][0] == pytest.approx(3.15 / 2, rel=0.05)
    assert set(np.unique(labels.array)) == {1} and found["lumen_mm3"] == pytest.approx(math.pi * 1.5**2 * 30, rel=0.01)


def test_a_phantom_is_its_truth():
    case = ostia.phantom_case(seed=2, preset="tiny", surface_spacing_mm=0.5)
    beat = case.beating([0.0, 0.4])
    assert set(beat) == {0.0, 0.4} and np.array_equal(beat[0.0].triangles, beat[0.4].triangles)
    assert case.lumen().closed and {line for line in case.references} and all(s["diameter_stenosis"] < 1 for s in case.stenoses)
    assert len(case.contours) > 0


def test_r_peaks_of_a_clear_lead():
    seconds = np.arange(0, 30, 1 / 360)
    lead = sum(np.exp(-((seconds - beat) / 0.012) ** 2) for beat in np.arange(0.5, 30, 0.8))
    peaks = ostia.r_peaks(lead, 360.0) / 360
    assert np.abs(np.diff(peaks) - 0.8).max() < 0.01 and len(peaks) >= 35


def test_markups(tree, tmp_path):
    places = ostia.landmarks(tree)
    ostia.write_markups(tmp_path / "p.mrk.json", [{"points": [(1, 2, 3)], "labels": ["a"], "name": "mine"}, *places])
    again = ostia.read_markups(tmp_path / "p.mrk.json")
    assert again[0]["name"] == "mine" and again[0]["points"].tolist() == [[1, 2, 3]] and len(again) == 1 + len(places)


def test_fields_of_a_mesh(meshed, tmp_path):
    mesh = meshed[2].mesh
    cells = {"pressure_Pa": np.arange(len(mesh.tetrahedra) + len(mesh.prisms), dtype=float)}
    ostia.write_mesh_fields(tmp_path / "f.vtu", mesh, cells, {"velocity_m_s": mesh.points})
    of_cells, of_points = ostia.read_mesh_fields(tmp_path / "f.vtu")
    assert np.array_equal(of_cells["pressure_Pa"], cells["pressure_Pa"]) and np.array_equal(of_points["velocity_m_s"], mesh.points)
