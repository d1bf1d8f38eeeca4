"""A plug-in that segments: region growing stands where a network would be asked (ONNX Runtime, MONAI, PyTorch)."""
import numpy as np
import numpy.typing as npt

import ostia
from ostia import plugin


@plugin.mask("Grow a vessel's mask", version="1.0")
def grow_mask(given: plugin.Given, seed: str = "", lower_hu: float = 150.0, upper_hu: float = 700.0) -> npt.NDArray[np.bool_]:
    """All voxels between two CT numbers that hang together with the seed, x,y,z in mm; without one, with what is nearest to the middle."""
    image = given.image
    given.progress(0.1, "growing")
    # A network would come here: probability = session.run(None, {"image": image.array[None, None].astype(np.float32)})[0][0, 0]
    # and then: return probability >= 0.5
    inside = (image.array >= lower_hu) & (image.array <= upper_hu)
    if not inside.any():
        raise ValueError(f"no voxel is between {lower_hu:g} and {upper_hu:g} HU")
    return grown(inside, nearest(inside, place_of(seed, image)))


def place_of(seed: str, image: ostia.Volume) -> npt.NDArray[np.float64]:
    """As an index (k, j, i)."""
    if not seed:
        return np.array(image.array.shape) / 2
    x, y, z = (float(one) for one in seed.split(","))
    return np.array(image.index((x, y, z)))[::-1]


def nearest(inside: npt.NDArray[np.bool_], place: npt.NDArray[np.float64]) -> tuple[int, int, int]:
    voxels = np.argwhere(inside)
    k, j, i = voxels[np.argmin(((voxels - place) ** 2).sum(axis=1))]
    return int(k), int(j), int(i)


def grown(inside: npt.NDArray[np.bool_], seed: tuple[int, int, int]) -> npt.NDArray[np.bool_]:
    """Layer by layer, over the voxels' six sides."""
    padded = np.pad(inside, 1)  # a border, so that no step leads around an edge
    free = padded.ravel()
    _, rows, columns = padded.shape
    steps = np.array([1, -1, columns, -columns, rows * columns, -rows * columns])
    taken = np.zeros_like(free)
    front = np.array([np.ravel_multi_index(tuple(one + 1 for one in seed), padded.shape)])
    while front.size:
        taken[front] = True
        front = np.unique(front[:, None] + steps)
        front = front[free[front] & ~taken[front]]
    return taken.reshape(padded.shape)[1:-1, 1:-1, 1:-1]
