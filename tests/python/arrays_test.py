"""Arrays are one memory with the libraries' values, both ways, as long as anybody looks at them."""
import gc
import logging
import weakref

import numpy as np
import pytest

import ostia


def pointer(array):
    return array.__array_interface__["data"][0]


CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
SIDES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], np.int32)
TOLD = set()  # reasons of copies that this process has told already


@pytest.mark.parametrize("dtype", [np.int16, np.uint8, np.float32])
def test_voxels_are_not_copied_either_way(dtype):
    given = np.arange(24, dtype=dtype).reshape(2, 3, 4)
    volume = ostia.Volume(given, spacing=(0.5, 0.6, 0.7), origin=(1, 2, 3))
    assert pointer(volume.array) == pointer(given)
    assert pointer(ostia.Volume(volume.array).array) == pointer(given)
    assert volume.size == (4, 3, 2) and volume.array.dtype == dtype
    np.testing.assert_array_equal(volume.array, given)
    np.testing.assert_allclose(volume.world((1, 1, 1)), (1.5, 2.6, 3.7))


def test_the_libraries_read_the_same_memory(tmp_path):
    given = np.zeros((4, 5, 6), np.int16)
    volume = ostia.Volume(given)
    given[3, 2, 1] = 77  # before it is written: the file has what the array has then
    ostia.write_image(tmp_path / "a.nrrd", volume)
    assert ostia.read_image(tmp_path / "a.nrrd").array[3, 2, 1] == 77


def test_meshes_are_not_copied_either_way():
    mesh = ostia.TriMesh(CORNERS, SIDES)
    assert pointer(mesh.points) == pointer(CORNERS) and pointer(mesh.triangles) == pointer(SIDES)
    assert mesh.volume == pytest.approx(1 / 6) and mesh.closed


def test_views_are_read_only():
    mesh = ostia.TriMesh(CORNERS, SIDES)
    with pytest.raises(ValueError):
        mesh.points[0, 0] = 5
    with pytest.raises(ValueError):
        ostia.Volume(np.zeros((2, 2, 2), np.int16)).array[0, 0, 0] = 1


def test_a_view_keeps_a_temporary_alive(tmp_path, surface):
    ostia.write_surface(tmp_path / "s.vtp", surface)
    points = ostia.read_surface(tmp_path / "s.vtp").points
    axis = ostia.VesselTree.single([(0, 0, 0), (0, 0, 1), (0, 0, 2)], [1, 1, 1]).segments[0].axis.points
    gc.collect()
    rubbish = [np.full(len(points) * 3, 1e30) for _ in range(20)]
    np.testing.assert_array_equal(points, surface.points)
    np.testing.assert_array_equal(axis, [(0, 0, 0), (0, 0, 1), (0, 0, 2)])
    assert rubbish


def test_what_was_given_lives_as_long_as_it_is_used():
    given = np.zeros((3, 3, 3), np.int16)
    watch = weakref.ref(given)
    volume = ostia.Volume(given)
    view = volume.array
    del given, volume
    gc.collect()
    assert watch() is not None
    del view
    gc.collect()
    assert watch() is None


def test_a_thousand_values_leave_nothing():
    watches = []
    for _ in range(1000):
        points = CORNERS.copy()
        watches.append(weakref.ref(points))
        ostia.TriMesh(points, SIDES).area
    del points
    gc.collect()
    assert all(watch() is None for watch in watches)


def test_masks_of_truth_values_are_kept():
    given = np.ones((2, 2, 2), bool)
    assert pointer(ostia.Volume(given).array) == pointer(given)


@pytest.mark.parametrize("points", [
    np.asfortranarray(np.repeat(CORNERS, 2, axis=0)[::2]),
    np.repeat(CORNERS, 2, axis=0)[::2],
    CORNERS[::-1],
    CORNERS.astype(np.float32),
    CORNERS.astype(">f8"),
    CORNERS.astype(int),
])
def test_a_copy_that_is_needed_is_told_and_can_be_forbidden(points, caplog):
    with pytest.raises(ostia.InvalidInput, match=r"points: an array of shape \(4, 3\) of .* would have to be copied"):
        ostia.TriMesh(points, SIDES, copy=False)
    why = (points.flags.c_contiguous, str(points.dtype))
    news = why not in TOLD
    TOLD.add(why)
    with caplog.at_level(logging.WARNING, "ostia"):
        mesh = ostia.TriMesh(points, SIDES)
        ostia.TriMesh(points, SIDES)
    np.testing.assert_array_equal(mesh.points, points)
    assert [record.getMessage().startswith("copied points") for record in caplog.records] == [True] * news


