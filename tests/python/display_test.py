"""What notebooks show of values: pictures that are small and made quickly enough, and that show what they are of."""
import os
import pathlib
import struct
import zlib

import numpy as np
import pytest

import ostia

MOST_BYTES = 100_000


def pixels(png):
    """Of a PNG of 8 bits without interlacing, (height, width, channels): read here, so that no other package is needed."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, data = 8, b""
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at : at + 8])
        chunk = png[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", chunk[:10])
        data += chunk if kind == b"IDAT" else b""
        at += 12 + length
    assert depth == 8
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(height, 1 + width * channels)
    out = np.zeros((height, width * channels), np.uint8)
    for y, (kind, line) in enumerate(zip(rows[:, 0], rows[:, 1:])):
        above = out[y - 1] if y else np.zeros(width * channels, np.uint8)
        if kind in (0, 2):
            out[y] = line + (above if kind else 0)
            continue
        for x in range(width * channels):
            left = int(out[y, x - channels]) if x >= channels else 0
            up, corner = int(above[x]), int(above[x - channels]) if x >= channels else 0
            guess = left + up - corner
            paeth = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            out[y, x] = (int(line[x]) + {1: left, 3: (left + up) // 2, 4: paeth}[int(kind)]) & 255
    return out.reshape(height, width, channels)


def shown(value, name):
    """Its picture; kept as a PNG of this name where OSTIA_PICTURES says."""
    png = value._repr_png_()
    assert isinstance(png, bytes) and len(png) <= MOST_BYTES
    if "OSTIA_PICTURES" in os.environ:
        pathlib.Path(os.environ["OSTIA_PICTURES"], f"python-{name}.png").write_bytes(png)
    return pixels(png)


def foreground(picture):
    """Whether a pixel is of another colour than the corner's."""
    colors = picture[:, :, :3].astype(int)
    return np.abs(colors - colors[1, 1]).max(axis=2) > 30


def tall_and_thin(picture):
    """The largest share of a row's pixels and of a column's that are something."""
    seen = foreground(picture)
    return seen.any(axis=1).mean(), seen[seen.shape[0] // 2].mean()


def test_a_volume_is_its_middle_planes(ball):
    picture = shown(ball, "volume")
    middle = picture[picture.shape[0] // 2, :, 0] > 200
    edges = np.flatnonzero(np.diff(np.concatenate([[0], middle.astype(int), [0]])))
    stretches = edges[1::2] - edges[::2]
    assert len(stretches) == 3 and np.allclose(stretches, 8.0 / 12.5 * 120, atol=7)  # 8 of 12.5 mm, of 120 pixels


def test_noise_is_small_as_a_file_too():
    noise = np.random.default_rng(1).normal(250, 300, (60, 100, 100)).astype(np.int16)
    shown(ostia.Volume(noise, spacing=(0.4, 0.4, 0.7)), "noise")


@pytest.mark.parametrize("kind", ["surface", "model", "tree"])
def test_a_vessel_is_long_and_thin(kind, model, tree):
    value = {"surface": lambda: model.surface(0.4), "model": lambda: model, "tree": lambda: tree}[kind]()
    high, wide = tall_and_thin(shown(value, kind))
    assert high > 0.75 and 0.01 < wide < 0.25


def test_a_mesh_is_its_boundary(source):
    mesh = ostia.read_volume_mesh(next((source / "data").rglob("*.vtu"))) if list((source / "data").rglob("*.vtu")) else None
    if mesh is None:
        lumen = ostia.example_surface(0.8)
        mesh = ostia.mesh_lumen(lumen, ostia.extract_centerlines(lumen).tree, sizing={"edge_ratio": 0.8}).mesh
    assert 0.03 < foreground(shown(mesh, "mesh")).mean() < 0.7


def test_a_profile_is_a_curve_with_its_narrowing(model):
    picture = shown(ostia.lumen_profile(model, 1), "profile")
    assert picture.shape[:2] == (260, 480)
    assert 0.005 < foreground(picture).mean() < 0.3


def test_the_image_along_a_vessel(tree):
    k, j, i = np.mgrid[0:90, 0:48, 0:48]
    hu = np.where(np.hypot(i - 23.5, j - 23.5) < 4, 700, -200).astype(np.int16)
    image = ostia.Volume(hu, spacing=(0.5, 0.5, 0.5), origin=(-11.75, -11.75, -2))
    picture = ostia.picture(tree, image=image, vessel="LAD", theta_deg=30)
    assert isinstance(picture.png(), bytes) and picture.width > 80 and repr(picture) == f"<ostia.Picture: {picture.width} x {picture.height} pixels>"
    grey = shown(picture, "cpr")[:, :, 0]
    dark_rows = (grey < 30).sum(axis=1)
    assert (dark_rows > 40).mean() > 0.6  # fat on both sides, from end to end
    with pytest.raises(ostia.InvalidInput, match="there is none|no such vessel"):
        ostia.picture(tree, image=image, vessel="RCA")
    with pytest.raises(ostia.InvalidInput, match="value"):
        ostia.picture(image, image=image)


def test_the_same_can_be_kept(surface, tmp_path):
    ostia.picture(surface).write(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes() == surface._repr_png_() == ostia.picture(surface).png()
    ostia.picture(surface).write(tmp_path / "a.svg")
    assert (tmp_path / "a.svg").read_text().lstrip().startswith("<?xml")
    with pytest.raises(ostia.InvalidInput):
        ostia.picture(surface).write(tmp_path / "a.gif")


def test_what_has_nothing_to_be_seen_is_shown_by_its_words():
    empty = ostia.TriMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int32))
    assert empty._repr_png_() is None and repr(empty)
    with pytest.raises(ostia.InvalidInput, match="value"):
        ostia.picture(object())