def test_a_copy_that_is_asked_for():
    assert pointer(ostia.TriMesh(CORNERS, SIDES, copy=True).points) != pointer(CORNERS)


@pytest.mark.parametrize("points, says", [
    (CORNERS.T, r"points: an array of shape \(3, 4\) of float64; it must be of shape \(n, 3\); give points.T"),
    (CORNERS[:, :2], r"shape \(4, 2\)"),
    (CORNERS[0], r"shape \(3,\)"),
    (np.zeros((2, 2, 3)), r"shape \(2, 2, 3\)"),
    (np.where(np.arange(12).reshape(4, 3) == 7, np.nan, CORNERS), r"not finite at \(2, 1\)"),
    (np.array([[None] * 3] * 4), r"holds no numbers"),
    (CORNERS.astype(complex), r"holds no numbers"),
    (CORNERS.astype(str), r"holds no numbers"),
    ("points", r"shape \(\)"),
    ([[0, 0, 0], [1, 2]], r"points: "),
    (np.zeros((0, 3)), r"index of no point; there are 0"),
])
def test_bad_points_are_refused_with_the_way_out(points, says):
    with pytest.raises(ostia.InvalidInput, match=says):
        ostia.TriMesh(points, SIDES)


@pytest.mark.parametrize("triangles, says", [
    (SIDES.astype(float), "triangles: .*whole numbers"),
    (SIDES + 1, "4 in row 1 is the index of no point; there are 4"),
    (-SIDES, "the index of no point"),
    (SIDES.astype(np.int64) + 2**40, "cannot hold"),
])
def test_bad_triangles_are_refused(triangles, says):
    with pytest.raises(ostia.InvalidInput, match=says):
        ostia.TriMesh(CORNERS, triangles)


@pytest.mark.parametrize("use", [
    lambda mesh, folder: ostia.write_surface(folder / "a.stl", mesh), lambda mesh, folder: ostia.write_surface(folder / "a.vtp", mesh),
    lambda mesh, folder: ostia.write_surface_fields(folder / "a.vtp", mesh, {}), lambda mesh, folder: mesh.closed, lambda mesh, folder: mesh.area,
    lambda mesh, folder: ostia.FacedSurface(mesh, np.ones(4, np.int32), []), lambda mesh, folder: ostia.taubin_smoothed(mesh),
    lambda mesh, folder: ostia.extract_centerlines(mesh), lambda mesh, folder: ostia.remesh(mesh, 0.5),
])
def test_indices_that_were_written_to_later_are_refused(use, tmp_path):
    """The given array is its owner's, who may still write to it: the value is wrong then, and no call may crash."""
    triangles = SIDES.copy()
    mesh = ostia.TriMesh(CORNERS, triangles)
    triangles[2, 1] = 2**30
    with pytest.raises((ostia.InvalidInput, ostia.GeometryError)):
        use(mesh, tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("array, says", [
    (np.zeros((3, 4), np.int16), r"array: an array of shape \(3, 4\)"),
    (np.zeros((0, 4, 4), np.int16), "no voxels"),
    (np.full((2, 2, 2), 70000), "int16 cannot hold"),
    (np.full((2, 2, 2), np.inf, np.float32), "not finite"),
    (np.zeros((2, 2, 2), complex), "no whole numbers"),
    ([[[1, 2]], [[3]]], "array: it is not rows"),
])
def test_bad_voxels_are_refused(array, says):
    with pytest.raises(ostia.InvalidInput, match=says):
        ostia.Volume(array)


@pytest.mark.parametrize("how, says", [
    (dict(spacing=(1, 1, 0)), "spacing"), (dict(spacing=(1, 1)), "spacing"), (dict(origin=(1, np.nan, 0)), "origin"),
    (dict(direction=np.eye(2)), "direction"), (dict(direction=np.diag([1, 1, -1])), "direction"), (dict(copy=3), "copy"),
])
def test_bad_places_of_a_volume_are_refused(how, says):
    with pytest.raises(ostia.InvalidInput, match=says):
        ostia.Volume(np.zeros((2, 2, 2), np.int16), **how)


def test_half_a_million_voxels_a_microsecond():
    """512 x 512 x 300 to NumPy and back, 50 microseconds: the least of many tries, since tests run beside each other."""
    import time
    given = np.zeros((300, 512, 512), np.int16)
    times = []
    for _ in range(200):
        start = time.perf_counter()
        array = ostia.Volume(given).array
        times.append(time.perf_counter() - start)
    assert pointer(array) == pointer(given) and min(times) < 50e-6
